#pragma once
// What the baker derives from the samples and open() derives again, to the bit. For .cpp files of
// the library and the baker only: both are compiled with the library's own floating-point flags.

#include "firmtouch/curve/layout.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::curve {

static inline math::Vec3 vec(const Sample& s) { return {s.x_m, s.y_m, s.z_m}; }

/// Half of a segment, rounded up by more than length() loses (5 operations) and more than the
/// search loses when it adds the reach to a distance and compares squares (8 operations).
static inline float half_segment_m(const Sample& a, const Sample& b) {
  return math::length(vec(b) - vec(a)) * (0.5f + 0x1p-20f);
}

/// Longest half segment at sample i of `count`.
static inline float own_reach_m(const Sample* samples, uint32_t count, uint32_t i) {
  const float before_m = i > 0 ? half_segment_m(samples[i - 1], samples[i]) : 0.0f;
  const float after_m = i + 1 < count ? half_segment_m(samples[i], samples[i + 1]) : 0.0f;
  return before_m > after_m ? before_m : after_m;
}

/// Diagonal of the head's box, rounded down.
static inline float diagonal_m(const Head& head) {
  const math::Vec3 sides{head.high_m[0] - head.low_m[0], head.high_m[1] - head.low_m[1],
                         head.high_m[2] - head.low_m[2]};
  return math::length(sides) * (1.0f - 0x1p-21f);
}

/// True where sample a comes before sample b on `axis`: the total order of the tree.
static inline bool comes_before(const Sample* samples, uint32_t axis, uint32_t a, uint32_t b) {
  const float at_a = (&samples[a].x_m)[axis], at_b = (&samples[b].x_m)[axis];
  if (at_a < at_b) return true;
  if (at_b < at_a) return false;
  return a < b;
}

}  // namespace firmtouch::curve
