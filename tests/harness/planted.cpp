// Test cases that must fail, and one that cannot run: what the harness says about them is held
// against tests/harness/self_test.sh. The line numbers there are this file's.
#include "harness/test.hpp"

namespace {

enum class Colour : uint8_t { kRed = 3, kBlue = 250 };

TEST(FalseConditionFails) { CHECK(1 + 1 == 3); }

TEST(BothFloatsAreShown) { CHECK_LE(0.1f, -2.5e-3f); }

TEST(IntegersAreShownInFull) {
  CHECK_EQ(uint64_t{18446744073709551615u}, uint64_t{18446744073709551614u});
  CHECK_EQ(int64_t{-9223372036854775807}, int64_t{7});
  CHECK_EQ(Colour::kRed, Colour::kBlue);
  CHECK_EQ(true, false);
}

TEST(NaNFailsEveryComparison) {
  const float nan = __builtin_nanf("");
  CHECK_LE(nan, 1.0f);
  CHECK_GE(nan, 1.0f);
  CHECK_LT(nan, 1.0f);
  CHECK_GT(nan, 1.0f);
  CHECK_EQ(nan, nan);
}

TEST(InfinityAndLimitsAreShown) {
  CHECK_LT(__builtin_inff(), -__builtin_inff());
  CHECK_EQ(1.17549435e-38f, 3.40282347e38f);
  CHECK_EQ(9.9999999999, 0.0);
}

TEST(ManyFailuresAreCountedNotListed) {
  firmtouch::test::note("seed", 42);
  for (int i = 0; i < 12; ++i) CHECK_EQ(i, -1);
}

TEST(MissingModelIsSkipped) { firmtouch::test::skip("no model"); }

TEST(SkipDoesNotHideAFailure) {
  CHECK(false);
  firmtouch::test::skip("too late");
}

TEST(TrueConditionsPass) {
  CHECK(true);
  CHECK_NE(1, 2);
  CHECK_LE(1, 1);
  CHECK_GE(2.0, 1.0);
}

}  // namespace
