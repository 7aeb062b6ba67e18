#include "firmtouch/controller/mesh_tool.hpp"

#include "firmtouch/controller/proxy_surface.hpp"
#include "firmtouch/scene/materials_layout.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/pose_loss.hpp"

namespace firmtouch {

// The mesh as touch_by_tool() queries it.
struct MeshTool::Shape {
  const scene::PlacedMesh& object;
  mesh::Hint (&hint)[scene::kMaxSpheres];

  float size_m() const { return object.mesh->head().diagonal_m; }
  scene::Near near(uint32_t sphere, math::Vec3 x_m, query::Budget budget, float needed_m) const {
    return scene::PlacedMeshTouched{object, hint[sphere]}.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t, scene::Way way, query::Budget budget, uint32_t& work) const {
    return scene::free_part_of(object, way, budget, work);
  }
};

void MeshTool::close() {
  mesh_.close();
  spheres_ = {};
}

core::Verdict MeshTool::read_tool() {
  if (!spheres_.empty()) return core::kPassed;
  const auto has = [this](uint32_t section) {
    return asset::find_name(*asset_, section, nullptr) != nullptr;
  };
  if (has(scene::kObjectsSection) || has(scene::kMaterialsSection))
    return core::reject(scene::kRuleToolAlone);
  const char* name = asset::find_name(*asset_, scene::kToolSection, nullptr);
  return scene::open(asset_->find(scene::kToolSection, name), spheres_);
}

void MeshTool::reset() {
  turn_ = {};
  scene::reset(touch_);
  torque_Nm_ = {};
  for (mesh::Hint& hint : hint_) hint = {};
}

void MeshTool::touch(const ModelRequest& request, const params::Values& values,
                     ModelResult& result) {
  const math::Vec3 origin_m = scene_origin_m(request, values);
  if (!scene::is_same(origin_m, origin_m_)) {
    origin_m_ = origin_m;
    scene::reset(touch_);
  }
  scene::PlacedMesh object;
  object.mesh = &mesh();
  object.pose.translation_m = origin_m;
  Shape shape{object, hint_};
  scene::touch_by_tool(proxy_contact(request, values, result), spheres_, turn_.rotation, shape,
                       touch_, result.model);
  report(result);
}

// The distance is that of the sphere with the least room.
void MeshTool::report(ModelResult& result) const {
  const scene::Proxy& proxy = touch_.sphere[touch_.nearest].proxy;
  const scene::Bounds bounds = scene::bounds_of(proxy, touch_.place_m[touch_.nearest]);
  report_surface({bounds.lower_m, touch_.steps, proxy.near.is_exact, proxy.near.sign, touch_.work},
                 proxy.near.sign < 0 ? -bounds.upper_m : bounds.upper_m, touch_.penetration_m,
                 result);
  result.state |= record::kStateProxy | (touch_.nearest + 1u) << record::kStateObjectShift;
}

void MeshTool::put_torque(bool is_new, record::TickOutput& output) {
  if (is_new) torque_Nm_ = touch_.torque_Nm;
  const uint32_t mode = output.state & record::kStateServoMask;
  const bool is_on = mode == 1 || mode == 2;  // of servo::Mode; controller_core.cpp checks it
  const math::Vec3 torque_Nm = is_on ? torque_Nm_ : math::Vec3{};
  output.torque_Nm[0] = torque_Nm.x;
  output.torque_Nm[1] = torque_Nm.y;
  output.torque_Nm[2] = torque_Nm.z;
}

}  // namespace firmtouch
