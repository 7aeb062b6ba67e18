#pragma once
// Eight floats at once, in the variant of the level that this is compiled for. Each operation
// rounds as that of one float does.

#include "firmtouch/math/vec3_ops.hpp"

#if defined(__AVX2__)
#include "simd/search/vectors_avx2.hpp"
#else
#include "simd/search/vectors_generic.hpp"
#endif

namespace firmtouch::simd {

/// A vector in each lane.
struct Lanes {
  Float8 x, y, z;
};

[[gnu::always_inline]] static inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] static inline Lanes operator*(const Lanes& a, Float8 s) {
  return {a.x * s, a.y * s, a.z * s};
}
[[gnu::always_inline]] static inline Float8 dot(const Lanes& a, const Lanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] static inline Lanes select(Mask8 mask, const Lanes& a, const Lanes& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
[[gnu::always_inline]] static inline Lanes all_of(math::Vec3 v) {
  return {all_of(v.x), all_of(v.y), all_of(v.z)};
}

}  // namespace firmtouch::simd
