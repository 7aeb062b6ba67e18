#pragma once
// For the library's own translation units.

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {

constexpr float kPoseLoss = 0x1p-21f;

/// What applying a pose to a point and back may round: 8 roundings of its longest vectors. 0 for
/// the identity.
static inline float pose_loss_m(const math::RigidTransform& pose, math::Vec3 x_m) {
  const math::Vec3 t_m = pose.translation_m;
  const math::Mat3& r = pose.rotation;
  const bool is_unmoved = math::dot(t_m, t_m) <= 0.0f;
  const bool is_unturned = r.row[0].x >= 1.0f && r.row[1].y >= 1.0f && r.row[2].z >= 1.0f;
  if (is_unmoved && is_unturned) return 0.0f;
  return kPoseLoss * (math::length(x_m) + math::length(t_m));
}

}  // namespace firmtouch::scene
