#pragma once
// x86-64 with AVX2: a box is one vector of words. For the library's own translation units.

#include <immintrin.h>

#include "firmtouch/arch/portable/shared.hpp"

namespace firmtouch::math {

/// Correctly rounded by the processor.
static inline float square_root(float value) { return __builtin_sqrtf(value); }

/// The fourth word is all ones: nothing is left of what lies behind a box.
struct BoxPoint {
  __m128i words;
};

static inline BoxPoint box_point(uint32_t x, uint32_t y, uint32_t z) {
  return {_mm_setr_epi32(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z), -1)};
}

static inline bool grid_point(float x, float y, float z, const float* low, float per_part,
                              BoxPoint& point) {
  // What no signed word holds becomes its least, which is outside too.
  const __m128 from_low = _mm_sub_ps(_mm_setr_ps(x, y, z, 0.0f), _mm_loadu_ps(low));
  const __m128i whole = _mm_cvttps_epi32(_mm_mul_ps(from_low, _mm_set1_ps(per_part)));
  const __m128i below = _mm_sub_epi32(_mm_set1_epi32(static_cast<int>(0x800000FFu)), whole);
  const __m128i above = _mm_add_epi32(whole, _mm_set1_epi32(0x10100));
  const __m128i words = _mm_blend_epi16(_mm_srli_epi32(above, 16), below, 0xAA);
  point.words = _mm_or_si128(words, _mm_setr_epi32(0, 0, 0, -1));
  return (_mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(below, above))) & 7) == 0;
}

// The squares of the three axes and 0.
static inline __m128i box_squares(const uint32_t* box, BoxPoint point) {
  const __m128i words = _mm_loadu_si128(static_cast<const __m128i*>(static_cast<const void*>(box)));
  const __m128i gaps = _mm_subs_epu16(words, point.words);
  return _mm_madd_epi16(gaps, gaps);
}

static inline uint32_t box_distance2(const uint32_t* box, const BoxPoint& point) {
  const __m128i squares = box_squares(box, point);
  const __m128i pairs = _mm_add_epi32(squares, _mm_unpackhi_epi64(squares, squares));
  return static_cast<uint32_t>(
      _mm_cvtsi128_si32(_mm_add_epi32(pairs, _mm_shuffle_epi32(pairs, 1))));
}

static inline void side_distances2(const uint32_t* sides, const BoxPoint& point, uint32_t& first,
                                   uint32_t& second, uint32_t& word0, uint32_t& word1) {
  const __m128i a = box_squares(sides, point), b = box_squares(sides + 4, point);
  const __m128i xz = _mm_add_epi32(_mm_unpacklo_epi32(a, b), _mm_unpackhi_epi32(a, b));
  const uint64_t sums =
      static_cast<uint64_t>(_mm_cvtsi128_si64(_mm_add_epi32(xz, _mm_unpackhi_epi64(xz, xz))));
  first = static_cast<uint32_t>(sums);
  second = static_cast<uint32_t>(sums >> 32);
  word0 = sides[3];
  word1 = sides[7];
}

static inline HalfCellPoint half_cell_point(const BoxPoint& point) {
  const uint32_t words[3] = {static_cast<uint32_t>(_mm_extract_epi32(point.words, 0)),
                             static_cast<uint32_t>(_mm_extract_epi32(point.words, 1)),
                             static_cast<uint32_t>(_mm_extract_epi32(point.words, 2))};
  return half_cell_point(words);
}

}  // namespace firmtouch::math
