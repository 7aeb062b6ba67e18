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

/// A segment as the slabs of boxes see it. A box's word is low | (32767 - high) << 16; turned by
/// `turn` (0 or 16) its low half is the plane where the segment enters, its high half the one where
/// it leaves: entry = (low half - enter) * rate, exit = (leave - high half) * rate, with rate > 0 in
/// segments a cell.
struct SegmentSlabs {
  uint32_t turn[3];
  float enter[3], leave[3], rate[3];
};

/// Entry of the segment into two boxes of three words each, a word between them, and which of them it enters no later
/// than `limit`: bit 0 the first, bit 1 the second. Only differences, products and comparisons.
static inline uint32_t portable_entered(const SegmentSlabs& slabs, const uint32_t* boxes,
                                        float limit, float* entry) {
  uint32_t entered = 0;
  for (uint32_t box = 0; box < 2; ++box) {
    float first = 0.0f, last = limit;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t word = boxes[4 * box + k], turn = slabs.turn[k];
      const uint32_t near_half = (word >> turn) & 0xFFFFu;
      const uint32_t far_half = (word >> (16 - turn)) & 0xFFFFu;
      const float in = (static_cast<float>(near_half) - slabs.enter[k]) * slabs.rate[k];
      const float out = (slabs.leave[k] - static_cast<float>(far_half)) * slabs.rate[k];
      first = in > first ? in : first;
      last = out < last ? out : last;
    }
    entry[box] = first;
    entered |= (first <= last ? 1u : 0u) << box;
  }
  return entered;
}

#if FIRMTOUCH_ISA_SLABS
/// The same with both boxes in eight lanes: x of both, y, z, and two lanes that hold 0 and limit.
class SlabLanes {
 public:
  explicit SlabLanes(const SegmentSlabs& s)
      : turn_{s.turn[0], s.turn[0], s.turn[1], s.turn[1], s.turn[2], s.turn[2], 0, 0},
        enter_{s.enter[0], s.enter[0], s.enter[1], s.enter[1], s.enter[2], s.enter[2], 0, 0},
        leave_{s.leave[0], s.leave[0], s.leave[1], s.leave[1], s.leave[2], s.leave[2], 1, 1},
        rate_{s.rate[0], s.rate[0], s.rate[1], s.rate[1], s.rate[2], s.rate[2], 1, 1} {}
  void set_limit(float limit) { rate_[6] = rate_[7] = limit; }

  uint32_t entered(const uint32_t* boxes, float* entry) const {
    Words8 both;  // with a word behind the second, which is never looked at
    __builtin_memcpy(&both, boxes, sizeof both);
    const Words8 words = __builtin_shufflevector(both, both, 0, 4, 1, 5, 2, 6, 0, 0);
    const Words8 half = {0xFFFFu, 0xFFFFu, 0xFFFFu, 0xFFFFu, 0xFFFFu, 0xFFFFu, 0, 0};
    const Words8 near_half = (words >> turn_) & half;
    const Words8 far_half = (words >> (16 - turn_)) & half;
    const Floats8 in = (__builtin_convertvector(Ints8(near_half), Floats8) - enter_) * rate_;
    const Floats8 out = (leave_ - __builtin_convertvector(Ints8(far_half), Floats8)) * rate_;
    const Floats4 in_low = __builtin_shufflevector(in, in, 0, 1, 2, 3),
                  in_high = __builtin_shufflevector(in, in, 4, 5, 6, 7);
    const Floats4 out_low = __builtin_shufflevector(out, out, 0, 1, 2, 3),
                  out_high = __builtin_shufflevector(out, out, 4, 5, 6, 7);
    const Floats4 in2 = in_low > in_high ? in_low : in_high;
    const Floats4 out2 = out_low < out_high ? out_low : out_high;
    const Floats4 in_other = __builtin_shufflevector(in2, in2, 2, 3, 2, 3);
    const Floats4 out_other = __builtin_shufflevector(out2, out2, 2, 3, 2, 3);
    const Floats4 first = in2 > in_other ? in2 : in_other;
    const Floats4 last = out2 < out_other ? out2 : out_other;
    entry[0] = first[0];
    entry[1] = first[1];
    return (first[0] <= last[0] ? 1u : 0u) | (first[1] <= last[1] ? 2u : 0u);
  }

 private:
  typedef uint32_t Words8 __attribute__((vector_size(32)));
  typedef int32_t Ints8 __attribute__((vector_size(32)));
  typedef float Floats8 __attribute__((vector_size(32)));
  typedef float Floats4 __attribute__((vector_size(16)));
  Words8 turn_;
  Floats8 enter_, leave_, rate_;
};
#else
class SlabLanes {
 public:
  explicit SlabLanes(const SegmentSlabs& slabs) : slabs_(slabs) {}
  void set_limit(float limit) { limit_ = limit; }
  uint32_t entered(const uint32_t* boxes, float* entry) const {
    return portable_entered(slabs_, boxes, limit_, entry);
  }

 private:
  SegmentSlabs slabs_;
  float limit_ = 0;
};
#endif

}  // namespace firmtouch::math
