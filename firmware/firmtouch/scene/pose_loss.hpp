#pragma once
// For the library's own translation units.

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {

constexpr float kPoseLoss = 0x1p-21f;

/// What the inverse of a pose may round of a point: 8 roundings of what is between point and
/// translation, whose difference rounds once, however far both are from 0. 0 for the identity.
static inline float pose_loss_m(const math::RigidTransform& pose, math::Vec3 x_m) {
  const math::Vec3 t_m = pose.translation_m;
  const math::Mat3& r = pose.rotation;
  const bool is_unmoved = math::dot(t_m, t_m) <= 0.0f;
  // A small turn leaves 1 on the diagonal.
  const float turned = __builtin_fabsf(r.row[0].y) + __builtin_fabsf(r.row[0].z) +
                       __builtin_fabsf(r.row[1].x) + __builtin_fabsf(r.row[1].z) +
                       __builtin_fabsf(r.row[2].x) + __builtin_fabsf(r.row[2].y);
  const bool is_unturned =
      turned <= 0.0f && r.row[0].x >= 1.0f && r.row[1].y >= 1.0f && r.row[2].z >= 1.0f;
  if (is_unmoved && is_unturned) return 0.0f;
  return kPoseLoss * math::length(x_m - t_m);
}

static inline float pose_loss_m(const math::Translation& pose, math::Vec3 x_m) {
  const math::Vec3 t_m = pose.translation_m;
  return math::dot(t_m, t_m) <= 0.0f ? 0.0f : kPoseLoss * math::length(x_m - t_m);
}

/// Bit for bit.
static inline bool is_same(math::Vec3 a, math::Vec3 b) {
  return math::bits_of(a.x) == math::bits_of(b.x) && math::bits_of(a.y) == math::bits_of(b.y) &&
         math::bits_of(a.z) == math::bits_of(b.z);
}

static inline bool is_same(const math::RigidTransform& a, const math::RigidTransform& b) {
  return is_same(a.translation_m, b.translation_m) &&
         is_same(a.rotation.row[0], b.rotation.row[0]) &&
         is_same(a.rotation.row[1], b.rotation.row[1]) &&
         is_same(a.rotation.row[2], b.rotation.row[2]);
}

}  // namespace firmtouch::scene
