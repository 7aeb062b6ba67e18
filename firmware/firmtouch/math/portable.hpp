#pragma once
// The portable definitions of the primitives: what each computes, on any processor. A folder of
// arch/ takes them or defines its own, which give the same bits (tests/math/isa_test.cpp). For the
// library's own translation units.

#include <stdint.h>

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

/// A query packed for oriented_distance2(): x | y << 16 and z, each in half cells of a grid of
/// 15-bit coordinates, less 2^15, in two's complement; bits 16 to 31 of z are 0.
struct HalfCellPoint {
  uint32_t xy, z;
};

namespace portable {

// The error of a smaller product may be no float.
constexpr float kMinProduct = 0x1p-100f;

/// a * b - product, exact; 0 where |product| < kMinProduct. Pre: product is a * b rounded; |a|
/// and |b| are below 2^115.
/// Source: Dekker 1971, with Veltkamp's halves.
static inline float product_error(float a, float b, float product) {
  if (!(__builtin_fabsf(product) >= kMinProduct)) return 0.0f;
  const float ca = 4097.0f * a, a_high = ca - (ca - a), a_low = a - a_high;
  const float cb = 4097.0f * b, b_high = cb - (cb - b), b_low = b - b_high;
  return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

/// Correctly rounded square root in integer arithmetic: one result bit a turn. Negative or NaN:
/// canonical NaN.
static inline float square_root(float value) {
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

/// The larger and the smaller of two; the limit if the value is NaN.
/// Pre: the limit is finite, for larger() not -0, for smaller() no zero; no signalling NaN.
static inline float larger(float value, float limit) { return value > limit ? value : limit; }
static inline float smaller(float value, float limit) { return value < limit ? value : limit; }

/// Without its fraction; the nearest that a word can hold; 0 for NaN.
static inline uint32_t saturated(float value) {
  if (!(value > 0.0f)) return 0;
  return value < 0x1p32f ? static_cast<uint32_t>(value) : UINT32_MAX;
}

/// Squared distance, in cells, from a point to a box on a grid of 15-bit coordinates; never more
/// than the true one. box[k] = low | (32767 - high) << 16 for axis k; point[k] = ceil(p) | (32767 -
/// floor(p)) << 16. Each half of the saturating difference is max(low - p, 0) or max(p - high, 0),
/// and at most one is not zero.
static inline uint32_t box_distance2(const uint32_t* box, const uint32_t* point) {
  uint32_t sum = 0;
  for (int k = 0; k < 3; ++k) {
    const uint32_t low = box[k] & 0xFFFFu, p_low = point[k] & 0xFFFFu;
    const uint32_t high = box[k] >> 16, p_high = point[k] >> 16;
    const uint32_t below = low > p_low ? low - p_low : 0, above = high > p_high ? high - p_high : 0;
    sum += below * below + above * above;
  }
  return sum;
}

/// A query packed for box_distance2().
struct BoxPoint {
  uint32_t words[3];
};

static inline BoxPoint box_point(uint32_t x, uint32_t y, uint32_t z) { return {{x, y, z}}; }

/// Pre: a word may be read behind the box.
static inline uint32_t box_distance2(const uint32_t* box, const BoxPoint& point) {
  return box_distance2(box, point.words);
}

/// A coordinate in whole 65536ths of a cell as a word of a point, 2^-8 cells wider to either side
/// and then to whole cells. The top bit of `outside` is set where it is not inside the grid.
static inline uint32_t grid_word(uint32_t whole, uint32_t& outside) {
  // Exact except for the fraction that is cut off. 256 less, rounded down to cells, and 256 more
  // than what may have been cut off, rounded up.
  const uint32_t below = 0x7FFFFFFFu - (whole - 256), above = whole + 0x10100u;
  outside |= below | above;
  return (below & 0xFFFF0000u) | (above >> 16);
}

/// The point x y z on the grid whose corner is `low`, of which a cell's 65536th is 1 / per_part.
/// Pre: a float may be read behind low. Result: whether it is inside; false for NaN.
static inline bool grid_point(float x, float y, float z, const float* low, float per_part,
                              BoxPoint& point) {
  uint32_t outside = 0;
  const uint32_t x_word = grid_word(saturated((x - low[0]) * per_part), outside),
                 y_word = grid_word(saturated((y - low[1]) * per_part), outside),
                 z_word = grid_word(saturated((z - low[2]) * per_part), outside);
  point = box_point(x_word, y_word, z_word);
  return (outside >> 31) == 0;
}

/// box_distance2() of two boxes that lie one behind the other, each followed by a word, and these
/// words.
static inline void side_distances2(const uint32_t* sides, const BoxPoint& point, uint32_t& first,
                                   uint32_t& second, uint32_t& word0, uint32_t& word1) {
  first = box_distance2(sides, point);
  second = box_distance2(sides + 4, point);
  word0 = sides[3];
  word1 = sides[7];
}

/// The middles of the cells into which the point of box_distance2() was widened: off by at
/// most 1.012 half cells on each axis.
/// Pre: grid_point() made the point and returned true.
static inline HalfCellPoint half_cell_point(const uint32_t* words) {
  const auto middle = [](uint32_t word) { return (2 * word + 0x7FFFu) & 0xFFFFu; };
  return {middle(words[0]) | middle(words[1]) << 16, middle(words[2])};
}
static inline HalfCellPoint half_cell_point(const BoxPoint& point) {
  return half_cell_point(point.words);
}

/// Squared distance in cells from a point to a box of any orientation; never more than the true one
/// where the box is sound (tools/FORMAT.md, 0x100E, which has its eight words). Along each axis the
/// part of the offset from the centre, saturated to 16 bits, in whole cells, less half the box's
/// length there.
static inline uint32_t oriented_distance2(const uint32_t* box, const HalfCellPoint& point) {
  const auto low = [](uint32_t word) {
    return static_cast<int32_t>(static_cast<int16_t>(word & 0xFFFFu));
  };
  const auto high = [](uint32_t word) {
    return static_cast<int32_t>(static_cast<int16_t>(word >> 16));
  };
  const auto saturated = [](int32_t value) {
    return value > 32767 ? 32767 : value < -32768 ? -32768 : value;
  };
  const int32_t x = saturated(low(point.xy) - low(box[2])),
                y = saturated(high(point.xy) - high(box[2])),
                z = saturated(low(point.z) - low(box[3]));
  const int32_t axis_z[3] = {low(box[7]), high(box[7]), high(box[3])};
  const uint32_t half[3] = {box[0] & 0xFFFFu, box[0] >> 16, box[1] >> 16};
  uint32_t sum = 0;
  for (int k = 0; k < 3; ++k) {
    // Modulo 2^32, as processors add: where no box is, axes are what lies behind (FORMAT.md).
    const int32_t along = static_cast<int32_t>(static_cast<uint32_t>(low(box[4 + k]) * x) +
                                               static_cast<uint32_t>(high(box[4 + k]) * y) +
                                               static_cast<uint32_t>(axis_z[k] * z));
    const uint32_t off = static_cast<uint32_t>(along ^ (along >> 31)) >> 16;  // never above |along|
    const uint32_t gap = off > half[k] ? off - half[k] : 0;
    sum += gap * gap;
  }
  return sum;
}

/// `value`, kept from a compiler that would rather shift and add than multiply by it.
static inline uint32_t as_multiplier(uint32_t value) { return value; }

/// Optimisation barrier: keeps expressions of `value` from being hoisted out of the loop.
static inline uint32_t only_here(uint32_t value) { return value; }

/// `constant`, which the compiler then keeps in a register instead of loading it at each use.
static inline float in_register(float constant) { return constant; }

/// Puts two words behind `top`, the last of a stack, and moves it there.
[[gnu::always_inline]] static inline void push_pair(uint32_t*& top, uint32_t first,
                                                    uint32_t second) {
  top[0] = first, top[1] = second, top += 2;
}

/// Takes one off `count`. Result: whether something is left.
[[gnu::always_inline]] static inline bool count_down(uint32_t& count) { return --count != 0; }

/// What `from` points to; moves it to the next.
template <class Index>
[[gnu::always_inline]] static inline uint32_t next_of(const Index*& from) {
  return *from++;
}

/// Three floats that lie one behind the other, into floats: a struct of them would be stored aside.
/// kBlock: 0 to 2, for three that are loaded together.
template <int kBlock>
[[gnu::always_inline]] static inline void load_floats(const float* from, float& x, float& y,
                                                      float& z) {
  x = from[0], y = from[1], z = from[2];
}

/// Five floats, into registers that a call keeps.
[[gnu::always_inline]] static inline void load_kept(const float* from, float (&to)[5]) {
  for (int i = 0; i < 5; ++i) to[i] = from[i];
}

}  // namespace portable
}  // namespace firmtouch::math
