#pragma once
// Whether a segment crosses a triangle, in integers. For the library's own translation units.

#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::mesh {

struct Crossing {
  int8_t direction = 0;  // +1: along the triangle's normal (leaves), -1: against it, 0: none
  float t = 0;           // 0 at a, 1 at b
};

/// t of fractions in [0.5, 1] and powers of two, the part not larger than the whole: three
/// roundings with those of the fractions.
static inline float ratio_of_fractions(float part, int32_t part_exponent, float whole,
                                       int32_t whole_exponent) {
  const int32_t shift = part_exponent - whole_exponent;
  if (shift < -126) return 0.0f;
  const float t = part / whole * math::float_of(static_cast<uint32_t>(shift + 127) << 23);
  return t > 1.0f ? 1.0f : t;
}

/// Whether the segment from `a` to `b` crosses the triangle, decided without any rounding.
///
/// What touches an edge, a corner or an end is decided as if a and b had both been moved by (e,
/// e^2, e^3) for an infinitely small e > 0: the moved segment touches nothing, so it crosses
/// exactly one of the triangles of an edge that it passes through, and a closed surface as often
/// inward as outward on any closed chain of segments.
/// Pre: all coordinates are finite.
/// Bounds: about 12,500 instructions for coordinates of like size, 105,000 instructions for those
///         that have all exponents; 1.9 KB of stack; re-entrant.
/// Error:  |t - exact| <= 2^-22.
/// Source: Edelsbrunner & Muecke 1990, Simulation of Simplicity, for the idea of the moved points.
Crossing exact_crossing(math::Vec3 a, math::Vec3 b, math::Vec3 p, math::Vec3 q, math::Vec3 r);

}  // namespace firmtouch::mesh
