// Splines as guides: lengths along them, which part the guide keeps to, and what open_guide()
// refuses.
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/spline/guide/arc.hpp"
#include "firmtouch/spline/guide/guided_point.hpp"
#include "firmtouch/spline/guide/min_cost.hpp"
#include "harness/test.hpp"
#include "spline/baked_guide.hpp"
#include "spline/random_splines.hpp"
#include "spline/small_spline.hpp"

namespace {

using namespace firmtouch;    // NOLINT: a test file
using namespace spline_test;  // NOLINT
using math::Vec3;
using query::Budget;
using query::kUnlimited;
using spline::CurveHint;

double length_to(const tools::SplineCurve& curve, double t) {
  double sum = 0;
  const int steps = 4000;
  for (size_t k = 0; k + 1 < curve.knots.size(); ++k) {
    const double low = std::max(curve.knots[k], curve.t0), high = std::min(curve.knots[k + 1], t);
    if (!(high > low)) continue;
    tools::Point before = point_at(curve, low);
    for (int i = 1; i <= steps; ++i) {
      const tools::Point next = point_at(curve, low + (high - low) * i / steps);
      sum += length(next - before);
      before = next;
    }
  }
  return sum;
}

double arc_at(const Guide& g, const tools::Point& on) {
  spline::Following following;
  const spline::Followed f = follow(g.guide, tools::to_vec3(on), {0, 1e3f}, kUnlimited, following);
  return static_cast<double>(f.arc) * static_cast<double>(g.guide.length_m());
}

}  // namespace

TEST(ArcPositionsAreLengthsAlongTheFilesCurve) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    tools::Random random(seed + 900);
    const tools::SplineCurve curve = random_curve(random, 1 + static_cast<int>(seed % 5), 1);
    const Guide g({curve});
    const double whole = length_to(curve, curve.t1);
    firmtouch::test::note("seed", seed);
    CHECK_LE(std::fabs(static_cast<double>(g.guide.length_m()) / whole - 1), 1e-5);
    for (int i = 0; i <= 6; ++i) {
      const double t = curve.t0 + (curve.t1 - curve.t0) * i / 6;
      const tools::Point on = point_at(curve, t);
      // Where the curve passes itself another part may be returned: then that is as near.
      spline::Following following;
      const spline::Followed f =
          follow(g.guide, tools::to_vec3(on), {0, 1e3f}, kUnlimited, following);
      if (std::fabs(static_cast<double>(f.closest.u) - t) > 1e-3 * (curve.t1 - curve.t0)) continue;
      const double at = length_to(curve, static_cast<double>(f.closest.u));
      CHECK_LE(std::fabs(static_cast<double>(f.arc) * whole - at), 4e-5 * whole);
    }
  }
}

TEST(ArcPositionsRiseAlongTheCurveAndEndAtItsLength) {
  const Guide g({eight()});
  double before = -1e-6;
  for (int i = 1; i < 400; ++i) {
    if (i % 50 == 0) continue;  // the crossing: either strand
    const double at = arc_at(g, point_at(g.model.curves[0], 7.0 * i / 400));
    if (std::abs(i - 200) < 8 || i < 8 || i > 392) continue;
    CHECK_LE(before, at);
    before = at;
  }
  CHECK_EQ(g.report.closed_chains, 1u);
  CHECK_EQ(g.report.chains, 1u);
}

TEST(WithoutAPenaltyTheGuideIsAtTheClosestPoint) {
  tools::Random random(5);
  const Guide g({random_curve(random, 3, 2)});
  spline::Following following;
  CurveHint hint;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p =
        tools::to_vec3({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
    const spline::Followed f = follow(g.guide, p, {0, 1e3f}, kUnlimited, following);
    const spline::Closest c = closest_point(g.view, p, kUnlimited, hint);
    CHECK_LE(std::fabs(f.closest.distance_m - c.distance_m), 4e-7f * g.view.head().extent_m);
    CHECK_LE(std::hypot(f.closest.point_m.x - c.point_m.x, f.closest.point_m.y - c.point_m.y,
                        f.closest.point_m.z - c.point_m.z),
             2e-3f);
    CHECK_EQ(f.closest.certificate.steps, c.certificate.steps);
    // To its last digits: across the curve.
    const Vec3 off{p.x - f.closest.point_m.x, p.y - f.closest.point_m.y, p.z - f.closest.point_m.z};
    const float along = off.x * f.closest.direction.x + off.y * f.closest.direction.y +
                        off.z * f.closest.direction.z;
    const bool is_inside = f.closest.s > -1 && f.closest.s < 1;
    if (is_inside) CHECK_LE(std::fabs(along), 2e-5f * f.closest.distance_m + 1e-6f);
    CHECK(f.is_held);
  }
}

TEST(APenaltyKeepsTheGuideOnItsStrandAndNoneDoesNot) {
  const Guide g({hairpin()});
  for (const float weight : {0.0f, 0.1f}) {
    spline::Following following;
    const spline::Hold hold{weight * g.guide.length_m(), 0.03f};
    (void)follow(g.guide, {0.05f, 0.001f, 0}, hold, kUnlimited, following);
    const spline::Followed f = follow(g.guide, {0.052f, 0.003f, 0}, hold, kUnlimited, following);
    CHECK_EQ(f.closest.point_m.y > 0.002f, !(weight > 0));
    CHECK(!f.is_new);
    // Its bound is that of the whole curve all the same.
    CHECK_LE(f.closest.certificate.lower_m, 0.0010001f);
    CHECK_GE(f.closest.certificate.lower_m, 0.00099f);
    CHECK(f.closest.certificate.exact);
    const spline::Followed far = follow(g.guide, {0.052f, 0.035f, 0}, hold, kUnlimited, following);
    CHECK(!far.is_held || far.closest.distance_m <= 0.03f);
  }
}

// Three strands, 4 mm apart, one after the other: a tool at the first's end that lifts towards the
// third passes the second, which is nearer than the first and less far along than the third.
TEST(OfThreeStrandsTheGuideGoesToTheOneBetweenWhereThatCostsLeast) {
  const Guide g({through({{0, 0, 0, 1},
                          {0.2, 0, 0, 1},
                          {0.2, 0.004, 0, 1},
                          {0, 0.004, 0, 1},
                          {0, 0.008, 0, 1},
                          {0.2, 0.008, 0, 1}},
                         1)});
  const spline::Hold hold{0.1f * g.guide.length_m(), 0.03f};
  const auto at = [&](float x, float y) {
    spline::Following following;
    (void)follow(g.guide, {x, 0.0001f, 0}, hold, kUnlimited, following);
    return follow(g.guide, {x, y, 0}, hold, kUnlimited, following).closest;
  };
  // To the second: 0.024 m along, so 2.4 mm of penalty; to the third 0.4 m, 40 mm.
  CHECK_LE(std::fabs(at(0.19f, 0.0065f).point_m.y - 0.004f), 1e-6f);
  CHECK_LE(std::fabs(at(0.19f, 0.0030f).point_m.y), 1e-6f);           // 3 mm against 1 + 2.4
  CHECK_LE(std::fabs(at(0.19f, 0.0034f).point_m.y - 0.004f), 1e-6f);  // 3.4 mm against 0.6 + 2.4
  CHECK_LE(std::fabs(at(0.10f, 0.0065f).point_m.y), 1e-6f);           // 6.5 mm against 2.5 + 20.4
  CHECK_LE(at(0.19f, 0.0065f).certificate.lower_m, 0.0015001f);       // of the whole curve, still
  CHECK(at(0.19f, 0.0065f).certificate.exact);
}

// Above a parabola's centre of curvature the distance has two low points close together, with a
// ridge between them: nearer is not worth the way over it.
TEST(ARidgeBetweenTwoLowPointsOfOnePieceIsNotCrossed) {
  const double first = -0.19, last = 0.31;
  const Guide g({through({{first, first * first, 0, 1},
                          {0.5 * (first + last), first * last, 0, 1},
                          {last, last * last, 0, 1}},
                         2)});
  for (const double up : {0.5009, 0.5025, 0.51}) {
    const auto height = static_cast<float>(up);
    const auto side = static_cast<float>(std::sqrt(up - 0.5));
    const float aside = 0.1f * side * side * side;  // well within the evolute
    for (const float weight : {0.0f, 0.3f}) {
      spline::Following following;
      const spline::Hold hold{weight * g.guide.length_m(), 10.0f};
      (void)follow(g.guide, {-aside, height, 0}, hold, kUnlimited, following);
      const spline::Followed f = follow(g.guide, {aside, height, 0}, hold, kUnlimited, following);
      CHECK_EQ(f.closest.point_m.x > 0, !(weight > 0));
      CHECK_LE(std::fabs(std::fabs(f.closest.point_m.x) - side), 0.5f * side);
      CHECK(f.closest.certificate.exact);
    }
  }
}

// What min_cost() finds is where the guide is found from: from there to the returned point the
// distance falls, and goes on falling no further.
TEST(TheGuideIsWhereTheDistanceFallsToFromTheLeastCost) {
  constexpr float kPerMetre[] = {0.01f, 0.1f, 0.5f, 2.0f};
  uint32_t others = 0, moves = 0;
  for (uint32_t seed = 0; seed < 12; ++seed) {
    tools::Random random(seed + 60);
    const Guide g({random_curve(random, 1 + static_cast<int>(seed % 5), 1)});
    const float extent_m = g.view.head().extent_m;
    spline::Following following;
    CurveHint hint;
    const spline::Hold hold{kPerMetre[seed % 4] * g.guide.length_m(), 1e3f};
    for (int i = 0; i < 1500; ++i) {
      firmtouch::test::note("tick", i);
      const float arc = std::fabs(std::sin(0.0021f * static_cast<float>(i)));
      Vec3 p = point_at_arc(g.guide, i % 100 == 0 ? static_cast<float>(random.between(0, 1)) : arc);
      const float aside_m = extent_m * (i % 3 == 0 ? 0.2f : 0.01f);
      p = {p.x + aside_m * std::sin(0.013f * static_cast<float>(i)), p.y + aside_m * 0.3f,
           p.z - aside_m * std::cos(0.017f * static_cast<float>(i))};
      const spline::Following was = following;
      const spline::Followed reported = follow(g.guide, p, hold, kUnlimited, following);
      if (!was.is_following) continue;
      const spline::Closest nearest = closest_point(g.view, p, kUnlimited, hint);
      const spline::LeastCost least =
          min_cost(g.guide, p, {hold.weight_m, was.piece, was.s}, nearest, kUnlimited);
      CHECK(reported.closest.certificate.exact && least.certificate.exact);
      CHECK(reported.is_held && !reported.is_new);
      const auto along = [](uint32_t piece, float s) {
        return static_cast<float>(piece) + 0.5f * (s + 1);
      };
      const float from = along(least.piece, least.s),
                  to = along(reported.closest.bezier, reported.closest.s);
      float before_m = least.distance_m;
      bool is_downhill = true;
      for (int k = 0; k <= 40; ++k) {
        const float at = from + (to - from) * static_cast<float>(k) / 40;
        const uint32_t piece = std::min(static_cast<uint32_t>(at), g.view.pieces().size() - 1);
        const Vec3 on =
            spline::position_of(g.view, piece, 2 * (at - static_cast<float>(piece)) - 1);
        const float off_m = std::hypot(on.x - p.x, on.y - p.y, on.z - p.z);
        is_downhill = is_downhill && off_m <= before_m + 2e-6f * extent_m;
        before_m = off_m;
      }
      CHECK_LE(reported.closest.distance_m, least.distance_m + 1e-6f * extent_m);
      ++moves;
      others += !is_downhill;
    }
  }
  CHECK_LE(others, moves / 2000);  // two parts of the same cost: either
}

TEST(AroundAnEightTheGuideRunsThroughTheCrossingBothTimes) {
  const Guide g({eight()});
  const tools::SplineCurve& curve = g.model.curves[0];
  for (const float weight : {0.1f, 1.0f}) {
    spline::Following following;
    double way = 0, worst = 0;
    for (int i = 0; i <= 2 * 3000; ++i) {
      const double t = 7.0 * ((i + 350) % 3000) / 3000;
      tools::Point at = point_at(curve, t);
      at.z += 0.01;
      const spline::Followed f = follow(g.guide, tools::to_vec3(at),
                                        {weight * g.guide.length_m(), 0.5f}, kUnlimited, following);
      way += static_cast<double>(f.change_of_arc);
      worst = std::max(worst, std::fabs(static_cast<double>(f.change_of_arc)));
    }
    CHECK_LE(std::fabs(way - 2), 2e-3);
    CHECK_LE(worst, 0.002);
  }
}

TEST(NoStateMakesTheGuidesAnswerWorseThanTheClosestPoints) {
  tools::Random random(77);
  const Guide g({random_curve(random, 3, 1), random_curve(random, 2, 1)});
  for (int i = 0; i < 2000; ++i) {
    spline::Following following;
    following.piece = random.below(i % 3 == 0 ? 0xFFFFFFFFu : 40);
    following.s = firmtouch::math::float_of(random.below(0xFFFFFFFFu));
    following.is_following = true;
    following.hint.foot = random.below(0xFFFFFFFFu);
    const Vec3 p =
        tools::to_vec3({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
    const uint32_t steps = i % 2 == 0 ? UINT32_MAX : 2 + random.below(60);
    const bool is_sound = following.piece < g.view.pieces().size();
    const spline::Hold hold{0.1f * g.guide.length_m(), 1e3f};
    const spline::Followed f = follow(g.guide, p, hold, Budget{steps}, following);
    CurveHint cold;
    const spline::Closest c = closest_point(g.view, p, kUnlimited, cold);
    CHECK_LE(f.closest.certificate.steps, steps);
    CHECK_LE(f.closest.certificate.lower_m, c.distance_m);
    CHECK_GE(f.closest.distance_m, c.certificate.lower_m);
    CHECK(f.arc >= 0 && f.arc <= 1.00001f);
    // Never by more than the penalty that the closest point would cost: half a round at most.
    if (steps == UINT32_MAX && is_sound)
      CHECK_LE(f.closest.distance_m, c.distance_m + hold.weight_m * 1.001f);
    CHECK(following.s >= -1 && following.s <= 1);
  }
}

TEST(StarvedGuide_StaysTrue_AtEveryBudget) {
  tools::Random random(78);
  const Guide g({random_curve(random, 3, 1), random_curve(random, 5, 1)});
  const spline::Hold hold{0.1f * g.guide.length_m(), 1e3f};
  for (uint32_t work = 0; work <= 400; ++work) {
    firmtouch::test::note("work", work);
    spline::Following following;
    for (int i = 0; i < 6; ++i) {
      const Vec3 p =
          tools::to_vec3({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
      const spline::Closest found = follow(g.guide, p, hold, Budget{work}, following).closest;
      CurveHint cold;
      const spline::Closest truth = closest_point(g.view, p, kUnlimited, cold);
      CHECK(truth.certificate.exact);
      CHECK_LE(found.certificate.work, std::max(work, 1u));
      CHECK_LE(found.certificate.lower_m, truth.distance_m);
      CHECK_GE(found.distance_m, truth.certificate.lower_m);
    }
  }
}

TEST(HostileQueriesOfAGuideLetGoAndGiveFiniteNumbers) {
  const Guide g({eight()});
  const float bad[] = {NAN, HUGE_VALF, -HUGE_VALF, 3e38f, 1e-45f};
  for (const float value : bad) {
    spline::Following following;
    (void)follow(g.guide, {0.1f, 0.1f, 0}, {0.5f, 0.5f}, kUnlimited, following);
    CHECK(following.is_following);
    const spline::Followed f =
        follow(g.guide, {value, 0, value}, {0.5f, 0.5f}, kUnlimited, following);
    CHECK(f.closest.distance_m - f.closest.distance_m <= 0.0f);
    CHECK(f.arc - f.arc <= 0.0f);
    CHECK_EQ(f.is_held, value < 1e-40f && value > 0);
    const spline::Followed back =
        follow(g.guide, {0.1f, 0.1f, 0}, {value, 0.5f}, kUnlimited, following);
    CHECK(back.is_held);
  }
}

TEST(SeveralCurvesAreChainsWithTheirOwnEnds) {
  const Guide g({through({{0, 0, 0, 1}, {1, 0, 0, 1}}, 1), through({{1, 0, 0, 1}, {1, 1, 0, 1}}, 1),
                 through({{3, 0, 0, 1}, {4, 0, 0, 1}}, 1)});
  CHECK_EQ(g.report.chains, 2u);
  CHECK_LE(std::fabs(g.report.length_m - 3), 1e-6);
  struct {
    Vec3 p;
    int end;
    float behind, ahead;
  } cases[] = {{{-0.1f, 0, 0}, -1, 0, 2},       {{0.5f, 0.1f, 0}, 0, 0.5f, 1.5f},
               {{1.1f, -0.1f, 0}, 0, 1, 1},     {{1, 1.1f, 0}, 1, 2, 0},
               {{2.9f, 0, 0}, -1, 0, 1},        {{4.1f, 0, 0}, 1, 1, 0},
               {{3.25f, 0, 0}, 0, 0.25f, 0.75f}};
  for (const auto& c : cases) {
    spline::Following following;
    const spline::Followed f = follow(g.guide, c.p, {0, 9}, kUnlimited, following);
    CHECK_EQ(f.end, c.end);
    CHECK_LE(std::fabs(f.behind_m - c.behind), 1e-5f);
    CHECK_LE(std::fabs(f.ahead_m - c.ahead), 1e-5f);
  }
}

TEST(Rule641RefusesArcsThatAreNotOfThePieces) {
  Guide g({eight()});
  std::vector<float> arcs = g.arcs();
  arcs.push_back(arcs.back());
  g.set_arcs(arcs);
  CHECK_EQ(g.verdict().rule, 641);
  g.set_arcs({});
  CHECK_EQ(g.verdict().rule, 641);
}

TEST(Rule642RefusesChainsThatAreNotOfThePieces) {
  Guide g({eight()});
  const std::vector<std::vector<spline::Chain>> bad = {
      {}, {{1, 0}}, {{0, 2}}, {{0, 0}, {0, 0}}, {{0, 0}, {60000, 0}}};
  for (const auto& chains : bad) {
    g.set_chains(chains);
    CHECK_EQ(g.verdict().rule, 642);
  }
}

TEST(Rule643RefusesArcsThatDoNotRise) {
  Guide g({eight()});
  const std::vector<float> sound = g.arcs();
  for (const float bad : {NAN, -1.0f, HUGE_VALF}) {
    std::vector<float> arcs = sound;
    arcs[2] = bad;
    g.set_arcs(arcs);
    CHECK_EQ(g.verdict().rule, 643);
  }
  std::vector<float> arcs = sound;
  arcs[0] = 0.001f;
  g.set_arcs(arcs);
  CHECK_EQ(g.verdict().rule, 643);
}

TEST(Rule644RefusesArcsThatAreNotTheCurvesLengths) {
  Guide g({eight()});
  std::vector<float> arcs = g.arcs();
  for (size_t i = 2; i < arcs.size(); ++i) arcs[i] += 0.2f * (arcs[2] - arcs[1]);
  g.set_arcs(arcs);
  const core::Verdict verdict = g.verdict();
  CHECK_EQ(verdict.rule, 644);
  CHECK_EQ(verdict.element, 1u);
}

TEST(Rule645RefusesChainsWithAGap) {
  Guide g({through({{0, 0, 0, 1}, {1, 0, 0, 1}}, 1), through({{2, 0, 0, 1}, {3, 0, 0, 1}}, 1)});
  g.set_chains({{0, 0}});
  CHECK_EQ(g.verdict().rule, 645);
  g.set_chains({{0, 0}, {1, 1}});
  CHECK_EQ(g.verdict().rule, 645);
}
