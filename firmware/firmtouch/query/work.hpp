#pragma once
#include <stdint.h>

#include "firmtouch/query/certificate.hpp"

namespace firmtouch::query {

/// What is left of a budget while a query runs. A visited node takes one unit. What takes longer
/// than a node is charged where it is done, so that a budget bounds instructions and not only
/// visits. Inner loops keep `left` in a register.
struct Work {
  explicit Work(Budget budget) : allowed(budget.work == 0 ? 1 : budget.work), left(allowed) {}

  /// Result: false where nothing is left; then nothing is taken.
  bool visit() {
    if (left == 0) return false;
    --left;
    return true;
  }
  /// Takes units beyond the visits, at most what is left.
  void charge(uint32_t units) {
    const uint32_t taken = units < left ? units : left;
    left -= taken;
    charged += taken;
  }
  uint32_t used() const { return allowed - left; }
  uint32_t visits() const { return allowed - left - charged; }

  uint32_t allowed, left, charged = 0;
};

}  // namespace firmtouch::query
