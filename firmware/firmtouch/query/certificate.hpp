#pragma once
#include <float.h>
#include <stdint.h>

namespace firmtouch::query {

/// The most steps that a query may take (a step is one tree node read; a leaf is a node), and how far
/// off it need not be exact: touch asks for what is near. Beyond band_m an answer is a certified
/// lower bound, at least band_m unless the steps ran out, with the side where it is known without a
/// search; the point told may be any of the surface.
struct Budget {
  uint32_t steps = UINT32_MAX;  // 0 counts as 1
  float band_m = FLT_MAX;       // what is no number counts as 0
};

constexpr Budget kUnlimited{};

/// How true an answer is. The distance told is an upper bound of the true one; `lower_m` is a lower
/// bound, rounded down through all float32 error. `exact`: both are within 4e-7 of max(diagonal of
/// the asset, distance) of the truth.
struct Certificate {
  float lower_m = 0;   // certified: no point of the shape is nearer
  uint32_t steps = 0;  // used, at most the budget
  bool exact = false;
  int8_t sign = 0;  // +1 outside, -1 inside, 0 unknown: never act on an unknown side
};

}  // namespace firmtouch::query
