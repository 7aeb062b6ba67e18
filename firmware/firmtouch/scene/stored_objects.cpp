#include "firmtouch/scene/stored_objects.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/scene/stored_name.hpp"

namespace firmtouch::scene {
namespace {

using core::reject;
using core::Verdict;

math::Vec3 vector(const float* from) { return {from[0], from[1], from[2]}; }

Object wanted_by(const ObjectLayout& layout) {
  Object object;
  for (uint32_t i = 0; i < 3; ++i) object.pose.rotation.row[i] = vector(layout.rotation + 3 * i);
  object.pose.translation_m = vector(layout.at_m);
  object.twist = {vector(layout.velocity_mps), vector(layout.turn_rad_per_s)};
  object.stiffness_N_per_m = layout.stiffness_N_per_m;
  object.friction_static = layout.friction_static;
  object.friction_dynamic = layout.friction_dynamic;
  return object;
}

static_assert(static_cast<uint32_t>(ObjectProblem::kMaterial) == 4 &&
                  kRuleObjectMaterial - kRuleObjectRotation == 3,
              "a rule a problem, in order");

Verdict check(const StoredObjects& objects, uint32_t i) {
  if (!is_name(objects[i].name) || !is_name(objects[i].mesh)) return reject(kRuleObjectName, i);
  for (uint32_t k = 0; k < i; ++k)
    if (is_same_name(objects[k].name, objects[i].name)) return reject(kRuleObjectTwice, i);
  Object object;
  const auto problem = static_cast<uint32_t>(set_object(wanted_by(objects[i]), object));
  if (problem == 0) return core::kPassed;
  return reject(static_cast<uint16_t>(kRuleObjectRotation - 1 + problem), i);
}

}  // namespace

Verdict open(core::Bytes section, StoredObjects& to) {
  to = {};
  const StoredObjects objects = core::as_whole_array<ObjectLayout>(section);
  if (objects.size() == 0 || objects.size() > kMaxObjects) return reject(kRuleObjectCount);
  for (uint32_t i = 0; i < objects.size(); ++i) {
    const Verdict verdict = check(objects, i);
    if (!verdict.ok()) return verdict;
  }
  to = objects;
  return core::kPassed;
}

Object object_of(const ObjectLayout& layout) {
  Object object;
  (void)set_object(wanted_by(layout), object);
  return object;
}

}  // namespace firmtouch::scene
