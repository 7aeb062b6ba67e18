#pragma once
// search/vectors.hpp with AVX2.

#include <immintrin.h>
#include <stdint.h>

namespace firmtouch::simd {

typedef float Float8 __attribute__((vector_size(32)));
typedef int32_t Mask8 __attribute__((vector_size(32)));  // of a comparison: 0 or -1

/// Eight consecutive floats.
[[gnu::always_inline]] static inline Float8 lanes_from(const float* p) {
  return _mm256_loadu_ps(p);
}
[[gnu::always_inline]] static inline Float8 all_of(float v) { return _mm256_set1_ps(v); }
[[gnu::always_inline]] static inline Mask8 all_of_bits(int32_t v) {
  return reinterpret_cast<Mask8>(_mm256_set1_epi32(v));
}
[[gnu::always_inline]] static inline float lane_of(Float8 v, uint32_t lane) { return v[lane]; }
[[gnu::always_inline]] static inline int32_t lane_of(Mask8 v, uint32_t lane) { return v[lane]; }

// Comparison and selection by name: from operators the compiler makes AVX-512 masks, and moves them
// to and from vectors.
[[gnu::always_inline]] static inline Mask8 less(Float8 a, Float8 b) {
  return reinterpret_cast<Mask8>(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}
[[gnu::always_inline]] static inline Mask8 at_most(Float8 a, Float8 b) {
  return reinterpret_cast<Mask8>(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}
[[gnu::always_inline]] static inline Float8 select(Mask8 mask, Float8 a, Float8 b) {
  return _mm256_blendv_ps(b, a, reinterpret_cast<__m256>(mask));
}
[[gnu::always_inline]] static inline Mask8 select(Mask8 mask, Mask8 a, Mask8 b) {
  return reinterpret_cast<Mask8>(
      select(mask, reinterpret_cast<Float8>(a), reinterpret_cast<Float8>(b)));
}
/// 0 where the mask is not set: x - 0 is x to the bit.
[[gnu::always_inline]] static inline Float8 only(Mask8 mask, Float8 v) {
  return reinterpret_cast<Float8>(reinterpret_cast<Mask8>(v) & mask);
}
// a > b ? a : b and a < b ? a : b.
[[gnu::always_inline]] static inline Float8 larger(Float8 a, Float8 b) {
  return _mm256_max_ps(a, b);
}
[[gnu::always_inline]] static inline Float8 smaller(Float8 a, Float8 b) {
  return _mm256_min_ps(a, b);
}
/// Bit k: lane k of the mask is set.
[[gnu::always_inline]] static inline uint32_t bits_of(Mask8 mask) {
  return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}

constexpr float kMaxMinimum = 0x1.fffffep127f;
// In each lane the minimum of the lanes `of`; in `all` the other lanes hold kMaxMinimum.
[[gnu::always_inline]] static inline __m256 minimum_everywhere(Float8 v, uint32_t of, __m256& all) {
  const __m256i bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i is_of =
      _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(of)), bits), bits);
  all = _mm256_blendv_ps(_mm256_set1_ps(kMaxMinimum), v, _mm256_castsi256_ps(is_of));
  __m256 least = _mm256_min_ps(all, _mm256_permute_ps(all, 0x4E));
  least = _mm256_min_ps(least, _mm256_permute_ps(least, 0xB1));
  return _mm256_min_ps(least, _mm256_permute2f128_ps(least, least, 1));
}
/// The first of the lanes `of` that holds their minimum. Pre: one lane or more, all below
/// kMaxMinimum.
[[gnu::always_inline]] static inline uint32_t minimum_lane(Float8 v, uint32_t of, float& minimum) {
  __m256 all;
  const __m256 least = minimum_everywhere(v, of, all);
  minimum = _mm256_cvtss_f32(least);
  return static_cast<uint32_t>(__builtin_ctz(
      static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(all, least, _CMP_EQ_OQ)))));
}
/// The minimum alone; of no lanes kMaxMinimum.
[[gnu::always_inline]] static inline float minimum_of(Float8 v, uint32_t of) {
  __m256 all;
  return _mm256_cvtss_f32(minimum_everywhere(v, of, all));
}

}  // namespace firmtouch::simd
