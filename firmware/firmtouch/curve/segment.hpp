#pragma once
// Closest point of one segment, for .cpp files of this module only.

#include "firmtouch/curve/derived.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::curve {

/// A point of the curve and how the query lies to it: from `sample` the part `t` of the way to the
/// neighbour, which is the sample before or after.
struct Foot {
  float distance2_m2;
  uint32_t sample;
  uint32_t neighbour;
  float t;
};

static inline uint32_t segment_of(const Foot& foot) {
  return foot.sample < foot.neighbour ? foot.sample : foot.neighbour;
}

static inline float arc_of(const View& curve, const Foot& foot) {
  return curve.arcs()[foot.sample] * (1.0f - foot.t) + curve.arcs()[foot.neighbour] * foot.t;
}

/// Squared distance to the point `t` of the way from sample a to b, with all roundings of the
/// differences compensated: only the rounding of the sum of squares remains. About 130 operations.
float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, float t);

/// Closest point of segment `segment`, computed from its nearer end: errors of float32 grow with
/// the distance along the segment.
static inline Foot foot_on_segment(const View& curve, math::Vec3 p_m, uint32_t segment,
                                   bool compensated) {
  uint32_t sample = segment, neighbour = segment + 1;
  math::Vec3 from_m = p_m - curve.sample(sample);
  math::Vec3 along_m = curve.sample(neighbour) - curve.sample(sample);
  const float length2_m2 = dot(along_m, along_m);
  float progress_m2 = dot(from_m, along_m);
  if (progress_m2 > 0.5f * length2_m2) {
    sample = segment + 1, neighbour = segment;
    from_m = p_m - curve.sample(sample);
    along_m = -along_m;
    progress_m2 = dot(from_m, along_m);
  }
  const float t = progress_m2 > 0.0f ? progress_m2 / length2_m2 : 0.0f;
  const math::Vec3 rest_m = from_m - along_m * t;
  const float distance2_m2 =
      compensated ? compensated_distance2(p_m, curve.sample(sample), curve.sample(neighbour), t)
                  : dot(rest_m, rest_m);
  return {distance2_m2, sample, neighbour, t};
}

/// Outside the box of the curve by a 32nd of its diagonal distances may exceed the diagonal, and
/// the promise of 4e-7 of the distance needs compensation there.
static inline bool is_compensated(const Head& head, math::Vec3 p_m) {
  const float at_m[3] = {p_m.x, p_m.y, p_m.z};
  const float margin_m = head.diagonal_m * 0x1p-5f;
  for (uint32_t k = 0; k < 3; ++k)
    if (at_m[k] < head.low_m[k] - margin_m || at_m[k] > head.high_m[k] + margin_m) return true;
  return false;
}

}  // namespace firmtouch::curve
