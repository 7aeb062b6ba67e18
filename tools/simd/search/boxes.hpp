#pragma once
// The boxes of sibling nodes against a point. Compiled once per level.

#include "firmtouch/math/isa.hpp"
#include "simd/search/entries.hpp"

namespace firmtouch::simd {
/// Keys of the boxes in two nodes: math::box_distance2() of each.
static inline void portable_sibling_distances2(const uint32_t* ones, const uint32_t* others,
                                               const math::BoxPoint& point, uint64_t& one_keys,
                                               uint64_t& other_keys) {
  one_keys = keys_of(math::box_distance2(ones, point), math::box_distance2(ones + 4, point));
  other_keys = keys_of(math::box_distance2(others, point), math::box_distance2(others + 4, point));
}
static inline void sibling_distances2(const uint32_t* ones, const uint32_t* others,
                                      const math::BoxPoint& point, uint64_t& one_keys,
                                      uint64_t& other_keys) {
#if defined(__AVX2__)
  const auto squares = [&](const uint32_t* boxes) {
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(boxes));
    const __m256i gaps = _mm256_subs_epu16(words, _mm256_broadcastsi128_si256(point.words));
    return _mm256_madd_epi16(gaps, gaps);
  };
  const __m256i a = squares(ones), b = squares(others);
  const __m256i xz = _mm256_add_epi32(_mm256_unpacklo_epi32(a, b), _mm256_unpackhi_epi32(a, b));
  const __m256i sums = _mm256_add_epi32(xz, _mm256_shuffle_epi32(xz, 0x4E));
  const __m128i keys =
      _mm_unpacklo_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  one_keys = static_cast<uint64_t>(_mm_cvtsi128_si64(keys));
  other_keys = static_cast<uint64_t>(_mm_extract_epi64(keys, 1));
#else
  portable_sibling_distances2(ones, others, point, one_keys, other_keys);
#endif
}

/// Compares the boxes of one node, and of two adjacent ones, with `below`. Bit k: the first box of
/// node k is nearer; bit 4 + k: the second is. Other bits mean nothing.
static inline uint32_t portable_boxes_below(const uint32_t* pair, const uint32_t* pairs,
                                            const math::BoxPoint& point, uint32_t below) {
  uint32_t are = 0;
  for (uint32_t k = 0; k < 6; ++k) {
    const uint32_t* const box = k < 2 ? pair + 4 * k : pairs + 4 * (k - 2);
    are |= math::box_distance2(box, point) < below ? 1u << (k / 2 + 4 * (k % 2)) : 0u;
  }
  return are;
}
static inline uint32_t boxes_below(const uint32_t* pair, const uint32_t* pairs,
                                   const math::BoxPoint& point, uint32_t below) {
#if defined(__AVX2__)
  const __m256i at = _mm256_broadcastsi128_si256(point.words);
  const auto squares = [at](const uint32_t* boxes) {
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(boxes));
    const __m256i gaps = _mm256_subs_epu16(words, at);
    return _mm256_madd_epi16(gaps, gaps);
  };
  const __m256i a = squares(pair), b = squares(pairs), c = squares(pairs + 8);
  const __m256i ab = _mm256_add_epi32(_mm256_unpacklo_epi32(a, b), _mm256_unpackhi_epi32(a, b));
  const __m256i cc = _mm256_add_epi32(_mm256_unpacklo_epi32(c, c), _mm256_unpackhi_epi32(c, c));
  const __m256i sums =
      _mm256_add_epi32(_mm256_unpacklo_epi64(ab, cc), _mm256_unpackhi_epi64(ab, cc));
  const __m256i least = _mm256_max_epu32(sums, _mm256_set1_epi32(static_cast<int32_t>(below)));
  const uint32_t beyond = static_cast<uint32_t>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(least, sums))));
  return ~beyond;
#else
  return portable_boxes_below(pair, pairs, point, below);
#endif
}

}  // namespace firmtouch::simd
