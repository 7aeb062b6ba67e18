#pragma once
#include "firmtouch/core/status.hpp"
#include "firmtouch/device/joints.hpp"
#include "firmtouch/math/vec3.hpp"

// What all linkages share: a pose with its Jacobian, and from it the tip's velocity and the joints'
// torques. A linkage is a plain struct with check() and pose_of(); a user's own is the same.
namespace firmtouch::device {

/// A linkage in one pose, in its own frame.
struct Pose {
  math::Vec3 position_m;            // of the tip
  math::Vec3 column_m[kMaxJoints];  // the Jacobian: the tip's motion per radian; 0 of no joint
  float reciprocal_condition;       // 1: isotropic; 0: singular, and all columns are 0
  bool is_reachable;                // false: the links do not meet at these angles
};

/// When the force fades, and the torques that the joints may have.
struct TorqueLimits {
  float full_from = 0.10f;  // reciprocal condition at which the whole force is rendered
  float gone_at = 0.05f;    // and at which none is
  float max_torque_Nm[kMaxJoints] = {1, 1, 1};
};

struct JointTorques {
  float torque_Nm[kMaxJoints];  // 0 of joints that the linkage does not have
  float share;  // of the force that these torques render: share * force, in its direction
};

/// Condition of a Jacobian of n = 3 columns in the Frobenius norm: n / (|J| |J^-1|). A planar
/// linkage has the same of n = 2. 1 where all directions are alike, 0 where one is lost or free.
/// With the largest and the least singular value s and t: t / s <= result <= n t / s.
/// Result: 0 to 1; 0 for NaN and infinity. The columns may have any common scale within 1e-5 and
/// 1e5. Source: Angeles, Fundamentals of Robotic Mechanical Systems, 5.8.
float reciprocal_condition(const math::Vec3 (&column_m)[kMaxJoints]);

/// Jacobian times rates.
math::Vec3 tip_velocity(const Pose& pose, const float (&rate_rad_per_s)[kMaxJoints]);

/// Scales torques as a whole so that no joint exceeds `most_Nm`: the direction stays.
/// Pre: most_Nm is above 0 wherever the torque is not 0. Result: finite for finite torques.
JointTorques limited(const JointTorques& torques, const float (&most_Nm)[kMaxJoints]);

/// Transposed Jacobian times force, faded, then scaled as a whole so that no joint exceeds its
/// limit: the force rendered has the direction of the one passed.
/// Fade: the share is (c - gone_at) / (full_from - gone_at) between the two, where c is the
/// reciprocal condition: continuous in the pose, and no force is left at a singularity.
/// Pre: check(limits) passed. Result: finite, within the limits for every pose and force; a force
/// that is not finite gives none.
JointTorques torques(const Pose& pose, const TorqueLimits& limits, math::Vec3 force_N);

core::Verdict check(const TorqueLimits& limits);

}  // namespace firmtouch::device
