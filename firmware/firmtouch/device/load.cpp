#include "firmtouch/device/load.hpp"

#include "firmtouch/device/arms.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::device {
namespace {

using core::reject;
using math::Vec3;

constexpr float kMaxMass_kg = 100.0f;
constexpr float kMaxGravity_mps2 = 100.0f;

bool is_mass(float mass_kg) { return mass_kg >= 0.0f && mass_kg <= kMaxMass_kg; }

// The tip's share: the transposed Jacobian times the force that holds its mass. noinline: three
// callers.
[[gnu::noinline]] Vec3 at_tip(const Pose& pose, const Load& load) {
  const Vec3 hold_N = load.gravity_mps2 * -load.tip_mass_kg;
  return {math::dot(pose.column_m[0], hold_N), math::dot(pose.column_m[1], hold_N),
          math::dot(pose.column_m[2], hold_N)};
}

float at_elbow(Vec3 swing_m, float mass_kg, const Load& load) {
  return -mass_kg * math::dot(swing_m, load.gravity_mps2);
}

// Motion per radian of a link's end in the plane of its angle.
[[gnu::noinline]] Vec3 link_swing(float length_m, float angle_rad) {
  const math::SineCosine turn = math::sine_cosine(angle_rad);
  return {-length_m * turn.sine, length_m * turn.cosine, 0};
}

// The same in an upright plane that is turned about z.
Vec3 upright(Vec3 swing_m, float cosine, float sine) {
  return {swing_m.x * cosine, swing_m.x * sine, swing_m.y};
}

}  // namespace

Vec3 carrying_torques_Nm(const FiveBar& bar, const float (&angle_rad)[kMaxJoints], const Pose& pose,
                         const Load& load) {
  float torque_Nm[2];
  for (uint32_t k = 0; k < 2; ++k)
    torque_Nm[k] =
        at_elbow(link_swing(bar.proximal_m[k], angle_rad[k]), load.elbow_mass_kg[k], load);
  return at_tip(pose, load) + Vec3{torque_Nm[0], torque_Nm[1], 0};
}

Vec3 carrying_torques_Nm(const SerialArm& arm, const float (&angle_rad)[kMaxJoints],
                         const Pose& pose, const Load& load) {
  const float mass_kg = load.elbow_mass_kg[0];
  const Vec3 swing = link_swing(arm.link_m[0], angle_rad[arm.joints - 2]);
  if (arm.joints == 2) return at_tip(pose, load) + Vec3{at_elbow(swing, mass_kg, load), 0, 0};
  // In the arm's plane the elbow is the swing turned back by a quarter; joint 0 turns the plane.
  const Vec3 turn = link_swing(1.0f, angle_rad[0]);  // less sine, cosine
  const Vec3 by_turn = turn * (arm.offset_m + swing.y);
  const float of_shoulder_Nm = at_elbow(turn * arm.offset_m, load.elbow_mass_kg[1], load);
  const Vec3 by_shoulder = upright(swing, turn.y, -turn.x);
  return at_tip(pose, load) + Vec3{at_elbow(by_turn, mass_kg, load) + of_shoulder_Nm,
                                   at_elbow(by_shoulder, mass_kg, load), 0};
}

Vec3 carrying_torques_Nm(const Delta& delta, const float (&angle_rad)[kMaxJoints], const Pose& pose,
                         const Load& load) {
  float torque_Nm[3];
  for (uint32_t k = 0; k < 3; ++k)
    torque_Nm[k] =
        at_elbow(upright(link_swing(delta.upper_m[k], angle_rad[k]), kCosine[k], kSine[k]),
                 load.elbow_mass_kg[k], load);
  return at_tip(pose, load) + Vec3{torque_Nm[0], torque_Nm[1], torque_Nm[2]};
}

core::Verdict check(const Load& load) {
  for (uint32_t k = 0; k < kMaxJoints; ++k)
    if (!is_mass(load.elbow_mass_kg[k])) return reject(kRuleLoad, k);
  if (!is_mass(load.tip_mass_kg)) return reject(kRuleLoad, kMaxJoints);
  if (!(math::dot(load.gravity_mps2, load.gravity_mps2) <= kMaxGravity_mps2 * kMaxGravity_mps2))
    return reject(kRuleLoad, kMaxJoints + 1);
  return core::kPassed;
}

}  // namespace firmtouch::device
