#pragma once
#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/serial_arm.hpp"

// Torques that carry a linkage's own weight.
namespace firmtouch::device {

/// A rod's weight acts at its two ends as if it were shared between them by the lever rule, so all
/// weight acts at the fixed base, at the ends of the driven links and at the tip.
struct Load {
  float elbow_mass_kg[kMaxJoints] = {};  // of a serial arm: elbow; shoulder, with 3 joints
  float tip_mass_kg = 0;
  math::Vec3 gravity_mps2;
};

/// Torques that hold the load still, not limited; 0 at the tip's part where the pose is singular.
/// Pre: check(load) passed. `pose` is of these angles. Bounds: constant. Result: finite.
math::Vec3 carrying_torques_Nm(const FiveBar& bar, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose, const Load& load);
math::Vec3 carrying_torques_Nm(const SerialArm& arm, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose, const Load& load);
math::Vec3 carrying_torques_Nm(const Delta& delta, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose, const Load& load);

core::Verdict check(const Load& load);

}  // namespace firmtouch::device
