#pragma once
// What the files of this module share about float32, for .cpp files of this module only.
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::spline {

constexpr float kUnit = 0x1p-24f;  // half the distance of 1 and the next float32

static inline math::Vec3 vec3_at(const float* from) { return {from[0], from[1], from[2]}; }

/// Upper bound of a vector's length: the sum of its coordinates' sizes.
static inline float size_of(math::Vec3 v) {
  return __builtin_fabsf(v.x) + __builtin_fabsf(v.y) + __builtin_fabsf(v.z);
}

/// Head::loss_m bounds the rounding error of a computed point. Its first, second and third
/// derivatives are off by at most so many times as much: their terms carry factors k, k (k - 1) and
/// k (k - 1) (k - 2), three times that with weights.
constexpr float kSlopeNoise = 20.0f, kBendNoise = 80.0f, kTwistNoise = 400.0f;

}  // namespace firmtouch::spline
