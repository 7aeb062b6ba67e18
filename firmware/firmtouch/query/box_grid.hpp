#pragma once
#include <stdint.h>

namespace firmtouch::query {

// Boxes lie on a grid of 15-bit coordinates, so that two of them fit a word and squares of
// differences fit 32 bits. One axis of a box is a word: low | (kGridMax - high) << 16.
constexpr uint32_t kGridMax = 32767;

constexpr uint32_t low_of(uint32_t axis) { return axis & 0xFFFFu; }
/// Pre: is_axis().
constexpr uint32_t high_of(uint32_t axis) { return kGridMax - (axis >> 16); }
constexpr uint32_t make_axis(uint32_t low, uint32_t high) {
  return low | ((kGridMax - high) << 16);
}

/// Whether a word is an axis of a box: on the grid and not inverted.
constexpr bool is_axis(uint32_t axis) { return low_of(axis) + (axis >> 16) <= kGridMax; }
/// Whether three are. Sums of up to kGridMax have no bit above its own.
constexpr bool are_axes(uint32_t x, uint32_t y, uint32_t z) {
  return ((low_of(x) + (x >> 16)) | (low_of(y) + (y >> 16)) | (low_of(z) + (z >> 16))) <= kGridMax;
}
/// Has both of these bits exactly if `outer` holds `inner`, both axes of boxes.
constexpr uint32_t kHeld = 0x80008000u;
constexpr uint32_t held(uint32_t outer, uint32_t inner) { return (inner | kHeld) - outer; }
/// Pre: is_axis(outer). Where it is not is_axis(inner) as well, any result.
constexpr bool holds(uint32_t outer, uint32_t inner) {
  return (held(outer, inner) & kHeld) == kHeld;
}

}  // namespace firmtouch::query
