#pragma once
// A lower bound of the distance to an oriented box, with the variants of math/isa.hpp's kind. For
// the library's own translation units.

#include "firmtouch/math/isa.hpp"

namespace firmtouch::math {

/// A query packed for oriented_distance2(): x | y << 16 and z, each in half cells of a grid of
/// 15-bit coordinates, less 2^15, in two's complement; bits 16 to 31 of z are 0.
struct HalfCellPoint {
  uint32_t xy, z;
};

/// The middles of the cells into which the point of box_distance2() was widened: off by at
/// most 1.012 half cells on each axis.
/// Pre: grid_point() made the point and returned true.
static inline HalfCellPoint half_cell_point(const BoxPoint& point) {
#if FIRMTOUCH_ISA_AVX2
  const uint32_t words[3] = {static_cast<uint32_t>(_mm_extract_epi32(point.words, 0)),
                             static_cast<uint32_t>(_mm_extract_epi32(point.words, 1)),
                             static_cast<uint32_t>(_mm_extract_epi32(point.words, 2))};
#else
  const uint32_t* const words = point.words;
#endif
  const auto middle = [](uint32_t word) { return (2 * word + 0x7FFFu) & 0xFFFFu; };
  return {middle(words[0]) | middle(words[1]) << 16, middle(words[2])};
}

/// Squared distance in cells from a point to a box of any orientation; never more than the true one
/// where the box is sound (tools/FORMAT.md, 0x100E, which has its eight words). Along each axis the
/// part of the offset from the centre, saturated to 16 bits, in whole cells, less half the box's
/// length there.
static inline uint32_t portable_oriented_distance2(const uint32_t* box,
                                                   const HalfCellPoint& point) {
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

/// The same as this processor takes it: 26 instructions.
[[gnu::always_inline]] static inline uint32_t oriented_distance2(const uint32_t* box,
                                                                 const HalfCellPoint& point) {
#if FIRMTOUCH_ISA_PAIRS
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
#else
  return portable_oriented_distance2(box, point);
#endif
}

}  // namespace firmtouch::math
