#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "harness/test.hpp"

// What the tests of reject rules share: each condition is tripped alone.
namespace firmtouch::test {

inline core::Bytes shorter(core::Bytes bytes, uint32_t by) {
  return {bytes.data(), bytes.size() - by};
}

/// What open(parts..., view) says. The view is open only if they pass.
template <class View, class... Parts>
core::Verdict verdict_of(const Parts&... parts) {
  View view;
  const core::Verdict verdict = open(parts..., view);
  CHECK_EQ(verdict.ok(), view.is_open());
  return verdict;
}

/// Rule * 1000 + element: 106'004 is element 4 of R106; 0 where it passed.
inline uint32_t refusal(core::Verdict verdict) { return verdict.rule * 1000u + verdict.element; }

}  // namespace firmtouch::test
