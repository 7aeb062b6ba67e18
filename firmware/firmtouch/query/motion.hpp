#pragma once
// What carry() is made of (query/coherence.hpp). For the library's own translation units.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::query {

/// How far `position_m` is from the last query, rounded up (five operations of relative error 2^-24
/// each); NaN where it is not finite.
static inline float motion_m(const HintBase& hint, math::Vec3 position_m) {
  return math::length(position_m - hint.position_m) * (1.0f + 8.0f * 0x1p-24f);
}

constexpr float kMaxMotion_m = 0x1p100f;

/// What is left of a certified radius after a motion, rounded down; 0 where nothing is.
static inline float left_of(float radius_m, float motion_m) {
  const float left_m = (radius_m - motion_m) * (1.0f - 4.0f * 0x1p-24f) - 0x1p-120f;
  return math::larger(left_m, 0.0f);
}

/// The same of a lower bound. At rest it is kept whole: repeated for an hour it would be worn off.
static inline float lower_left_of(float lower_m, float motion_m) {
  return motion_m <= 0.0f ? math::larger(lower_m, 0.0f) : left_of(lower_m, motion_m);
}

}  // namespace firmtouch::query
