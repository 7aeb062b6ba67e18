#pragma once
#include <memory>
#include <string>

#include "firmtouch/controller/full_controller.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// An asset and the in-process controller that opened it.
struct Session {
  /// Throws Refused with the file and the rule that rejects it.
  explicit Session(const std::string& asset_path);

  AssetFile asset;
  std::unique_ptr<FullController> controller;
};

/// `path` relative to the folder of `folder_of` if possible, so that log and asset can be moved
/// together.
std::string path_from(const std::string& folder_of, const std::string& path);
/// The inverse: `relative` as seen from the folder of `file`.
std::string path_beside(const std::string& file, const std::string& relative);

}  // namespace firmtouch::host_sim
