#pragma once
// A segment against two boxes on a grid, with the variants of math/isa.hpp's kind. For the
// library's own translation units.

#include "firmtouch/math/isa.hpp"

#if defined(__AVX2__)
#define FIRMTOUCH_ISA_SLABS 1
#else
#define FIRMTOUCH_ISA_SLABS 0
#endif

namespace firmtouch::math {

/// A segment in cells of a grid: where it begins, and how far it goes.
struct GridSegment {
  float origin[3], step[3];
};

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

#if FIRMTOUCH_ISA_SLABS
/// The same in lanes. For boxes: x, y, z of one, two lanes that hold 0 and the limit, and
/// x, y, z of the other: as the two loads bring them.
class LaneSlabs {
 public:
  bool begin(const GridSegment& segment) {
    // The fourth lane is one cell off and moves one cell.
    const Floats4 origin = {segment.origin[0], segment.origin[1], segment.origin[2], 1},
                  step = {segment.step[0], segment.step[1], segment.step[2], 1};
    const Floats4 zero = {}, offset = origin < zero ? -origin : origin,
                  size = step < zero ? -step : step;
    const Floats4 still = zero + kStillCells, far = zero + kFarCells;
    const Ints4 is_near = (offset <= far) & (size <= far);
    const Floats4 slack = offset * 0x1p-21f + 0x1p-6f;
    const Floats4 low = origin + slack, high = 32767.0f - (origin - slack);
    const Ints4 back = step < zero;
    const Floats4 one = zero + 1.0f;
    set(Words4(back) & 16u, back ? high : low, back ? low : high,
        one / (size > still ? size : still));
    const Ints4 both = is_near & __builtin_shufflevector(is_near, is_near, 2, 3, 0, 1);
    if ((both[0] & both[1]) != 0) return true;
    set(Words4(back) & 16u, zero + 32768.0f, zero + 32768.0f, one);
    return false;
  }
  void set_limit(float limit) {
    const Floats8 all = Floats8{} + limit;
    rate_ = __builtin_shufflevector(rate_, all, 0, 1, 2, 11, 12, 5, 6, 7);
  }

  void enter(const uint32_t* boxes, uint32_t* key) const {
    // Two loads that stay within the seven words.
    Words4 front, back;
    __builtin_memcpy(&front, boxes, sizeof front);
    __builtin_memcpy(&back, boxes + 3, sizeof back);
    const Words8 words = __builtin_shufflevector(front, back, 0, 1, 2, 3, 4, 5, 6, 7);
    const Words8 half = {0xFFFFu, 0xFFFFu, 0xFFFFu, 0, 0, 0xFFFFu, 0xFFFFu, 0xFFFFu};
    const Words8 near_half = (words >> turn_) & half, far_half = (words >> back_turn_) & half;
    const Floats8 in = (__builtin_convertvector(Ints8(near_half), Floats8) - enter_) * rate_;
    const Floats8 out = (leave_ - __builtin_convertvector(Ints8(far_half), Floats8)) * rate_;
    const Floats8 in_half = __builtin_shufflevector(in, in, 2, 3, 0, 1, 6, 7, 4, 5),
                  out_half = __builtin_shufflevector(out, out, 2, 3, 0, 1, 6, 7, 4, 5);
    const Floats8 in2 = in > in_half ? in : in_half, out2 = out < out_half ? out : out_half;
    const Floats8 in_other = __builtin_shufflevector(in2, in2, 1, 0, 3, 2, 5, 4, 7, 6),
                  out_other = __builtin_shufflevector(out2, out2, 1, 0, 3, 2, 5, 4, 7, 6);
    const Floats8 first = in2 > in_other ? in2 : in_other;
    const Floats8 last = out2 < out_other ? out2 : out_other;
    const Words8 keys = Words8(first) | ~Words8(first <= last);
    key[0] = keys[0];
    key[1] = keys[4];
  }

 private:
  typedef uint32_t Words4 __attribute__((vector_size(16)));
  typedef int32_t Ints4 __attribute__((vector_size(16)));
  typedef float Floats4 __attribute__((vector_size(16)));
  typedef uint32_t Words8 __attribute__((vector_size(32)));
  typedef int32_t Ints8 __attribute__((vector_size(32)));
  typedef float Floats8 __attribute__((vector_size(32)));

  void set(Words4 turn, Floats4 enter, Floats4 leave, Floats4 rate) {
    turn_ = __builtin_shufflevector(turn, turn, 0, 1, 2, 2, 2, 0, 1, 2);
    back_turn_ = 16 - turn_;
    const Floats4 zero = {}, one = zero + 1.0f;
    enter_ = __builtin_shufflevector(enter, zero, 0, 1, 2, 4, 4, 0, 1, 2);
    leave_ = __builtin_shufflevector(leave, one, 0, 1, 2, 4, 4, 0, 1, 2);
    rate_ = __builtin_shufflevector(rate, one, 0, 1, 2, 4, 4, 0, 1, 2);
  }

  Words8 turn_, back_turn_;
  Floats8 enter_, leave_, rate_;
};
using Slabs = LaneSlabs;
#else
using Slabs = PortableSlabs;
#endif

}  // namespace firmtouch::math
