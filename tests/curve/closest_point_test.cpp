// Closest point of a curve on host and controller: small curves, hostile inputs.
#include "firmtouch/curve/closest_point.hpp"

#include <float.h>

#include "curve/rule_curves.hpp"
#include "curve/small_curve.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch::curve;       // NOLINT: a test file
using namespace firmtouch::curve_test;  // NOLINT
using firmtouch::math::Vec3;
using firmtouch::query::Budget;
using firmtouch::query::kUnlimited;

constexpr Sample kCorner[] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}};

Closest cold(const View& view, Vec3 p, Budget budget = kUnlimited) {
  Hint hint;
  return closest_point(view, p, budget, hint);
}

using Random = firmtouch::test::Lcg;

// Spacing from 1e-5 to 1, turning back towards itself every eight samples.
const LongCurve& tangled(uint32_t count) {
  static Sample samples[256];
  Random random(7);
  Sample at{0, 0, 0};
  float step = 1e-5f;
  for (uint32_t i = 0; i < count; ++i) {
    samples[i] = at;
    at.x_m += i % 16 < 8 ? step : -step;
    at.y_m += random.between(-0.3f, 0.3f) * step + 1e-4f;
    at.z_m += random.between(-0.3f, 0.3f) * step;
    step = i % 11 == 10 ? 1e-5f : step * 3.0f;
  }
  return firmtouch::curve_test::shared_curve(samples, count);
}

// A gentle arc with even spacing, as a recorded path is.
const LongCurve& gentle(uint32_t count) {
  static Sample samples[256];
  for (uint32_t i = 0; i < count; ++i) {
    const float x = static_cast<float>(i) * 0x1p-8f;
    samples[i] = {x, 0.25f * x * x, 0.0f};
  }
  return firmtouch::curve_test::shared_curve(samples, count);
}

bool finite(const Closest& c) {
  const float values[] = {c.distance_m, c.point_m.x, c.point_m.y, c.point_m.z,          c.tangent.x,
                          c.tangent.y,  c.tangent.z, c.arc,       c.certificate.lower_m};
  for (const float value : values)
    if (!(value - value <= 0.0f)) return false;
  return true;
}

}  // namespace

TEST(APointBesideASegmentAnswersItsFoot) {
  const SmallCurve c(kCorner);
  const Closest found = cold(c.view(), {0.5f, -0.25f, 0});
  CHECK_EQ(found.distance_m, 0.25f);
  CHECK_EQ(found.point_m.x, 0.5f);
  CHECK_EQ(found.point_m.y, 0.0f);
  CHECK_EQ(found.segment, 0u);
  CHECK_LE(found.arc, 0.5f / 3.0f * (1.0f + 1e-6f));
  CHECK_GE(found.arc, 0.5f / 3.0f * (1.0f - 1e-6f));
  CHECK_EQ(found.tangent.x, 1.0f);
  CHECK_EQ(found.certificate.exact, true);
  CHECK_EQ(found.certificate.sign, 0);
}

TEST(BothHalvesOfASegment_GiveTheSameTangentAndArc) {
  const SmallCurve c(kCorner);
  const Closest found = cold(c.view(), {1.5f, -0.25f, 0.5f});
  CHECK_EQ(found.segment, 0u);
  CHECK_EQ(found.tangent.x, 1.0f);
  CHECK_EQ(found.arc, 0.5f);
}

TEST(BeyondTheEndsTheEndsAreNearest) {
  const SmallCurve c(kCorner);
  const Closest before = cold(c.view(), {-3, 4, 0});
  CHECK_EQ(before.distance_m, 5.0f);
  CHECK_EQ(before.segment, 0u);
  CHECK_EQ(before.arc, 0.0f);
  const Closest after = cold(c.view(), {2, 5, 3});
  CHECK_EQ(after.distance_m, 5.0f);
  CHECK_EQ(after.segment, 1u);
  CHECK_EQ(after.arc, 1.0f);
}

TEST(APointOnTheCurveIsAtDistanceZeroWithLowerBoundZero) {
  const SmallCurve c(kCorner);
  const Closest found = cold(c.view(), {1, 0, 0});
  CHECK_EQ(found.distance_m, 0.0f);
  CHECK_EQ(found.certificate.lower_m, 0.0f);
  CHECK_EQ(found.certificate.exact, true);
}

TEST(EveryBudgetBracketsTheTruthAndNeverWidens) {
  const LongCurve& c = tangled(200);
  const View view = c.view();
  CHECK_EQ(view.is_open(), true);
  Random random(11);
  for (uint32_t q = 0; q < 60; ++q) {
    const Vec3 p{random.between(-0.5f, 1.5f), random.between(-0.5f, 0.5f),
                 random.between(-0.5f, 0.5f)};
    const double truth2 = firmtouch::curve_test::brute_distance2(c, p);
    float gap_m = FLT_MAX;
    for (uint32_t steps = 1; steps < 300; steps += 1 + steps / 8) {
      firmtouch::test::note("query", q);
      const Closest found = cold(view, p, {steps});
      const double lower = static_cast<double>(found.certificate.lower_m);
      const double upper = static_cast<double>(found.distance_m);
      CHECK_LE(lower * lower, truth2);
      CHECK_GE(upper * upper, truth2 * (1 - 1e-5) - 1e-14);
      CHECK_LE(found.certificate.steps, steps);
      CHECK_LE(found.distance_m - found.certificate.lower_m, gap_m);
      gap_m = found.distance_m - found.certificate.lower_m;
      if (found.certificate.exact) CHECK_LE(upper * upper, truth2 * (1 + 1e-5) + 1e-14);
    }
  }
}

TEST(AWarmStartAnswersTheSameDistanceInNoMoreSteps) {
  const LongCurve& c = gentle(256);
  const View view = c.view();
  Hint hint;
  uint32_t warm_steps = 0, cold_steps = 0;
  for (uint32_t i = 0; i < 400; ++i) {
    const float x = static_cast<float>(i) * 0x1p-9f;
    const Vec3 p{x, 0.25f * x * x + 0x1p-9f, 0x1p-10f};
    const Closest warm = closest_point(view, p, kUnlimited, hint), fresh = cold(view, p);
    CHECK_LE(warm.distance_m, fresh.distance_m * (1 + 1e-6f) + 1e-7f);
    CHECK_GE(warm.distance_m, fresh.distance_m * (1 - 1e-6f) - 1e-7f);
    warm_steps += warm.certificate.steps;
    cold_steps += fresh.certificate.steps;
  }
  CHECK_LE(warm_steps, cold_steps);
}

TEST(BudgetExhausted_LastCertificateMinusTheMotion_Holds) {
  const LongCurve& c = tangled(200);
  Hint hint;
  const Closest first = closest_point(c.view(), {0.5f, 0.4f, 0.4f}, kUnlimited, hint);
  const Closest next = closest_point(c.view(), {0.5f, 0.4f, 0.40625f}, {1}, hint);
  CHECK_GE(next.certificate.lower_m, first.certificate.lower_m - 0.00626f);
}

TEST(AnyBitsForAQueryGiveFiniteNumbersWithinTheBudget) {
  const LongCurve& c = tangled(64);
  const View view = c.view();
  const float values[] = {
      0.0f,     -0.0f,   1e-45f, -1e-40f,          FLT_MIN,           1.0f,
      -1e15f,   1e18f,   1e30f,  FLT_MAX,          -FLT_MAX,          0x1p60f,
      -0x1p62f, 0x1p63f, 1e9f,   __builtin_inff(), -__builtin_inff(), __builtin_nanf("")};
  const float depths[] = {1.0f, FLT_MAX, -1e-40f};
  Hint hint;
  for (const float x : values)
    for (const float y : values)
      for (const float z : depths) {
        const Closest found = closest_point(view, {x, y, z}, {3}, hint);
        CHECK(finite(found));
        CHECK_LE(found.certificate.steps, 3u);
        CHECK_LE(found.certificate.lower_m, found.distance_m);
      }
}

TEST(AQueryThatIsNotFiniteSaysSo) {
  const SmallCurve c(kCorner);
  const float wrong[] = {__builtin_nanf(""), __builtin_inff(), -__builtin_inff()};
  for (const float value : wrong) {
    const Closest found = cold(c.view(), {0, value, 0});
    CHECK_EQ(found.distance_m, FLT_MAX);
    CHECK_EQ(found.certificate.lower_m, 0.0f);
    CHECK_EQ(found.certificate.exact, false);
  }
}

TEST(FarAwayTheDistanceIsStillRightAndCertified) {
  const SmallCurve c(kCorner);
  const float far[] = {1e12f, 1e17f, 1.1e18f, 1.2e18f, 1e19f, 1e30f, 1e38f};
  for (const float x : far) {
    const Closest found = cold(c.view(), {0.0f, x, 0.0f});
    CHECK_GE(found.distance_m, x * (1 - 4e-7f));
    CHECK_LE(found.distance_m, x * (1 + 4e-7f));
    CHECK_LE(found.certificate.lower_m, x);
    CHECK_GE(found.certificate.lower_m, x * (1 - 5e-7f));
  }
}

TEST(AForeignHintCostsStepsAndNothingElse) {
  const LongCurve& c = tangled(64);
  const Vec3 p{0.3f, 0.1f, -0.2f};
  const Closest fresh = cold(c.view(), p);
  const uint32_t places[] = {0u, 62u, 63u, 64u, 0x7FFFFFFFu, 0xFFFFFFFEu};
  for (const uint32_t place : places) {
    Hint hint;
    hint.segment = place;
    const Closest found = closest_point(c.view(), p, kUnlimited, hint);
    CHECK_LE(found.distance_m, fresh.distance_m * (1 + 1e-6f));
    CHECK_GE(found.distance_m, fresh.distance_m * (1 - 1e-6f));
  }
}

TEST(TwoSamplesAreACurve) {
  const Sample line[] = {{0, 0, 0}, {0, 0, 1}};
  const SmallCurve c(line);
  const Closest found = cold(c.view(), {3, 4, 0.5f});
  CHECK_EQ(found.distance_m, 5.0f);
  CHECK_EQ(found.arc, 0.5f);
  CHECK_EQ(found.tangent.z, 1.0f);
  CHECK_LE(found.certificate.lower_m, 5.0f);
  CHECK_GE(found.certificate.lower_m, 5.0f * (1 - 4e-7f));
}

TEST(TheMiddleOfASegmentIsNeverMissed) {
  Random random(3);
  for (uint32_t i = 0; i < 300; ++i) {
    const Sample line[] = {{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)},
                           {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}};
    const SmallCurve c(line);
    const Vec3 middle{(line[0].x_m + line[1].x_m) * 0.5f, (line[0].y_m + line[1].y_m) * 0.5f,
                      (line[0].z_m + line[1].z_m) * 0.5f};
    CHECK_LE(cold(c.view(), middle).distance_m, 2e-7f);
  }
}

TEST(OneHashOfAWalkThatStopsEarlyOnEveryTarget) {
  LongCurve& c =
      firmtouch::curve_test::shared_curve(firmtouch::curve_test::long_hook().samples, 200);
  static firmtouch::query::ProbePoint points[400];
  uint32_t steps[2] = {0, 0};
  const uint32_t expected[] = {254071976u, 3433676074u};
  for (uint32_t k = 0; k < 2; ++k) {
    c.head.run_levels = k == 0 ? 3 : 6;
    c.derive_runs();
    Random random(9);
    Vec3 at_m = {c.samples[100].x_m, c.samples[100].y_m, c.samples[100].z_m};
    firmtouch::curve::Hint hint;
    for (firmtouch::query::ProbePoint& p : points) {
      at_m.x += random.between(-0.001f, 0.001f);
      at_m.y += random.between(-0.001f, 0.001f);
      at_m.z += random.between(-0.001f, 0.001f);
      p = {at_m.x, at_m.y, at_m.z};
      steps[k] +=
          closest_point(c.view(), at_m, firmtouch::query::kUnlimited, hint).certificate.steps;
    }
    const uint64_t hash = firmtouch::curve::probe_hash(
        c.view(), firmtouch::core::Span<const firmtouch::query::ProbePoint>(points, 400));
    CHECK_EQ(static_cast<uint32_t>(hash), expected[k]);
  }
  CHECK_LT(steps[0], 400u * 4);  // the way to the root: 7 runs are 4 boxes
  CHECK_LT(steps[1], 400u * 3);  // a run and its halves
}

TEST(OneHashOfTheAnswersOnEveryTarget) {
  const LongCurve& c = tangled(200);
  static firmtouch::query::ProbePoint points[500];
  Random random(5);
  for (firmtouch::query::ProbePoint& p : points) {
    const float scale = random.between(0.0f, 1.0f) < 0.1f ? 1e6f : 0.5f;
    p.x_m = random.between(-scale, scale);
    p.y_m = random.between(-scale, scale);
    p.z_m = random.between(-scale, scale);
  }
  const uint64_t hash = firmtouch::curve::probe_hash(
      c.view(), firmtouch::core::Span<const firmtouch::query::ProbePoint>(points, 500),
      firmtouch::query::kUnlimited);
  CHECK_EQ(static_cast<uint32_t>(hash >> 32), 0xD40CE72Fu);
  CHECK_EQ(static_cast<uint32_t>(hash), 0x987959D2u);
}
