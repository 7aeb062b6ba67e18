#pragma once
// The few places where the instruction set matters. Each has one portable definition, which says
// what it computes, and variants that give the same bits (tests/math/isa_test.cpp). No other file
// of the firmware depends on the target. For the library's own translation units: a user's flags
// must not decide what is computed here.

#include <stdint.h>

// Not every compiler defines these macros: arithmetic_is_sound() checks the effect of the flags.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "Firmtouch promises the same bits everywhere: build it without -ffast-math and its parts"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0
#error "Firmtouch refuses NaN by comparing it: build it without -ffinite-math-only"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "Firmtouch needs float computed as float, not in a wider type (x86: -mfpmath=sse -msse2)"
#endif

#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#define FIRMTOUCH_ISA_DSP 1
#else
#define FIRMTOUCH_ISA_DSP 0
#endif

// Two words a load, at any word's address, into any two registers.
#if FIRMTOUCH_ISA_DSP && defined(__thumb2__)
#define FIRMTOUCH_ISA_PAIRS 1
#else
#define FIRMTOUCH_ISA_PAIRS 0
#endif

#if FIRMTOUCH_ISA_PAIRS && defined(__ARM_FP) && (__ARM_FP & 4)
#define FIRMTOUCH_ISA_BLOCKS 1
#else
#define FIRMTOUCH_ISA_BLOCKS 0
#endif

// No compiler macro separates the FPv5 of a Cortex-M7 from the FPv4 of a Cortex-M4:
// cmake/firmtouch_options.cmake reads it from the flags.
#if defined(FIRMTOUCH_HAS_VMAXNM) && defined(__ARM_FP) && (__ARM_FP & 4)
#define FIRMTOUCH_ISA_MAXNM 1
#else
#define FIRMTOUCH_ISA_MAXNM 0
#endif

#if defined(__AVX2__)
#include <immintrin.h>
#define FIRMTOUCH_ISA_AVX2 1
#else
#define FIRMTOUCH_ISA_AVX2 0
#endif

#if defined(__SSE2__) || defined(__riscv_flen) || (defined(__ARM_FP) && (__ARM_FP & 4))
#define FIRMTOUCH_ISA_SQRT 1
#else
#define FIRMTOUCH_ISA_SQRT 0
#endif

namespace firmtouch::math {

static inline uint32_t bits_of(float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return bits;
}

static inline float float_of(uint32_t bits) {
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}

/// Correctly rounded square root in integer arithmetic: one result bit a turn. Negative or NaN:
/// canonical NaN.
static inline float portable_square_root(float value) {
  uint32_t bits = bits_of(value);
  if (bits == 0 || bits == 0x80000000u) return value;
  if (bits >= 0x7F800000u) return bits == 0x7F800000u ? value : float_of(0x7FC00000u);
  int32_t exponent = static_cast<int32_t>(bits >> 23);
  uint32_t mantissa = bits & 0x7FFFFFu;
  if (exponent == 0) {
    const int32_t shift = __builtin_clz(mantissa) - 8;
    mantissa <<= shift;
    exponent = 1 - shift;
  } else {
    mantissa |= 0x800000u;
  }
  exponent -= 127;
  uint64_t radicand = static_cast<uint64_t>(mantissa) << ((exponent & 1) ? 26 : 25);
  const int32_t half = (exponent - (exponent & 1)) / 2;
  uint64_t root = 0;
  for (uint64_t bit = uint64_t{1} << 50; bit != 0; bit >>= 2) {  // digit by digit
    if (radicand >= root + bit) {
      radicand -= root + bit;
      root = (root >> 1) + bit;
    } else {
      root >>= 1;
    }
  }
  uint32_t rounded = static_cast<uint32_t>(root >> 1);  // 24 bits and the half bit below them
  // A root is never half-way: sticky decides.
  if ((root & 1) && (radicand != 0 || (rounded & 1))) ++rounded;
  return float_of((static_cast<uint32_t>(half + 127) << 23) + (rounded - 0x800000u));
}

/// Square root, correctly rounded.
static inline float square_root(float value) {
#if FIRMTOUCH_ISA_SQRT
  return __builtin_sqrtf(value);
#else
  return portable_square_root(value);
#endif
}

/// The larger and the smaller of two; the limit if the value is NaN.
/// Pre: the limit is finite, for larger() not -0, for smaller() no zero; no signalling NaN.
static inline float portable_larger(float value, float limit) {
  return value > limit ? value : limit;
}
static inline float portable_smaller(float value, float limit) {
  return value < limit ? value : limit;
}

static inline float larger(float value, float limit) {
#if FIRMTOUCH_ISA_MAXNM
  float most;
  __asm__("vmaxnm.f32 %0, %1, %2" : "=t"(most) : "t"(value), "t"(limit));
  return most;
#else
  return portable_larger(value, limit);
#endif
}
static inline float smaller(float value, float limit) {
#if FIRMTOUCH_ISA_MAXNM
  float least;
  __asm__("vminnm.f32 %0, %1, %2" : "=t"(least) : "t"(value), "t"(limit));
  return least;
#else
  return portable_smaller(value, limit);
#endif
}

/// Without its fraction; the nearest that a word can hold; 0 for NaN.
static inline uint32_t portable_saturated(float value) {
  if (!(value > 0.0f)) return 0;
  return value < 0x1p32f ? static_cast<uint32_t>(value) : UINT32_MAX;
}

static inline uint32_t saturated(float value) {
#if FIRMTOUCH_ISA_BLOCKS
  uint32_t whole;
  __asm__("vcvt.u32.f32 %0, %1" : "=t"(whole) : "t"(value));
  return whole;
#else
  return portable_saturated(value);
#endif
}

/// Squared distance, in cells, from a point to a box on a grid of 15-bit coordinates; never more
/// than the true one. box[k] = low | (32767 - high) << 16 for axis k; point[k] = ceil(p) | (32767 -
/// floor(p)) << 16. Each half of the saturating difference is max(low - p, 0) or max(p - high, 0),
/// and at most one is not zero.
static inline uint32_t portable_box_distance2(const uint32_t* box, const uint32_t* point) {
  uint32_t sum = 0;
  for (int k = 0; k < 3; ++k) {
    const uint32_t low = box[k] & 0xFFFFu, p_low = point[k] & 0xFFFFu;
    const uint32_t high = box[k] >> 16, p_high = point[k] >> 16;
    const uint32_t below = low > p_low ? low - p_low : 0, above = high > p_high ? high - p_high : 0;
    sum += below * below + above * above;
  }
  return sum;
}

/// A query packed for box_distance2(), in the shape that the processor takes fastest.
struct BoxPoint {
#if FIRMTOUCH_ISA_AVX2
  __m128i words;  // the fourth is all ones: nothing is left of what lies behind a box
#else
  uint32_t words[3];
#endif
};

static inline BoxPoint box_point(uint32_t x, uint32_t y, uint32_t z) {
#if FIRMTOUCH_ISA_AVX2
  return {_mm_setr_epi32(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z), -1)};
#else
  return {{x, y, z}};
#endif
}

/// A coordinate in 65536ths of a cell as a word of a point, 2^-8 cells wider to either side and
/// then to whole cells. The top bit of `outside` is set where it is not inside the grid.
static inline uint32_t portable_grid_word(float parts, uint32_t& outside) {
  // Exact except for the fraction that is cut off. 256 less, rounded down to cells, and 256 more
  // than what may have been cut off, rounded up.
  const uint32_t whole = saturated(parts);
  const uint32_t below = 0x7FFFFFFFu - (whole - 256), above = whole + 0x10100u;
  outside |= below | above;
  return (below & 0xFFFF0000u) | (above >> 16);
}
static inline bool portable_grid_point(float x, float y, float z, const float* low, float per_part,
                                       BoxPoint& point) {
  uint32_t outside = 0;
  const uint32_t x_word = portable_grid_word((x - low[0]) * per_part, outside),
                 y_word = portable_grid_word((y - low[1]) * per_part, outside),
                 z_word = portable_grid_word((z - low[2]) * per_part, outside);
  point = box_point(x_word, y_word, z_word);
  return (outside >> 31) == 0;
}

/// The point x y z on the grid whose corner is `low`, of which a cell's 65536th is 1 / per_part.
/// Pre: a float may be read behind low. Result: whether it is inside; false for NaN.
static inline bool grid_point(float x, float y, float z, const float* low, float per_part,
                              BoxPoint& point) {
#if FIRMTOUCH_ISA_AVX2
  // What no signed word holds becomes its least, which is outside too.
  const __m128 from_low = _mm_sub_ps(_mm_setr_ps(x, y, z, 0.0f), _mm_loadu_ps(low));
  const __m128i whole = _mm_cvttps_epi32(_mm_mul_ps(from_low, _mm_set1_ps(per_part)));
  const __m128i below = _mm_sub_epi32(_mm_set1_epi32(static_cast<int>(0x800000FFu)), whole);
  const __m128i above = _mm_add_epi32(whole, _mm_set1_epi32(0x10100));
  const __m128i words = _mm_blend_epi16(_mm_srli_epi32(above, 16), below, 0xAA);
  point.words = _mm_or_si128(words, _mm_setr_epi32(0, 0, 0, -1));
  return (_mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(below, above))) & 7) == 0;
#else
  return portable_grid_point(x, y, z, low, per_part, point);
#endif
}

#if FIRMTOUCH_ISA_AVX2
// The squares of the three axes and 0.
static inline __m128i box_squares(const uint32_t* box, BoxPoint point) {
  const __m128i words = _mm_loadu_si128(reinterpret_cast<const __m128i*>(box));
  const __m128i gaps = _mm_subs_epu16(words, point.words);
  return _mm_madd_epi16(gaps, gaps);
}
#endif

/// portable_box_distance2() as this processor takes it, where no word may be read behind the box.
static inline uint32_t box_distance2(const uint32_t* box, const uint32_t* point) {
#if FIRMTOUCH_ISA_DSP
  const int16x2_t x = static_cast<int16x2_t>(__uqsub16(box[0], point[0]));
  const int16x2_t y = static_cast<int16x2_t>(__uqsub16(box[1], point[1]));
  const int16x2_t z = static_cast<int16x2_t>(__uqsub16(box[2], point[2]));
  return static_cast<uint32_t>(__smlad(z, z, __smlad(y, y, __smuad(x, x))));
#else
  return portable_box_distance2(box, point);
#endif
}

#if FIRMTOUCH_ISA_PAIRS
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
#endif

/// The same. Pre: a word may be read behind the box.
static inline uint32_t box_distance2(const uint32_t* box, const BoxPoint& point) {
#if FIRMTOUCH_ISA_AVX2
  const __m128i squares = box_squares(box, point);
  const __m128i pairs = _mm_add_epi32(squares, _mm_unpackhi_epi64(squares, squares));
  return static_cast<uint32_t>(
      _mm_cvtsi128_si32(_mm_add_epi32(pairs, _mm_shuffle_epi32(pairs, 1))));
#elif FIRMTOUCH_ISA_PAIRS
  uint32_t words[3];
  load_pair<0>(box, words[0], words[1]);
  words[2] = box[2];
  return box_distance2(words, point.words);
#else
  return box_distance2(box, point.words);
#endif
}

/// box_distance2() of two boxes that lie one behind the other, each followed by a word, and these
/// words.
static inline void side_distances2(const uint32_t* sides, const BoxPoint& point, uint32_t& first,
                                   uint32_t& second, uint32_t& word0, uint32_t& word1) {
#if FIRMTOUCH_ISA_AVX2
  const __m128i a = box_squares(sides, point), b = box_squares(sides + 4, point);
  const __m128i xz = _mm_add_epi32(_mm_unpacklo_epi32(a, b), _mm_unpackhi_epi32(a, b));
  const uint64_t sums =
      static_cast<uint64_t>(_mm_cvtsi128_si64(_mm_add_epi32(xz, _mm_unpackhi_epi64(xz, xz))));
  first = static_cast<uint32_t>(sums);
  second = static_cast<uint32_t>(sums >> 32);
  word0 = sides[3];
  word1 = sides[7];
#elif FIRMTOUCH_ISA_PAIRS
  uint32_t box0[3], box1[3];
  load_pair<0>(sides, box0[0], box0[1]);
  load_pair<8>(sides, box0[2], word0);
  load_pair<16>(sides, box1[0], box1[1]);
  load_pair<24>(sides, box1[2], word1);
  first = box_distance2(box0, point.words);
  second = box_distance2(box1, point.words);
#else
  first = box_distance2(sides, point);
  second = box_distance2(sides + 4, point);
  word0 = sides[3];
  word1 = sides[7];
#endif
}

}  // namespace firmtouch::math
