#pragma once
// What FPv4 and FPv5 share: pairs of 16-bit lanes by the DSP extension; two words a load, at any
// word's address. For the library's own translation units.

#include <arm_acle.h>

#include "firmtouch/math/portable.hpp"

namespace firmtouch::math {

using portable::box_point;
using portable::BoxPoint;
using portable::half_cell_point;

/// Correctly rounded by the processor.
static inline float square_root(float value) { return __builtin_sqrtf(value); }

/// By one rounding more than the product: VFMA.
static inline float product_error(float a, float b, float product) {
  return __builtin_fabsf(product) >= portable::kMinProduct ? __builtin_fmaf(a, b, -product) : 0.0f;
}

static inline uint32_t saturated(float value) {
  uint32_t whole;
  __asm__("vcvt.u32.f32 %0, %1" : "=t"(whole) : "t"(value));
  return whole;
}

static inline bool grid_point(float x, float y, float z, const float* low, float per_part,
                              BoxPoint& point) {
  uint32_t outside = 0;
  const uint32_t x_word = portable::grid_word(saturated((x - low[0]) * per_part), outside),
                 y_word = portable::grid_word(saturated((y - low[1]) * per_part), outside),
                 z_word = portable::grid_word(saturated((z - low[2]) * per_part), outside);
  point = box_point(x_word, y_word, z_word);
  return (outside >> 31) == 0;
}

/// Without a word read behind the box.
static inline uint32_t box_distance2(const uint32_t* box, const uint32_t* point) {
  const int16x2_t x = static_cast<int16x2_t>(__uqsub16(box[0], point[0]));
  const int16x2_t y = static_cast<int16x2_t>(__uqsub16(box[1], point[1]));
  const int16x2_t z = static_cast<int16x2_t>(__uqsub16(box[2], point[2]));
  return static_cast<uint32_t>(__smlad(z, z, __smlad(y, y, __smuad(x, x))));
}

// Two neighbouring words by one instruction, where the compiler takes two.
template <int kOffset>
static inline void load_pair(const uint32_t* from, uint32_t& first, uint32_t& second) {
  struct Pair {
    uint32_t word[2];
  };
  __asm__("ldrd %0, %1, [%2, %3]"
          : "=r"(first), "=r"(second)
          : "r"(from), "I"(kOffset), "m"(*reinterpret_cast<const Pair*>(from + kOffset / 4)));
}

/// Pre: a word may be read behind the box.
static inline uint32_t box_distance2(const uint32_t* box, const BoxPoint& point) {
  uint32_t words[3];
  load_pair<0>(box, words[0], words[1]);
  words[2] = box[2];
  return box_distance2(words, point.words);
}

static inline void side_distances2(const uint32_t* sides, const BoxPoint& point, uint32_t& first,
                                   uint32_t& second, uint32_t& word0, uint32_t& word1) {
  uint32_t box0[3], box1[3];
  load_pair<0>(sides, box0[0], box0[1]);
  load_pair<8>(sides, box0[2], word0);
  load_pair<16>(sides, box1[0], box1[1]);
  load_pair<24>(sides, box1[2], word1);
  first = box_distance2(box0, point.words);
  second = box_distance2(box1, point.words);
}

/// 26 instructions.
[[gnu::always_inline]] static inline uint32_t oriented_distance2(const uint32_t* box,
                                                                 const HalfCellPoint& point) {
  const auto lanes = [](uint32_t word) { return static_cast<int16x2_t>(word); };
  const auto absolute = [](int32_t value) { return static_cast<uint32_t>(value ^ (value >> 31)); };
  uint32_t half01, half2, centre_xy, mixed, xy0, xy1, xy2, z01, point_xy, point_z;
  load_pair<8>(box, centre_xy, mixed);
  load_pair<0>(&point.xy, point_xy, point_z);
  const int16x2_t xy = __qsub16(lanes(point_xy), lanes(centre_xy));
  const int16x2_t z = __qsub16(lanes(point_z), lanes(mixed));
  load_pair<16>(box, xy0, xy1);
  load_pair<24>(box, xy2, z01);
  const uint32_t off0 = absolute(__smlabb(static_cast<int32_t>(z01), z, __smuad(lanes(xy0), xy)));
  const uint32_t off1 = absolute(__smlatb(static_cast<int32_t>(z01), z, __smuad(lanes(xy1), xy)));
  const uint32_t off2 = absolute(__smlatb(static_cast<int32_t>(mixed), z, __smuad(lanes(xy2), xy)));
  uint32_t off01;  // both in whole cells
  __asm__("pkhtb %0, %1, %2, asr #16" : "=r"(off01) : "r"(off1), "r"(off0));
  load_pair<0>(box, half01, half2);
  const int16x2_t gaps01 = static_cast<int16x2_t>(__uqsub16(off01, half01));
  const int16x2_t gap2 = static_cast<int16x2_t>(__uqsub16(off2, half2));
  return static_cast<uint32_t>(__smlad(gap2, gap2, __smuad(gaps01, gaps01)));
}

static inline uint32_t as_multiplier(uint32_t value) {
  __asm__("" : "+r"(value));
  return value;
}

static inline uint32_t only_here(uint32_t value) {
  __asm__ volatile("" : "+r"(value));
  return value;
}

static inline float in_register(float constant) {
  __asm__("" : "+t"(constant));
  return constant;
}

[[gnu::always_inline]] static inline void push_pair(uint32_t*& top, uint32_t first,
                                                    uint32_t second) {
  struct Pair {
    uint32_t word[2];
  };
  Pair& pair = *reinterpret_cast<Pair*>(top);
  __asm__("strd %2, %3, [%0], #8" : "+r"(top), "=m"(pair) : "r"(first), "r"(second));
}

/// By one instruction that the branch reads: a compiler that counts early compares once more.
[[gnu::always_inline]] static inline bool count_down(uint32_t& count) {
#if defined(__GCC_ASM_FLAG_OUTPUTS__)
  bool is_left;
  __asm__("subs %0, %0, #1" : "+r"(count), "=@ccne"(is_left));
  return is_left;
#else
  return --count != 0;
#endif
}

template <class Index>
[[gnu::always_inline]] static inline uint32_t next_of(const Index*& from) {
  uint32_t value;
  if constexpr (sizeof(Index) == 2)
    __asm__("ldrh %0, [%1], #2" : "=r"(value), "+r"(from) : "m"(*from));
  else
    __asm__("ldr %0, [%1], #4" : "=r"(value), "+r"(from) : "m"(*from));
  return value;
}

/// One instruction, which needs registers in a row: those of kBlock.
template <int kBlock>
[[gnu::always_inline]] static inline void load_floats(const float* from, float& x, float& y,
                                                      float& z) {
  struct Block {
    float value[3];
  };
  const Block& source = *reinterpret_cast<const Block*>(from);
  if constexpr (kBlock == 0) {
    register float first __asm__("s0"), second __asm__("s1"), third __asm__("s2");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  } else if constexpr (kBlock == 1) {
    register float first __asm__("s3"), second __asm__("s4"), third __asm__("s5");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  } else {
    register float first __asm__("s6"), second __asm__("s7"), third __asm__("s8");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  }
}

[[gnu::always_inline]] static inline void load_kept(const float* from, float (&to)[5]) {
  struct Block {
    float value[5];
  };
  register float v0 __asm__("s16"), v1 __asm__("s17"), v2 __asm__("s18"), v3 __asm__("s19"),
      v4 __asm__("s20");
  __asm__("vldmia %5, {%0-%4}"
          : "=t"(v0), "=t"(v1), "=t"(v2), "=t"(v3), "=t"(v4)
          : "r"(from), "m"(*reinterpret_cast<const Block*>(from)));
  to[0] = v0, to[1] = v1, to[2] = v2, to[3] = v3, to[4] = v4;
}

}  // namespace firmtouch::math
