// The rules of open() that are stricter for cubic pieces, or differ.
#include "curve/rule_curves.hpp"

namespace {

using firmtouch::curve_test::expect;
using firmtouch::curve_test::long_hook;
using firmtouch::curve_test::LongCurve;
using firmtouch::curve_test::verdict_of;

// The same samples with cubic pieces.
const LongCurve& smooth_hook() {
  static const LongCurve curve = [] {
    LongCurve made = long_hook();
    made.head.is_smooth = 1;
    made.derive();
    return made;
  }();
  return curve;
}

}  // namespace

TEST(TheSmoothCurveThatTheRulesAreTriedOnIsGood) { expect(smooth_hook(), 0, 0); }

TEST(Rule227RefusesACubicPieceThatLeavesTheBoxOfItsRun) {
  for (uint32_t k = 0; k < 3; ++k) {
    LongCurve c = smooth_hook();
    c.boxes[2 * (c.run_count() - 1)].side[k] += 2u + 0x20000u;
    CHECK_EQ(verdict_of(c.sections()).rule, firmtouch::curve::kRuleRunBox);
  }
}

TEST(Rule228RefusesTheRadiusOfStraightPiecesForCubicOnes) {
  LongCurve c = smooth_hook();
  const LongCurve& straight = long_hook();
  for (uint32_t k = 0; k < 31; ++k) c.radii[k] = straight.radii[k];
  expect(c, firmtouch::curve::kRuleRadius, 0);
}

TEST(Rule230RefusesASmoothCurveThatReachesTheEndsOfItsGrid) {
  for (uint32_t k = 0; k < 3; ++k) {
    LongCurve c = smooth_hook();
    c.boxes[0].side[k] &= 0xFFFF0000u;
    expect(c, firmtouch::curve::kRuleSmoothMargin, k);
    c.head.is_smooth = 0;  // is no concern of straight pieces
    CHECK_NE(verdict_of(c.sections()).rule, firmtouch::curve::kRuleSmoothMargin);
  }
}
