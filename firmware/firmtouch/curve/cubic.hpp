#pragma once
// The cubic pieces of a smooth curve, for .cpp files of the library and the baker only: what the
// baker derives from the samples, open() and every query derive again, to the bit.

#include "firmtouch/curve/layout.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::curve {

/// A piece as its Bezier points, from its first sample, which is the zeroth: no digit of it depends
/// on where the curve lies.
struct Cubic {
  math::Vec3 c1, c2, c3;
};

/// Where the samples of a curve are, and whether it is closed.
struct Track {
  const Sample* samples;
  uint32_t count;
  bool is_closed;
};

static inline math::Vec3 step_m(const Track& track, uint32_t from) {
  const Sample &a = track.samples[from], &b = track.samples[from + 1];
  return math::Vec3{b.x_m - a.x_m, b.y_m - a.y_m, b.z_m - a.z_m};
}

/// The curve's direction at sample `i`, that of the parabola through it and the samples beside it,
/// by chord length; not longer than 1. At an open end: of the one piece there.
static inline math::Vec3 slope_at(const Track& track, uint32_t i) {
  const uint32_t last = track.count - 1;
  const bool is_end = i == 0 || i == last;
  if (is_end && !track.is_closed) {
    const math::Vec3 only = step_m(track, i == 0 ? 0 : last - 1);
    return only * (1.0f / math::length(only));
  }
  const math::Vec3 before = step_m(track, is_end ? last - 1 : i - 1);
  const math::Vec3 after = step_m(track, is_end ? 0 : i);
  const float length_before = math::length(before), length_after = math::length(after);
  const float whole = length_before + length_after;
  return before * (length_after / (length_before * whole)) +
         after * (length_before / (length_after * whole));
}

/// A piece `along` with these slopes: cubic Hermite, so that neighbours share a tangent at their
/// sample.
static inline Cubic cubic_between(math::Vec3 along, math::Vec3 first_slope,
                                  math::Vec3 second_slope) {
  const float third = math::length(along) * (1.0f / 3.0f);
  return {first_slope * third, along - second_slope * third, along};
}
static inline Cubic cubic_of(const Track& track, uint32_t segment) {
  return cubic_between(step_m(track, segment), slope_at(track, segment),
                       slope_at(track, segment + 1));
}

static inline math::Vec3 point_at(const Cubic& c, float t) {
  const float u = 1.0f - t;
  return c.c1 * (3.0f * u * u * t) + c.c2 * (3.0f * u * t * t) + c.c3 * (t * t * t);
}
static inline math::Vec3 first_derivative(const Cubic& c, float t) {
  const float u = 1.0f - t;
  return (c.c1 * (u * u) + (c.c2 - c.c1) * (2.0f * u * t) + (c.c3 - c.c2) * (t * t)) * 3.0f;
}
static inline math::Vec3 second_derivative(const Cubic& c, float t) {
  return ((c.c2 - c.c1 * 2.0f) * (1.0f - t) + (c.c3 - c.c2 * 2.0f + c.c1) * t) * 6.0f;
}

/// Squared distance from the point `from` off the beginning of a straight line to that line.
static inline float line_distance2(math::Vec3 from, math::Vec3 along) {
  const float progress = dot(from, along), length2 = dot(along, along);
  const float t = !(progress > 0.0f) ? 0.0f : progress < length2 ? progress / length2 : 1.0f;
  const math::Vec3 rest = from - along * t;
  return dot(rest, rest);
}

}  // namespace firmtouch::curve
