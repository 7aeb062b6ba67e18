#pragma once
// Floats side by side, with the variants of math/isa.hpp's kind. For the library's own translation
// units.

#include "firmtouch/math/isa.hpp"

namespace firmtouch::math {

/// Four floats in the compiler's own arithmetic of vectors: each operation rounds as that of one
/// float does. Fast only where kHasLanes says so. FloatWide: as many as the processor takes at once.
typedef float Float4 __attribute__((vector_size(16)));
typedef int32_t Mask4 __attribute__((vector_size(16)));  // of a comparison: 0 or -1
constexpr bool kHasLanes = FIRMTOUCH_ISA_AVX2 != 0;
#if FIRMTOUCH_ISA_AVX2
typedef float FloatWide __attribute__((vector_size(32)));
typedef int32_t MaskWide __attribute__((vector_size(32)));
#else
typedef Float4 FloatWide;
#endif
template <class Float>
constexpr uint32_t kLanesOf = sizeof(Float) / sizeof(float);

/// A vector in each lane.
template <class Float>
struct Lanes {
  Float x, y, z;
};

/// As many floats as a Float holds, one after the other.
template <class Float>
[[gnu::always_inline]] static inline Float lanes_from(const float* p) {
  Float lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return lanes;
}

/// Three floats at each of four places.
static inline Lanes<Float4> portable_gather(const float* p0, const float* p1, const float* p2,
                                            const float* p3) {
  return {Float4{p0[0], p1[0], p2[0], p3[0]}, Float4{p0[1], p1[1], p2[1], p3[1]},
          Float4{p0[2], p1[2], p2[2], p3[2]}};
}

static inline Lanes<Float4> gather(const float* p0, const float* p1, const float* p2,
                                   const float* p3) {
#if FIRMTOUCH_ISA_AVX2
  const __m128i three = _mm_setr_epi32(-1, -1, -1, 0);
  const __m128 a = _mm_maskload_ps(p0, three), b = _mm_maskload_ps(p1, three);
  const __m128 c = _mm_maskload_ps(p2, three), d = _mm_maskload_ps(p3, three);
  const __m128 xy0 = _mm_unpacklo_ps(a, b), xy1 = _mm_unpacklo_ps(c, d);
  const __m128 z0 = _mm_unpackhi_ps(a, b), z1 = _mm_unpackhi_ps(c, d);
  return {_mm_movelh_ps(xy0, xy1), _mm_movehl_ps(xy1, xy0), _mm_movelh_ps(z0, z1)};
#else
  return portable_gather(p0, p1, p2, p3);
#endif
}

// Comparison and choice by name: of operators the compiler makes masks of single bits where the
// target has them, and carries them to and fro.
static inline Mask4 less(Float4 a, Float4 b) {
#if FIRMTOUCH_ISA_AVX2
  return reinterpret_cast<Mask4>(_mm_cmp_ps(a, b, _CMP_LT_OQ));
#else
  return a < b;
#endif
}
static inline Mask4 at_most(Float4 a, Float4 b) {
#if FIRMTOUCH_ISA_AVX2
  return reinterpret_cast<Mask4>(_mm_cmp_ps(a, b, _CMP_LE_OQ));
#else
  return a <= b;
#endif
}
static inline Float4 select(Mask4 mask, Float4 a, Float4 b) {
#if FIRMTOUCH_ISA_AVX2
  return _mm_blendv_ps(b, a, reinterpret_cast<__m128>(mask));
#else
  return mask ? a : b;
#endif
}
static inline Mask4 select(Mask4 mask, Mask4 a, Mask4 b) {
  return reinterpret_cast<Mask4>(
      select(mask, reinterpret_cast<Float4>(a), reinterpret_cast<Float4>(b)));
}

// a > b ? a : b and a < b ? a : b.
static inline Float4 larger(Float4 a, Float4 b) {
#if FIRMTOUCH_ISA_AVX2
  return _mm_max_ps(a, b);
#else
  return select(less(b, a), a, b);
#endif
}
static inline Float4 smaller(Float4 a, Float4 b) {
#if FIRMTOUCH_ISA_AVX2
  return _mm_min_ps(a, b);
#else
  return select(less(a, b), a, b);
#endif
}

/// Bit k: lane k of the mask is set.
static inline uint32_t portable_lanes_of(Mask4 mask) {
  uint32_t bits = 0;
  for (uint32_t k = 0; k < 4; ++k) bits |= mask[k] != 0 ? 1u << k : 0u;
  return bits;
}

static inline uint32_t lanes_of(Mask4 mask) {
#if FIRMTOUCH_ISA_AVX2
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return portable_lanes_of(mask);
#endif
}

/// The least of the lanes `of`, and the first that holds it.
/// Pre: one lane or more, all below kMaxLeast.
constexpr float kMaxLeast = 0x1.fffffep127f;
template <class Float>
static inline uint32_t portable_least_lane(Float v, uint32_t of, float& least) {
  uint32_t lane = static_cast<uint32_t>(__builtin_ctz(of));
  for (uint32_t left = of; left != 0; left &= left - 1) {
    const uint32_t k = static_cast<uint32_t>(__builtin_ctz(left));
    lane = v[k] < v[lane] ? k : lane;
  }
  least = v[lane];
  return lane;
}
static inline uint32_t min_lane(Float4 v, uint32_t of, float& least) {
  return portable_least_lane(v, of, least);
}
/// The least alone; of no lanes kMaxLeast.
template <class Float>
static inline float portable_least_of(Float v, uint32_t of) {
  float least = kMaxLeast;
  for (uint32_t left = of; left != 0; left &= left - 1) {
    const uint32_t k = static_cast<uint32_t>(__builtin_ctz(left));
    least = v[k] < least ? v[k] : least;
  }
  return least;
}
static inline float least_of(Float4 v, uint32_t of) { return portable_least_of(v, of); }

#if FIRMTOUCH_ISA_AVX2
// The same of eight.
static inline Lanes<FloatWide> gather(const float* p0, const float* p1, const float* p2,
                                      const float* p3, const float* p4, const float* p5,
                                      const float* p6, const float* p7) {
  const __m128i three = _mm_setr_epi32(-1, -1, -1, 0);
  const auto pair = [&](const float* low, const float* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_maskload_ps(low, three)),
                                _mm_maskload_ps(high, three), 1);
  };
  const __m256 a = pair(p0, p4), b = pair(p1, p5), c = pair(p2, p6), d = pair(p3, p7);
  const __m256 xy0 = _mm256_unpacklo_ps(a, b), xy1 = _mm256_unpacklo_ps(c, d);
  const __m256 z0 = _mm256_unpackhi_ps(a, b), z1 = _mm256_unpackhi_ps(c, d);
  return {_mm256_shuffle_ps(xy0, xy1, 0x44), _mm256_shuffle_ps(xy0, xy1, 0xEE),
          _mm256_shuffle_ps(z0, z1, 0x44)};
}
static inline MaskWide less(FloatWide a, FloatWide b) {
  return reinterpret_cast<MaskWide>(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}
static inline MaskWide at_most(FloatWide a, FloatWide b) {
  return reinterpret_cast<MaskWide>(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}
static inline FloatWide select(MaskWide mask, FloatWide a, FloatWide b) {
  return _mm256_blendv_ps(b, a, reinterpret_cast<__m256>(mask));
}
static inline MaskWide select(MaskWide mask, MaskWide a, MaskWide b) {
  return reinterpret_cast<MaskWide>(
      select(mask, reinterpret_cast<FloatWide>(a), reinterpret_cast<FloatWide>(b)));
}
// In each lane the least of `of`; in `all` the lanes that are none hold kMaxLeast.
static inline __m256 min_everywhere(FloatWide v, uint32_t of, __m256& all) {
  const __m256i bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i is_of =
      _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(of)), bits), bits);
  all = _mm256_blendv_ps(_mm256_set1_ps(kMaxLeast), v, _mm256_castsi256_ps(is_of));
  __m256 least = _mm256_min_ps(all, _mm256_permute_ps(all, 0x4E));
  least = _mm256_min_ps(least, _mm256_permute_ps(least, 0xB1));
  return _mm256_min_ps(least, _mm256_permute2f128_ps(least, least, 1));
}
static inline uint32_t min_lane(FloatWide v, uint32_t of, float& reported) {
  __m256 all;
  const __m256 least = min_everywhere(v, of, all);
  reported = _mm256_cvtss_f32(least);
  return static_cast<uint32_t>(__builtin_ctz(
      static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(all, least, _CMP_EQ_OQ)))));
}
static inline float least_of(FloatWide v, uint32_t of) {
  __m256 all;
  return _mm256_cvtss_f32(min_everywhere(v, of, all));
}
static inline FloatWide larger(FloatWide a, FloatWide b) { return _mm256_max_ps(a, b); }
static inline FloatWide smaller(FloatWide a, FloatWide b) { return _mm256_min_ps(a, b); }
static inline uint32_t lanes_of(MaskWide mask) {
  return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}
#endif

}  // namespace firmtouch::math
