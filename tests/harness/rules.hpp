#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "harness/test.hpp"

// What the tests of reject rules share: each condition is tripped alone.
namespace firmtouch::test {

inline core::Bytes bytes(const void* from, uint32_t count) {
  return {static_cast<const uint8_t*>(from), count};
}
inline core::Bytes shorter(core::Bytes bytes, uint32_t by) {
  return {bytes.data(), bytes.size() - by};
}

/// Not open if the sections break a rule.
template <class View, class Sections>
View opened(const Sections& sections) {
  View view;
  return open(sections, view).ok() ? view : View{};
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

/// A sound `model` is accepted, and rejected by `rule` at `element` after `break_it`.
template <class Model, class Break>
void check_rule(Model& model, uint16_t rule, uint32_t element, const Break& break_it) {
  CHECK_EQ(model.verdict().rule, 0u);
  break_it(model);
  const core::Verdict verdict = model.verdict();
  CHECK_EQ(verdict.rule, rule);
  CHECK_EQ(verdict.element, element);
}

/// check_rule() of a new model.
template <class Model>
struct CheckRule {
  template <class Break>
  void operator()(uint16_t rule, uint32_t element, const Break& break_it) const {
    Model model;
    check_rule(model, rule, element, break_it);
  }
};

}  // namespace firmtouch::test
