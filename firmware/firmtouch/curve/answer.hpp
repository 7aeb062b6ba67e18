#pragma once
// Answer and certificate from a foot-point, for .cpp files of this module only.

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {

// Beyond this all points of a curve are as near as any other to 2^-28, and squares still fit.
constexpr float kBeyond_m = 0x1p60f;

/// True where the tree can be searched; false too for NaN.
static inline bool is_near(math::Vec3 p_m) {
  return p_m.x <= kBeyond_m && p_m.x >= -kBeyond_m && p_m.y <= kBeyond_m && p_m.y >= -kBeyond_m &&
         p_m.z <= kBeyond_m && p_m.z >= -kBeyond_m;
}

// What float32 loses in a distance, u = 2^-24, h half the longest segment, d the distance. A foot
// is computed from the nearer end of its segment, so v = p - end and t e (e along the segment) are
// at most d + h and h long. Rounding of v, e and t e moves the foot by u (|v| + 2 |t e|) <= u (d +
// 3 h); the last difference, the sum of squares, the root and the subtraction below lose 4.5 u d.
// Rounding of t moves it along the segment by x <= 7 u h + 3 u d, which adds sqrt(d^2 + x^2) - d:
// at most x where d vanishes, nothing where d is of the size of h. Together: 10 u h where d is
// small, 5.5 u d and 3 u h where it is not. Compensated differences lose nothing and the sum of
// squares one rounding more: 4 u d. The loss must not fall with d, else a better answer could widen
// the certificate.
constexpr float kUnit = 0x1p-24f;
constexpr float kVanishing_m = 0x1p-58f;  // squares of less may underflow

/// Lower bound of the true distance, where `distance_m` is the least that was computed.
static inline float rounded_down(float distance_m, float half_m, bool compensated) {
  const float near_m = 10.5f * kUnit * half_m;
  const float far_m = 5.6f * kUnit * distance_m + 3.3f * kUnit * half_m;
  const float lost_m = compensated ? 4.1f * kUnit * distance_m : math::larger(near_m, far_m);
  return distance_m - (lost_m + kVanishing_m);
}

/// All but the certificate.
static inline Closest answer_at(const View& curve, const Foot& foot) {
  Closest closest;
  closest.distance_m = math::square_root(foot.distance2_m2);
  closest.segment = segment_of(foot);
  const math::Vec3 from_m = curve.sample(foot.sample), to_m = curve.sample(foot.neighbour);
  const math::Vec3 along_m = to_m - from_m;
  closest.point_m = from_m + along_m * foot.t;
  const float per_length = 1.0f / math::length(along_m);
  closest.tangent = along_m * (foot.sample < foot.neighbour ? per_length : -per_length);
  closest.arc = arc_of(curve, foot);
  return closest;
}

}  // namespace firmtouch::curve
