#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

// What the tests of reject rules share: each condition is tripped alone.
namespace firmtouch::test {

inline core::Bytes shorter(core::Bytes bytes, uint32_t by) {
  return {bytes.data(), bytes.size() - by};
}

/// Rule * 1000 + element; 0 where it passed.
inline uint32_t refusal(core::Verdict verdict) { return verdict.rule * 1000u + verdict.element; }

}  // namespace firmtouch::test
