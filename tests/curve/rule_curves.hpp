#pragma once
// Curves that the rules of open() are tried on, and what it says to them.
#include "curve/small_curve.hpp"
#include "harness/rules.hpp"

namespace firmtouch::curve_test {

inline core::Verdict verdict_of(const curve::Sections& sections) {
  return test::verdict_of<curve::View>(sections);
}

template <class Curve>
void expect(const Curve& c, uint32_t rule, uint32_t element) {
  const core::Verdict verdict = verdict_of(c.sections());
  CHECK_EQ(verdict.rule, rule);
  CHECK_EQ(verdict.element, element);
}

// Four runs, the last one short.
inline const LongCurve& long_hook() {
  static curve::Sample samples[200];
  for (uint32_t i = 0; i < 200; ++i) {
    const float t = static_cast<float>(i) * 0x1p-7f;
    samples[i] = {t, t * t - 0.25f * t, 0.5f * t * t * t};
  }
  static const LongCurve curve(samples, 200);
  return curve;
}

}  // namespace firmtouch::curve_test
