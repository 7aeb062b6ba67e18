#pragma once
// A segment against four boxes at once. Compiled once per level.

#include "firmtouch/math/slabs.hpp"
#include "simd/search/entries.hpp"

namespace firmtouch::simd {

/// The boxes in two nodes against a segment, with a limit of 1.
class PortableSiblingSlabs {
 public:
  bool begin(math::Vec3 a, math::Vec3 b, const float* low, float cell,
             float slack_cells = math::kSlabSlackCells) {
    slabs_.set_limit(1.0f);
    return slabs_.begin(math::on_grid(a, b, low, cell), slack_cells);
  }
  /// Keys of the boxes in one node.
  uint64_t enter_two(const uint32_t* boxes) const {
    uint32_t key[2];
    slabs_.enter(boxes, key);
    return keys_of(key[0], key[1]);
  }
  void enter(const uint32_t* ones, const uint32_t* others, uint64_t& one_keys,
             uint64_t& other_keys) const {
    one_keys = enter_two(ones);
    other_keys = enter_two(others);
  }

 private:
  math::Slabs slabs_;
};

#if defined(__AVX2__)
/// The same with AVX2: four boxes at once. The low half of a vector holds the planes where the
/// segment enters, the high half those where it leaves, with out = -(high half - leave) * rate.
class LaneSiblingSlabs {
 public:
  [[gnu::always_inline]] inline bool begin(math::Vec3 a_in, math::Vec3 b_in, const float* low_in,
                                           float cell, float slack_cells = math::kSlabSlackCells) {
    const __m128 a = _mm_setr_ps(a_in.x, a_in.y, a_in.z, 0),
                 b = _mm_setr_ps(b_in.x, b_in.y, b_in.z, 0);
    const __m128 grid_low = _mm_maskload_ps(low_in, _mm_setr_epi32(-1, -1, -1, 0));
    const __m128 per_cell = _mm_set1_ps(math::float_of((254u << 23) - math::bits_of(cell)));
    const __m128 origin = _mm_mul_ps(_mm_sub_ps(a, grid_low), per_cell);
    const __m128 step = _mm_mul_ps(_mm_sub_ps(b, a), per_cell), sign = _mm_set1_ps(-0.0f);
    const __m128 offset = _mm_andnot_ps(sign, origin), size = _mm_andnot_ps(sign, step);
    const __m128 slack =
        _mm_add_ps(_mm_mul_ps(offset, _mm_set1_ps(0x1p-21f)), _mm_set1_ps(slack_cells));
    const __m128 low = _mm_add_ps(origin, slack);
    const __m128 high = _mm_sub_ps(_mm_set1_ps(32767.0f), _mm_sub_ps(origin, slack));
    const __m128 back = _mm_cmp_ps(step, _mm_setzero_ps(), _CMP_LT_OQ);
    const __m128 one = _mm_set1_ps(1.0f), far = _mm_set1_ps(math::kFarCells);
    const __m128 is_near = _mm_and_ps(_mm_cmp_ps(offset, far, _CMP_LE_OQ),  // the fourth lane is
                                      _mm_cmp_ps(size, far, _CMP_LE_OQ));
    set(back, _mm_blendv_ps(low, high, back), _mm_blendv_ps(high, low, back),
        _mm_div_ps(one, _mm_max_ps(size, _mm_set1_ps(math::kStillCells))));
    if (_mm_movemask_ps(is_near) == 15) return true;
    set(back, _mm_set1_ps(32768.0f), _mm_set1_ps(32768.0f), one);
    return false;
  }

  uint64_t enter_two(const uint32_t* boxes) const {
    uint64_t keys, again;
    enter(boxes, boxes, keys, again);
    return keys;
  }
  void enter(const uint32_t* ones, const uint32_t* others, uint64_t& one_keys,
             uint64_t& other_keys) const {
    const __m256i a = twice(ones), b = twice(ones + 4), c = twice(others), d = twice(others + 4);
    const __m256i xy0 = _mm256_unpacklo_epi32(a, b), xy1 = _mm256_unpacklo_epi32(c, d);
    const __m256i z0 = _mm256_unpackhi_epi32(a, b), z1 = _mm256_unpackhi_epi32(c, d);
    const __m256 x = times(_mm256_unpacklo_epi64(xy0, xy1), 0),
                 y = times(_mm256_unpackhi_epi64(xy0, xy1), 1),
                 z = times(_mm256_unpacklo_epi64(z0, z1), 2);
    const __m256 ends = _mm256_setr_ps(0, 0, 0, 0, -1, -1, -1, -1);
    const __m256 last_of = _mm256_max_ps(_mm256_max_ps(x, y), _mm256_max_ps(z, ends));
    const __m128 first = _mm256_castps256_ps128(last_of);
    const __m128 last = _mm_xor_ps(_mm256_extractf128_ps(last_of, 1), _mm_set1_ps(-0.0f));
    const __m128i keys = _mm_castps_si128(_mm_or_ps(first, _mm_cmp_ps(first, last, _CMP_NLE_UQ)));
    one_keys = static_cast<uint64_t>(_mm_cvtsi128_si64(keys));
    other_keys = static_cast<uint64_t>(_mm_extract_epi64(keys, 1));
  }

 private:
  static __m256i twice(const uint32_t* box) {
    return _mm256_broadcastsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(box)));
  }
  // Of one axis of four boxes.
  __m256 times(__m256i words, int axis) const {
    const __m256 planes = _mm256_cvtepi32_ps(_mm256_shuffle_epi8(words, pick_[axis]));
    return _mm256_mul_ps(_mm256_sub_ps(planes, plane_[axis]), rate_[axis]);
  }
  void set(__m128 back, __m128 enter, __m128 leave, __m128 rate) {
    const __m256 planes = _mm256_set_m128(leave, enter), rates = _mm256_set_m128(rate, rate);
    // Bytes of the low half of each word, or two bytes on.
    const __m128i words =
        _mm_setr_epi32(static_cast<int>(0x80800100), static_cast<int>(0x80800504),
                       static_cast<int>(0x80800908), static_cast<int>(0x80800D0C));
    const __m128i two = _mm_set1_epi32(0x0202), turn = _mm_castps_si128(back);
    const __m256i turns = _mm256_set_m128i(_mm_andnot_si128(turn, two), _mm_and_si128(turn, two));
    const __m256i picks = _mm256_set_m128i(words, words);
    pick_[0] = _mm256_add_epi32(picks, _mm256_shuffle_epi32(turns, 0x00));
    pick_[1] = _mm256_add_epi32(picks, _mm256_shuffle_epi32(turns, 0x55));
    pick_[2] = _mm256_add_epi32(picks, _mm256_shuffle_epi32(turns, 0xAA));
    plane_[0] = _mm256_permute_ps(planes, 0x00), rate_[0] = _mm256_permute_ps(rates, 0x00);
    plane_[1] = _mm256_permute_ps(planes, 0x55), rate_[1] = _mm256_permute_ps(rates, 0x55);
    plane_[2] = _mm256_permute_ps(planes, 0xAA), rate_[2] = _mm256_permute_ps(rates, 0xAA);
  }

  __m256i pick_[3];
  __m256 plane_[3], rate_[3];
};
using SiblingSlabs = LaneSiblingSlabs;
#else
using SiblingSlabs = PortableSiblingSlabs;
#endif

}  // namespace firmtouch::simd
