#pragma once
#include "device/device_file.hpp"

namespace firmtouch::tools {

inline double wide(float a) { return static_cast<double>(a); }

constexpr uint32_t kJoints = device::kMaxJoints;

/// A point of a linkage in motion, in double. Its acceleration is the columns times the joints'
/// accelerations, and `bias_mps2`.
struct MovingPoint {
  Point at_m, velocity_mps;
  Point column_m[kJoints];  // motion per radian of each joint
  Point bias_mps2;
  uint32_t first = 0, end = 0;  // the columns that are not 0
};

/// The points that the rods of a linkage end at.
struct MovingPoints {
  MovingPoint base[kJoints];   // of the driven links
  MovingPoint elbow[kJoints];  // their other ends; of a serial arm one
  MovingPoint tip;
  bool is_closed = true;  // false: the links do not meet, and the tip is not defined
  double span = 1;        // volume of unit vectors along the links that meet at the tip of a loop
};

struct JointMotion {
  double angle_rad[kJoints] = {}, rate_rad_per_s[kJoints] = {};
};

/// Kinematics to the second order: loops closed as spheres that intersect, their velocities and
/// accelerations from rods of constant length.
MovingPoints points_of(const LinkageDevice& device, const JointMotion& motion);

}  // namespace firmtouch::tools
