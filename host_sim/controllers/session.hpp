#pragma once
#include <memory>
#include <string>
#include <vector>

#include "firmtouch/controller/tool_controller.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/controllers/penalty_controller.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// What makes the contact of a controller in this process.
enum class Contact { kProxy, kPenalty };

/// A surface or a guide of an asset; objects are a surface.
struct SceneEntry {
  bool is_guide;
  std::string name;
};

/// An asset and the in-process controller that opened it.
struct Session {
  /// `wanted`: the surface and the guide to use; an empty name stands for the asset's first.
  /// Throws Refused with the file and the rule that rejects it, or with the names that the asset
  /// has.
  explicit Session(const std::string& asset_path, SceneNames wanted = {},
                   Contact contact = Contact::kProxy);
  Session(const Session&) = delete;  // the controller refers to `wanted`
  Session& operator=(const Session&) = delete;

  /// Loads the asset that a tick with record::kCommandSwapAsset swaps to. Throws Refused.
  void load_next(const std::string& asset_path);
  /// Of the controller that renders the contact.
  Tick tick() const;
  /// "surface `part`, guide `path`; not used: surface `lid`"; "objects `left`, `right`".
  std::string scene_text() const;
  /// Name of the program with the parts that the scene needs, of a board's build.
  std::string program() const;
  /// Whether a controller that uses the asset's first surface and guide has the same scene.
  bool is_default() const;

  AssetFile asset;
  SceneNames wanted;
  SceneNames used;                   // empty: the asset has none
  std::vector<std::string> objects;  // names of those that are touched; empty: one surface
  std::vector<std::string> unused;   // "surface `lid`"
  std::unique_ptr<ToolController> controller;
  std::unique_ptr<PenaltyController> penalty;  // null: contact through a proxy
  std::unique_ptr<AssetFile> next;             // null: no asset to swap to
  std::unique_ptr<SwappingToolController> swapping;

 private:
  void list_unused(const std::vector<SceneEntry>& entries);

  SceneNames default_;
};

/// Throws Refused if a controller outside this process would use another scene: it always opens the
/// asset's first surface and guide, and renders contact through a proxy.
/// `controller`: as of open_controller().
void check_scene(const Session& session, const std::string& controller);

/// `path` relative to the folder of `folder_of` if possible, so that log and asset can be moved
/// together.
std::string path_from(const std::string& folder_of, const std::string& path);
/// The inverse: `relative` as seen from the folder of `file`.
std::string path_beside(const std::string& file, const std::string& relative);

}  // namespace firmtouch::host_sim
