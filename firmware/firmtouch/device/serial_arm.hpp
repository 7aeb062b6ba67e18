#pragma once
#include "firmtouch/device/linkage.hpp"

namespace firmtouch::device {

/// A serial arm of two links. With two joints it moves in the plane z = 0, shoulder in the origin.
/// With three, joint 0 turns the arm's plane about z, and in that plane the shoulder is `offset_m`
/// from the axis and `height_m` up.
/// Angles: joint 0 of three from +x, counter-clockwise. The first link from the horizontal (of two
/// joints from +x), upwards. The second link from the first, or from the horizontal where it is
/// driven by a parallelogram.
struct SerialArm {
  uint32_t joints = 3;
  float link_m[2] = {};
  float offset_m = 0;  // 0 with two joints
  float height_m = 0;  // 0 with two joints
  bool has_parallelogram = false;
};

core::Verdict check(const SerialArm& arm);

/// Forward kinematics and Jacobian. Always reachable.
/// Pre: check(arm) passed. Bounds: constant. Result: finite for every angle.
/// Error: position within 1e-6 m, columns within 1e-5 of the Jacobian's norm, where no length
/// exceeds 0.3 m (tests/device/linkage_host_test.cpp).
/// Source: Cavusoglu, Feygin & Tendick 2002, for the parallelogram of a Phantom.
Pose pose_of(const SerialArm& arm, const float (&angle_rad)[kMaxJoints]);

}  // namespace firmtouch::device
