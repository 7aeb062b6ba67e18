#pragma once
#include "firmtouch/device/linkage.hpp"

namespace firmtouch::device {

/// A planar five-bar (pantograph) in the plane z = 0. Motor 0 is at (-base/2, 0), motor 1 at
/// (base/2, 0). A proximal link goes from each motor to an elbow, a distal one from each elbow to
/// the tip. Angles: from +x to the proximal link, counter-clockwise.
struct FiveBar {
  float base_m = 0;  // 0: both motors on one axis
  float proximal_m[2] = {};
  float distal_m[2] = {};
  bool is_tip_left = true;  // of the way from elbow 0 to elbow 1; else right of it
};

core::Verdict check(const FiveBar& bar);

/// Forward kinematics and Jacobian; column 2 is 0.
/// Pre: check(bar) passed. Bounds: constant. Result: finite for every angle. Where the distal links
/// do not reach each other, the position is on the line through the elbows.
/// Error: links to 0.2 m, no distal one longer than 4 times the other, reciprocal condition at
/// least 0.05: position within 1e-6 m. There, where the sine of the angle between the distal links
/// is at least 0.3: columns within 1e-5 of the larger of the Jacobian's norm and the shorter
/// proximal link (tests/device/linkage_host_test.cpp).
/// Source: Campion, Wang & Hayward 2005, The Pantograph Mk-II.
Pose pose_of(const FiveBar& bar, const float (&angle_rad)[kMaxJoints]);

}  // namespace firmtouch::device
