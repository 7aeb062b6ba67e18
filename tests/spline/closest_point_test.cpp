// Closest point of splines on host and controller: small models, hostile inputs.
#include "firmtouch/spline/closest_point.hpp"

#include <float.h>

#include "harness/random.hpp"
#include "harness/test.hpp"
#include "spline/small_spline.hpp"

namespace {

using firmtouch::math::Vec3;
using firmtouch::query::Budget;
using firmtouch::query::kUnlimited;
using namespace firmtouch::spline;  // NOLINT: a test file
using firmtouch::spline_test::sampled_distance;
using firmtouch::spline_test::SmallSpline;

using Random = firmtouch::test::Lcg;

Vec3 about(Random& random) {
  return {random.between(-2.0f, 3.5f), random.between(-1.5f, 4.0f), random.between(-2.0f, 2.0f)};
}

bool finite(const Closest& c) {
  const float values[] = {c.distance_m,  c.point_m.x,          c.point_m.y,   c.point_m.z,
                          c.direction.x, c.direction.y,        c.direction.z, c.u,
                          c.v,           c.certificate.lower_m};
  for (const float value : values)
    if (!(value - value <= 0.0f)) return false;
  return true;
}

void check_exact(const Closest& c, float truth) {
  CHECK_EQ(c.certificate.exact, true);
  CHECK_LE(__builtin_fabsf(c.distance_m - truth), 5e-7f * (truth + 3.9f));
}

}  // namespace

TEST(EveryKindAnswersTheGlobalMinimumColdAndWarm) {
  for (uint32_t kind = 0; kind < 4; ++kind) {
    const SmallSpline model((kind & 1u) != 0, (kind & 2u) != 0);
    const View view = model.view();
    CHECK_EQ(view.is_open(), true);
    Random random(kind + 1);
    CurveHint warm;
    for (uint32_t i = 0; i < 20; ++i) {
      firmtouch::test::note("kind * 100 + query", kind * 100 + i);
      const Vec3 p = about(random);
      const double truth = sampled_distance(model, p);
      const double slack = 1e-6 * (static_cast<double>(view.head().extent_m) + truth);
      CurveHint cold;
      CurveHint* const hints[] = {&cold, &warm};
      for (CurveHint* hint : hints) {
        const Closest c = closest_point(view, p, kUnlimited, *hint);
        CHECK_EQ(c.certificate.exact, true);
        CHECK_LE(static_cast<double>(c.distance_m), truth + slack);
        CHECK_GE(static_cast<double>(c.distance_m), truth - slack);
        CHECK_LE(static_cast<double>(c.certificate.lower_m), truth);
        CHECK_GE(static_cast<double>(c.certificate.lower_m), truth - 2.0 * slack);
        CHECK_GE(c.piece, 5u);
        CHECK_LE(c.piece, 6u);
      }
    }
  }
}

TEST(EveryBudgetBracketsTheTruth) {
  for (uint32_t kind = 0; kind < 2; ++kind) {
    const SmallSpline model(kind == 1);
    const View view = model.view();
    Random random(kind + 7);
    for (uint32_t i = 0; i < 12; ++i) {
      const Vec3 p = about(random);
      const double truth = sampled_distance(model, p);
      CurveHint warm;
      for (uint32_t steps = 0; steps < 40; ++steps) {
        firmtouch::test::note("query * 100 + steps", i * 100 + steps);
        CurveHint cold;
        const Closest c = closest_point(view, p, Budget{steps}, (steps & 1u) != 0 ? warm : cold);
        CHECK_LE(c.certificate.steps, steps == 0 ? 1u : steps);
        CHECK_LE(static_cast<double>(c.certificate.lower_m), truth);
        CHECK_GE(static_cast<double>(c.distance_m), truth - 1e-6 * (truth + 3.9));
      }
    }
  }
}

TEST(HostileQueriesGiveFiniteAnswers) {
  static const float kValues[] = {0.0f,
                                  -0.0f,
                                  1e-45f,
                                  1e-20f,
                                  1.0f,
                                  -1e6f,
                                  2e8f,
                                  1e12f,
                                  -1e18f,
                                  1e30f,
                                  -3.4e38f,
                                  __builtin_inff(),
                                  -__builtin_inff(),
                                  __builtin_nanf("")};
  constexpr uint32_t kCount = sizeof kValues / sizeof kValues[0];
  for (uint32_t kind = 0; kind < 4; ++kind) {
    const SmallSpline model((kind & 1u) != 0, (kind & 2u) != 0);
    const View view = model.view();
    CurveHint hint;
    for (uint32_t i = 0; i < kCount * kCount; ++i) {
      const Vec3 p{kValues[i % kCount], kValues[i / kCount], kValues[(i * 5 + 3) % kCount]};
      const Closest c = closest_point(view, p, Budget{200}, hint);
      CHECK_EQ(finite(c), true);
      CHECK_LE(c.certificate.steps, 200u);
      CHECK_LE(c.certificate.lower_m, c.distance_m);
    }
  }
}

TEST(NanQuery_KnowsNothing) {
  const SmallSpline model(false);
  CurveHint hint;
  const Closest c = closest_point(model.view(), {0, __builtin_nanf(""), 0}, kUnlimited, hint);
  CHECK_EQ(c.distance_m, FLT_MAX);
  CHECK_EQ(c.certificate.lower_m, 0.0f);
  CHECK_EQ(c.certificate.exact, false);
}

TEST(HintsOfRandomBitsAreOnlyHints) {
  for (uint32_t kind = 0; kind < 2; ++kind) {
    const SmallSpline model(kind == 1);
    const View view = model.view();
    Random random(99);
    for (uint32_t i = 0; i < 100; ++i) {
      const Vec3 p = about(random);
      CurveHint cold, bent;
      bent.foot = random.bits();
      const float truth = closest_point(view, p, kUnlimited, cold).distance_m;
      check_exact(closest_point(view, p, kUnlimited, bent), truth);
    }
  }
}

// Words that are no parts of the model are not looked up, and nothing beside them is accepted.
TEST(AFrontierOfRandomWordsIsNoFrontier) {
  const SmallSpline model(true);
  const View view = model.view();
  Random random(7);
  for (uint32_t i = 0; i < 100; ++i) {
    const Vec3 p = about(random);
    CurveHint cold;
    const float truth = closest_point(view, p, kUnlimited, cold).distance_m;
    firmtouch::spline::Hint bent;
    static_cast<CurveHint&>(bent) = cold;
    bent.safe_subtree = firmtouch::spline::kWithFrontier;
    bent.frontier.base_m = truth;
    bent.frontier.unit_m = 1.0f;
    bent.frontier.count = static_cast<uint8_t>(random.bits() >> 24);
    bent.frontier.outside = 255;
    for (uint32_t& word : bent.frontier.node) word = random.bits() | 0x4000u;
    check_exact(closest_point(view, p, kUnlimited, bent), truth);
    CHECK_LE(bent.frontier.count, firmtouch::spline::Frontier::kMax);
  }
}

// A frontier is a certificate: of another model's nothing is true, but nothing is read that is not
// there.
TEST(AnyFrontierGivesFiniteAnswersWithinTheBudget) {
  const SmallSpline model(true);
  const View view = model.view();
  Random random(9);
  for (uint32_t i = 0; i < 2000; ++i) {
    const Vec3 p = about(random);
    firmtouch::spline::Hint bent;
    closest_point(view, p, kUnlimited, bent);
    bent.frontier.base_m = i % 3 == 0 ? -1.0f : 0.0f;
    bent.frontier.unit_m = 1.0f / static_cast<float>(1 + random.bits() % 1000u);
    bent.frontier.count = static_cast<uint8_t>(random.bits() >> 24);
    bent.frontier.outside = 255;
    for (uint32_t& word : bent.frontier.node)
      word = i % 2 == 0 ? random.bits() & 0x8000FFFFu : random.bits();
    const Closest c = closest_point(view, p, {200}, bent);
    CHECK(c.distance_m >= 0.0f && c.distance_m < 1e6f);
    CHECK_LE(c.certificate.steps, 200u);
  }
}

// The two overloads, one after the other: a frontier is of where the last query that knows of
// frontiers was.
TEST(Frontier_IsDroppedByAQueryWithoutOne) {
  const SmallSpline model(true);
  const View view = model.view();
  Random random(11);
  firmtouch::spline::Hint mixed;
  Vec3 p = about(random);
  uint32_t wrong = 0;
  for (uint32_t i = 0; i < 600; ++i) {
    const Vec3 q = about(random);
    const bool knows_of_none = i % 5 == 2 || i % 5 == 3;
    const float far = knows_of_none ? 0.5f : 0.08f;
    p = {p.x + (q.x - p.x) * far, p.y + (q.y - p.y) * far, p.z + (q.z - p.z) * far};
    CurveHint cold;
    const float truth = closest_point(view, p, kUnlimited, cold).distance_m;
    const Closest c = knows_of_none
                          ? closest_point(view, p, kUnlimited, static_cast<CurveHint&>(mixed))
                          : closest_point(view, p, kUnlimited, mixed);
    if (c.certificate.lower_m > truth + 5e-7f * (truth + 3.9f)) ++wrong;
    if (c.distance_m > truth + 5e-7f * (truth + 3.9f)) ++wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(AWarmQueryBesideItsLastPlaceTakesFewEvaluations) {
  const SmallSpline model(false);
  const View view = model.view();
  CurveHint hint;
  uint32_t evaluations = 0;
  for (uint32_t i = 0; i < 200; ++i) {
    const float x = static_cast<float>(i) * 0.01f - 0.5f;
    evaluations += closest_point(view, {x, 0.25f, 0.1f}, kUnlimited, hint).evaluations;
  }
  CHECK_LE(evaluations, 200u * 4u);
}

TEST(AnEmptyModelSpaceFarAwayIsAsNearAsAnyPoint) {
  const SmallSpline model(true);
  CurveHint hint;
  const Closest c = closest_point(model.view(), {1e12f, 0, 0}, kUnlimited, hint);
  CHECK_EQ(c.certificate.exact, true);
  CHECK_GE(c.distance_m, 0.9999999e12f);
  CHECK_LE(c.certificate.lower_m, 1e12f);
  CHECK_GE(c.certificate.lower_m, 0.999999e12f);
}

// One number for all answers: the same on the host and on the controllers.
TEST(AnswersHaveOneHashEverywhere) {
  uint64_t hash = 0;
  for (uint32_t kind = 0; kind < 4; ++kind) {
    const SmallSpline model((kind & 1u) != 0, (kind & 2u) != 0);
    Random random(5);
    firmtouch::query::ProbePoint points[100];
    for (auto* p = points; p != points + 100; ++p) {
      const Vec3 at = about(random);
      *p = {at.x, at.y, at.z};
    }
    hash = hash * 31 + firmtouch::spline::probe_hash(model.view(), points);
  }
  firmtouch::test::note("hash, upper half", static_cast<int64_t>(hash >> 32));
  firmtouch::test::note("hash, lower half", static_cast<int64_t>(hash & 0xFFFFFFFFu));
  CHECK_EQ(hash, 1169051653271138673ull);
}
