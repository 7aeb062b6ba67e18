#pragma once
// A segment against boxes on a grid, with the variants of math/isa.hpp's kind. For the library's own
// translation units.

#include "firmtouch/math/isa_ahead.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::math {

/// A segment in cells of a grid: where it begins, and how far it goes.
struct GridSegment {
  float origin[3], step[3];
};

/// The segment from `a` to `b` on a grid that begins at `low`.
/// Pre: `cell` is a power of two.
///
/// With u = 2^-24 and o the origin in cells: o is off by u |o|, the box check by 2^-9 cells, rate and
/// each plane's difference by 3 u of the plane's distance, at most |o| + 32768: 4 u |o| + 2^-7 in
/// all. Slabs widen boxes by twice that.
static inline GridSegment on_grid(Vec3 a, Vec3 b, const float* low, float cell) {
  const float per_cell = 1.0f / cell;
  return {{(a.x - low[0]) * per_cell, (a.y - low[1]) * per_cell, (a.z - low[2]) * per_cell},
          {(b.x - a.x) * per_cell, (b.y - a.y) * per_cell, (b.z - a.z) * per_cell}};
}

// An axis along which the segment stands still (less than this in cells) has so high a rate that the
// whole segment is inside a slab, or outside. One beyond kFarCells is not reckoned with.
constexpr float kStillCells = 1e-30f;
constexpr float kFarCells = 0x1p60f;
constexpr uint32_t kNotEntered = UINT32_MAX;

/// The slabs of boxes as a segment meets them. A box's word is low | (32767 - high) << 16; turned by
/// `turn` (0 or 16) its low half is the plane where the segment enters, its high half the one where
/// it leaves: entry = (low half - enter) * rate, exit = (leave - high half) * rate, rate > 0 in
/// segments a cell. Boxes are widened by |origin| 2^-21 + 2^-6 cells, rounded.
class PortableSlabs {
 public:
  /// False: the segment is too far off, or not finite; every box is entered at 0.
  bool begin(const GridSegment& segment) {
    bool is_near = true;
    for (uint32_t k = 0; k < 3; ++k) {
      const float origin = segment.origin[k], step = segment.step[k];
      const float offset = origin < 0.0f ? -origin : origin, size = step < 0.0f ? -step : step;
      is_near = is_near && offset <= kFarCells && size <= kFarCells;
      const float slack = offset * 0x1p-21f + 0x1p-6f;
      const float low = origin + slack, high = 32767.0f - (origin - slack);
      turn_[k] = step < 0.0f ? 16u : 0u;
      enter_[k] = step < 0.0f ? high : low;
      leave_[k] = step < 0.0f ? low : high;
      rate_[k] = 1.0f / (size > kStillCells ? size : kStillCells);
    }
    for (uint32_t k = 0; k < 3 && !is_near; ++k) {
      enter_[k] = leave_[k] = 32768.0f;
      rate_[k] = 1.0f;
    }
    return is_near;
  }
  void set_limit(float limit) { limit_ = limit; }

  /// Of two boxes of three words each, a word between them: the bits of the entry where the segment enters no later than
  /// the limit, else kNotEntered.
  void enter(const uint32_t* boxes, uint32_t* key) const {
    for (uint32_t box = 0; box < 2; ++box) {
      float first = 0.0f, last = limit_;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t word = boxes[4 * box + k], turn = turn_[k];
        const uint32_t near_half = (word >> turn) & 0xFFFFu;
        const uint32_t far_half = (word >> (16 - turn)) & 0xFFFFu;
        const float in = (static_cast<float>(near_half) - enter_[k]) * rate_[k];
        const float out = (leave_[k] - static_cast<float>(far_half)) * rate_[k];
        first = in > first ? in : first;
        last = out < last ? out : last;
      }
      key[box] = first <= last ? bits_of(first) : kNotEntered;
    }
  }

 private:
  uint32_t turn_[3];
  float enter_[3], leave_[3], rate_[3];
  float limit_ = 0;
};

/// Twice two boxes against a segment, with a limit of 1.
class PortableFamilySlabs {
 public:
  bool begin(Vec3 a, Vec3 b, const float* low, float cell) {
    slabs_.set_limit(1.0f);
    return slabs_.begin(on_grid(a, b, low, cell));
  }
  /// Of two boxes, each of three words and one more that may be read.
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
  PortableSlabs slabs_;
};

#if FIRMTOUCH_ISA_MOVES
/// The same in lanes, where four boxes take as long as one. The planes where the segment enters are
/// in the low half, those where it leaves in the upper one, where out = -(high half - leave) * rate.
class LaneFamilySlabs {
 public:
  [[gnu::always_inline]] inline bool begin(Vec3 a_in, Vec3 b_in, const float* low_in, float cell) {
    const __m128 a = _mm_setr_ps(a_in.x, a_in.y, a_in.z, 0),
                 b = _mm_setr_ps(b_in.x, b_in.y, b_in.z, 0);
    const __m128 grid_low = _mm_maskload_ps(low_in, _mm_setr_epi32(-1, -1, -1, 0));
    const __m128 per_cell = _mm_set1_ps(float_of((254u << 23) - bits_of(cell)));
    const __m128 origin = _mm_mul_ps(_mm_sub_ps(a, grid_low), per_cell);
    const __m128 step = _mm_mul_ps(_mm_sub_ps(b, a), per_cell), sign = _mm_set1_ps(-0.0f);
    const __m128 offset = _mm_andnot_ps(sign, origin), size = _mm_andnot_ps(sign, step);
    const __m128 slack =
        _mm_add_ps(_mm_mul_ps(offset, _mm_set1_ps(0x1p-21f)), _mm_set1_ps(0x1p-6f));
    const __m128 low = _mm_add_ps(origin, slack);
    const __m128 high = _mm_sub_ps(_mm_set1_ps(32767.0f), _mm_sub_ps(origin, slack));
    const __m128 back = _mm_cmp_ps(step, _mm_setzero_ps(), _CMP_LT_OQ);
    const __m128 one = _mm_set1_ps(1.0f), far = _mm_set1_ps(kFarCells);
    const __m128 is_near = _mm_and_ps(_mm_cmp_ps(offset, far, _CMP_LE_OQ),  // the fourth lane is
                                      _mm_cmp_ps(size, far, _CMP_LE_OQ));
    set(back, _mm_blendv_ps(low, high, back), _mm_blendv_ps(high, low, back),
        _mm_div_ps(one, _mm_max_ps(size, _mm_set1_ps(kStillCells))));
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
using FamilySlabs = LaneFamilySlabs;
#else
using FamilySlabs = PortableFamilySlabs;
#endif

}  // namespace firmtouch::math
