#include "firmtouch/device/linkage.hpp"

#include "firmtouch/device/jacobian.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::device {
namespace {

using core::reject;
using math::Vec3;

constexpr float kMaxTorque_Nm = 1000.0f;
constexpr float kMinGone = 1e-3f;
// 1 less 4 u: against the roundings of torque / limit, its inverse and the product.
constexpr float kBelowOne = 1.0f - 0x1p-22f;

// Inline: called, it takes torques() 22 instructions. One return: of several, torques go through
// memory.
inline JointTorques scaled(Vec3 torque_Nm, float share, const float (&most_Nm)[kMaxJoints]) {
  // The largest torque in units of its limit.
  float excess = math::larger(__builtin_fabsf(torque_Nm.x) / most_Nm[0], 1.0f);
  excess = math::larger(__builtin_fabsf(torque_Nm.y) / most_Nm[1], excess);
  excess = math::larger(__builtin_fabsf(torque_Nm.z) / most_Nm[2], excess);
  if (excess > 1.0f) {
    const float scale = kBelowOne / excess;
    torque_Nm = torque_Nm * scale;
    share = share * scale;
  }
  return {{torque_Nm.x, torque_Nm.y, torque_Nm.z}, share};
}

}  // namespace

float reciprocal_condition(const Vec3 (&column_m)[kMaxJoints]) {
  return condition_of(column_m[0], column_m[1], column_m[2]);
}

Vec3 tip_velocity(const Pose& pose, const float (&rate_rad_per_s)[kMaxJoints]) {
  return pose.column_m[0] * rate_rad_per_s[0] + pose.column_m[1] * rate_rad_per_s[1] +
         pose.column_m[2] * rate_rad_per_s[2];
}

JointTorques limited(const JointTorques& torques, const float (&most_Nm)[kMaxJoints]) {
  return scaled({torques.torque_Nm[0], torques.torque_Nm[1], torques.torque_Nm[2]}, torques.share,
                most_Nm);
}

JointTorques torques(const Pose& pose, const TorqueLimits& limits, Vec3 force_N) {
  const float along =
      (pose.reciprocal_condition - limits.gone_at) / (limits.full_from - limits.gone_at);
  Vec3 torque_Nm{};
  float share = 0.0f;
  if (along > 0.0f) {
    share = along < 1.0f ? along : 1.0f;
    const Vec3 faded_N = force_N * share;
    torque_Nm = {math::dot(pose.column_m[0], faded_N), math::dot(pose.column_m[1], faded_N),
                 math::dot(pose.column_m[2], faded_N)};
    const bool is_force = math::is_finite(torque_Nm.x + torque_Nm.y + torque_Nm.z);
    if (__builtin_expect(!is_force, 0)) torque_Nm = {}, share = 0.0f;
  }
  return scaled(torque_Nm, share, limits.max_torque_Nm);
}

core::Verdict check(const TorqueLimits& limits) {
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    if (!(limits.max_torque_Nm[k] > 0.0f && limits.max_torque_Nm[k] <= kMaxTorque_Nm))
      return reject(kRuleMaxTorque, k);
  }
  if (!(limits.gone_at >= kMinGone && limits.gone_at < limits.full_from &&
        limits.full_from <= 1.0f))
    return reject(kRuleFade);
  return core::kPassed;
}

}  // namespace firmtouch::device
