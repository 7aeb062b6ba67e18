#pragma once
#include <stdint.h>

namespace firmtouch::query {

/// The most steps that a query may take. A step is one tree node read; a leaf is a node.
struct Budget {
  uint32_t steps = UINT32_MAX;  // 0 counts as 1
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
