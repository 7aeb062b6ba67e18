#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// What a check of untrusted bytes found. Rule 0: nothing wrong. Otherwise the number of the rule
/// that failed (every rule R<n> stands in tools/FORMAT.md) and the element it failed at, counted
/// from 0 in the array that the rule names.
struct [[nodiscard]] Verdict {
  uint16_t rule = 0;
  uint32_t element = 0;

  constexpr bool ok() const { return rule == 0; }
};

constexpr Verdict kPassed{};

constexpr Verdict reject(uint16_t rule, uint32_t element = 0) { return Verdict{rule, element}; }

}  // namespace firmtouch::core
