#include "firmtouch/controller/mesh_objects.hpp"

#include "firmtouch/controller/proxy_surface.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/swept_sphere.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/pose_loss.hpp"
#include "firmtouch/scene/stored_name.hpp"

namespace firmtouch {

// The objects as touch_objects() queries them.
struct MeshObjects::Shapes {
  MeshObjects& of;

  float size_m() const { return of.size_m_; }
  scene::Near near(uint32_t i, math::Vec3 x_m, query::Budget budget, float needed_m) const {
    scene::PlacedMesh object;
    object.mesh = &of.mesh(i);
    return scene::PlacedMeshTouched{object, of.hint_[i]}.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t i, const scene::Way& way, query::Budget budget, uint32_t& work) const {
    const mesh::Sweep swept = mesh::sweep(of.mesh(i), way, budget);
    work += swept.work;
    return swept.free_part;
  }
};

void MeshObjects::close() {
  for (mesh::Loader& loader : mesh_) loader.close();
  stored_ = {};
  mesh_count_ = at_ = 0;
  is_begun_ = false;
}

core::Verdict MeshObjects::read_section() {
  core::Verdict verdict = scene::open(asset_->find(scene::kObjectsSection, name_), stored_);
  for (uint32_t i = 0; verdict.ok() && i < stored_.size(); ++i) verdict = find_mesh(i);
  if (!verdict.ok()) mesh_count_ = 0;
  return verdict;
}

// Objects may share a mesh.
core::Verdict MeshObjects::find_mesh(uint32_t object) {
  uint32_t k = 0;
  while (k < mesh_count_ && !scene::is_same_name(stored_[first_of_[k]].mesh, stored_[object].mesh))
    ++k;
  if (k == mesh_count_) {
    if (mesh::Loader::find(*asset_, stored_[object].mesh) == nullptr)
      return core::reject(scene::kRuleObjectMesh, object);
    if (k == kMaxObjectMeshes) return core::reject(scene::kRuleObjectMeshes, object);
    first_of_[k] = static_cast<uint8_t>(object);
    ++mesh_count_;
  }
  mesh_of_[object] = static_cast<uint8_t>(k);
  return core::kPassed;
}

void MeshObjects::reset() {
  if (is_open()) place(origin_m_);
  for (float& speed : speed_) speed = 0;
}

// The size covers where the object has been: tolerances grow as rounding does.
void MeshObjects::make_room(uint32_t object) {
  const mesh::Head& head = mesh(object).head();
  const math::Vec3 half_m{
      math::larger(__builtin_fabsf(head.low_m[0]), __builtin_fabsf(head.high_m[0])),
      math::larger(__builtin_fabsf(head.low_m[1]), __builtin_fabsf(head.high_m[1])),
      math::larger(__builtin_fabsf(head.low_m[2]), __builtin_fabsf(head.high_m[2]))};
  const float reach_m =
      math::length(object_[object].pose.translation_m - origin_m_) + math::length(half_m);
  if (!(2.0f * reach_m <= size_m_)) size_m_ = 2.0f * reach_m;
}

void MeshObjects::place(math::Vec3 origin_m) {
  origin_m_ = origin_m;
  size_m_ = 0;
  for (uint32_t i = 0; i < stored_.size(); ++i) {
    math::Vec3& at_m = object_[i].pose.translation_m;
    object_[i] = scene::object_of(stored_[i]);
    at_m = at_m + origin_m;
    pair_[i] = {};
    pair_[i].pose = object_[i].pose;
    hint_[i] = {};
    make_room(i);
  }
  touch_ = {};
}

bool MeshObjects::take_command(uint32_t command, float speed) {
  const uint32_t i = command - record::kCommandMoveObject;
  if (command < record::kCommandMoveObject || i >= stored_.size()) return false;
  if (!(speed >= -1.0f && speed <= 1.0f)) return false;
  speed_[i] = speed;
  object_[i].twist = scene::object_of(stored_[i]).twist;  // one that stopped at 10 m has none
  return true;
}

void MeshObjects::advance(float passed_s) {
  for (uint32_t i = 0; i < stored_.size(); ++i) {
    if (!(__builtin_fabsf(speed_[i]) > 0.0f)) continue;
    scene::advance(object_[i], speed_[i] * passed_s);
    make_room(i);
  }
}

void MeshObjects::touch(const ModelRequest& request, const params::Values& values,
                        ModelResult& result) {
  const math::Vec3 origin_m = scene_origin_m(request, values);
  if (!scene::is_same(origin_m, origin_m_)) place(origin_m);
  Shapes shapes{*this};
  scene::touch_objects(proxy_contact(request, values, result), {object_, pair_, stored_.size()},
                       shapes, touch_, result.model);
  report_proxy(touch_.touch, request.position_m, result);
  if (touch_.touch.proxy.phase == scene::Proxy::Phase::kFree) result.distance_m = touch_.upper_m;
  if ((result.state & record::kStateContact) != 0 && touch_.carrier != scene::kNoObject)
    result.state |= (touch_.carrier + 1u) << record::kStateObjectShift;
}

}  // namespace firmtouch
