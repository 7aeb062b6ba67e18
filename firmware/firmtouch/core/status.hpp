#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// Result of a check of untrusted bytes. Rule 0: passed. Otherwise the number of the failed rule
/// (tools/FORMAT.md) and the index of the element where it failed, in the array that the rule
/// names.
struct [[nodiscard]] Verdict {
  uint16_t rule = 0;
  uint32_t element = 0;

  constexpr bool ok() const { return rule == 0; }
};

constexpr Verdict kPassed{};

constexpr Verdict reject(uint16_t rule, uint32_t element = 0) { return Verdict{rule, element}; }

}  // namespace firmtouch::core
