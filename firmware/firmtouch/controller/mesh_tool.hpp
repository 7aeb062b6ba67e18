#pragma once
#include <stdint.h>

#include "firmtouch/controller/first_of.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/tool.hpp"

namespace firmtouch {

/// A surface policy: a mesh, touched by the tool that the asset stores, up to 8 spheres
/// (scene/tool_layout.hpp), instead of one of tool_radius_m. Commands turn the handle. Distance
/// field and base hull of the mesh are not used.
class MeshTool : public TorqueSurface {
 public:
  using Parameters = params::Groups<params::ContactRows, params::FrictionRows>;
  using State = mesh::Loader::State;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = kPartMesh | kPartTool;

  static const char* find(const asset::Container& asset, const char* wanted) {
    if (asset::find_name(asset, scene::kToolSection, nullptr) == nullptr) return nullptr;
    return mesh::Loader::find(asset, wanted);
  }
  void close();
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State& state) {
    close();
    asset_ = &asset;
    mesh_.begin<Trust>(asset, name, state);
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    const core::Verdict verdict = read_tool();
    if (!verdict.ok()) return {true, verdict};
    return mesh_.work<Trust>(state, units);
  }

  bool is_open() const { return mesh().is_open() && !spheres_.empty(); }
  /// The handle is not turned.
  void reset();
  /// record::kCommandTurnTool + axis: the wanted rotation vector's, in radians.
  /// Result: false if there is no such axis, or the angle is beyond scene::kMaxToolTurn_rad.
  bool take_command(uint32_t command, float angle_rad) {
    return turn_.want(command - record::kCommandTurnTool, angle_rad);
  }
  /// Turns the handle for a tick.
  void advance(float passed_s) { turn_.advance(passed_s); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);

  /// A model begins without contact.
  void begin_torque() { touch_.torque_Nm = {}; }
  /// Of the model that the tick of `output` used. `is_new`: it is the last one that was made.
  void put_torque(bool is_new, record::TickOutput& output);

  const mesh::View& mesh() const { return mesh_.view(); }
  const scene::StoredTool& spheres() const { return spheres_; }
  /// Of the last model.
  const scene::ToolTouch& contact() const { return touch_; }
  const scene::ToolTurn& turn() const { return turn_; }

 private:
  struct Shape;

  core::Verdict read_tool();
  void report(ModelResult& result) const;

  const asset::Container* asset_ = nullptr;
  mesh::Loader mesh_;
  scene::StoredTool spheres_;
  scene::ToolTurn turn_;
  scene::ToolTouch touch_;
  mesh::Hint hint_[scene::kMaxSpheres];
  math::Vec3 origin_m_;  // of the scene
  math::Vec3 torque_Nm_;
};

}  // namespace firmtouch
