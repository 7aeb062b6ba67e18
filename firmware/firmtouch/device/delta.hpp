#pragma once
#include "firmtouch/device/linkage.hpp"

namespace firmtouch::device {

/// A delta with three rotary joints, whose platform only translates. The arms stand at 0, 120 and
/// 240 degrees about z. The shoulder of arm k is `base_radius_m` out from z; its upper link turns
/// in the upright plane of the arm. A parallelogram of length lower_m goes from the upper link's
/// end to the platform, `platform_radius_m` out from the tip. `side_m` shifts shoulder against
/// platform, counter-clockwise about z. Angles: from the horizontal outward, upwards.
struct Delta {
  float upper_m[3] = {};
  float lower_m[3] = {};
  float base_radius_m = 0;
  float platform_radius_m = 0;
  float side_m = 0;
  bool is_tip_above = true;  // the plane of the upper links' ends; else below it
};

core::Verdict check(const Delta& delta);

/// Forward kinematics and Jacobian.
/// Pre: check(delta) passed. Bounds: constant. Result: finite for every angle. Where the lower
/// links do not reach each other, the position is in the plane of the upper links' ends.
/// Error: links to 0.2 m, none longer than 4 times another, reciprocal condition at least 0.05:
/// position within 3e-6 m. There, where unit vectors along the lower links span a volume of at
/// least 0.3: columns within 5e-5 of the larger of the Jacobian's norm and the shortest upper link.
/// A third and a fifth of that at most in tests/device/linkage_host_test.cpp.
/// Source: Tsai & Stamper 1996; offsets as in Martin & Hillier 2009.
Pose pose_of(const Delta& delta, const float (&angle_rad)[kMaxJoints]);

}  // namespace firmtouch::device
