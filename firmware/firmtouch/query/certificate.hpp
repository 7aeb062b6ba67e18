#pragma once
#include <float.h>
#include <stdint.h>

namespace firmtouch::query {

/// Work that a query may do, and the distance beyond which it need not be exact. Work counts in
/// units of about 100 instructions of a Cortex-M7: a visit of a tree node is at most one (of a mesh
/// a third), a triangle two thirds, what takes longer several. Beyond band_m the answer is a
/// certified lower bound: band_m less what floats lose, below 2e-6 of the size, unless the work ran
/// out, with the sign if it is known without a search. Its point may then be any point of the
/// surface. With a threshold a mesh may answer less sharply, and not exactly, where both bounds are
/// above it or both below.
struct Budget {
  uint32_t work = UINT32_MAX;  // 0 counts as 1
  float band_m = FLT_MAX;      // NaN counts as 0
  float threshold_m = 0;       // 0, or NaN: none
};

constexpr Budget kUnlimited{};

/// Bounds of an answer. The returned distance is an upper bound of the true one; `lower_m` is a
/// lower bound, rounded down through all float32 error. `exact`: both are within 4e-7
/// max(diagonal of the asset, distance) of the truth; of smooth curves within 1e-6 of that and 8e-6
/// of the longest piece; of splines within 4e-7 of the extent (rational: 1e-6) and 9e-7 of the
/// distance.
struct Certificate {
  float lower_m = 0;   // certified: no point of the shape is nearer
  uint32_t steps = 0;  // visits: tree nodes read, leaves included
  bool exact = false;
  int8_t sign = 0;    // +1 outside, -1 inside, 0 unknown: never act on an unknown sign
  uint32_t work = 0;  // units used, at most the budget; a host's wide search counts none
};

}  // namespace firmtouch::query
