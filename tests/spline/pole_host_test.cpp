// Patches that the baker must cut with care: with a pole (an edge that is one point), or folded.
#include <cmath>
#include <vector>

#include "bake/spline/spline_pole.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace spline_test;
using math::Vec3;
using query::kUnlimited;

constexpr double kRadius = 0.04;

// Half a circle turned about z: eight rational patches between two poles.
tools::SplineSurface ball() {
  const double w = std::sqrt(0.5);
  const double r[] = {0, 1, 1, 1, 0}, z[] = {-1, -1, 0, 1, 1}, weight[] = {1, w, 1, w, 1};
  const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 2;
  s.count_u = 9, s.count_v = 5;
  s.knots_u = {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
  s.knots_v = {0, 0, 0, 0.5, 0.5, 1, 1, 1};
  s.u1 = s.v1 = 1;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 9; ++i)
      s.points.push_back({kRadius * r[j] * x[i], kRadius * r[j] * y[i], kRadius * z[j],
                          weight[j] * (i % 2 == 0 ? 1 : w)});
  return s;
}

}  // namespace

// Four sectors about a pole, which the path passes where all points about it are nearly equally
// near.
TEST(WarmAnswersEqualColdAnswers_AlongAPathPastAPole) {
  uint32_t wrong = 0, inexact = 0, expensive = 0;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    tools::Random random(seed + 70);
    const double depth = random.between(-0.3, 0.3), rise = random.between(-0.2, 0.2);
    std::vector<tools::SplineSurface> sectors;
    constexpr double kArc = 0.5522847498;
    const double x[4] = {1, 1, kArc, 0}, y[4] = {0, kArc, 1, 1};
    for (int turn = 0; turn < 4; ++turn) {
      tools::SplineSurface s;
      s.degree_u = s.degree_v = 3;
      s.count_u = s.count_v = 4;
      s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
      s.u1 = s.v1 = 1;
      const double c[4] = {1, 0, -1, 0}, n[4] = {0, 1, 0, -1};
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          const double r = j / 3.0, z = j < 2 ? 0 : (j == 2 ? depth : depth + rise);
          s.points.push_back(
              {r * (c[turn] * x[i] - n[turn] * y[i]), r * (n[turn] * x[i] + c[turn] * y[i]), z, 1});
        }
      sectors.push_back(s);
    }
    const BakedModel baked(of(sectors));
    spline::Hint hint;
    const double slant = random.between(-0.1, 0.1), off = random.between(-0.01, 0.01);
    for (int i = 0; i < 300; ++i) {
      const double at = 0.4 - i * 0.8 / 300;
      const Vec3 p = tools::to_vec3({at, slant * at + off, (depth > 0 ? 1.4 : -1.4) + 0.3 * at});
      const spline::Closest warm = closest_point(baked.view, p, kUnlimited, hint);
      spline::Hint cold;
      const spline::Closest alone = closest_point(baked.view, p, kUnlimited, cold);
      const double truth = double{alone.distance_m};
      wrong +=
          std::fabs(double{warm.distance_m} - truth) <= 2.1e-6 * (baked.report.extent_m + truth) &&
                  double{warm.certificate.lower_m} <= truth
              ? 0u
              : 1u;
      inexact += warm.certificate.exact && alone.certificate.exact ? 0u : 1u;
      expensive += warm.evaluations > 6 ? 1u : 0u;
    }
  }
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(inexact, 0u);
  CHECK(expensive > 20);  // the path does pass where the pole costs
}

// On the axis whole rings of patches beside the pole are each equally near: none of them may take
// the budget before the pole is seen.
TEST(AShortQueryOnTheAxisOfABallFindsItsPole) {
  const BakedModel baked(of(ball()));
  uint32_t far = 0, wrong = 0;
  for (int i = 1; i <= 40; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double above_m = 0.0005 * i;
      spline::Hint hint;
      const spline::Closest c = closest_point(
          baked.view, tools::to_vec3({0, 0, side * (kRadius + above_m)}), {640}, hint);
      far += double{c.distance_m} <= above_m + 1e-3 * kRadius ? 0u : 1u;
      wrong += double{c.certificate.lower_m} <= above_m && double{c.distance_m} >= above_m - 1e-7
                   ? 0u
                   : 1u;
    }
  CHECK_EQ(far, 0u);
  CHECK_EQ(wrong, 0u);
}

// What contact takes there, from a fortieth of the radius on.
TEST(AQueryOnTheAxisOfABallEndsWithin16000Units) {
  const BakedModel baked(of(ball()));
  uint32_t most = 0, inexact = 0, wide = 0;
  for (int i = 10; i <= 40; ++i) {
    const Vec3 p = tools::to_vec3({0, 0, kRadius + 0.0001 * i});
    spline::Hint hint;
    const spline::Closest c = closest_point(baked.view, p, kUnlimited, hint);
    most = c.certificate.work > most ? c.certificate.work : most;
    inexact += c.certificate.exact ? 0u : 1u;
    // A move needs no more than a lower bound just short of it.
    spline::Hint cold;
    query::Budget budget{2000};
    budget.band_m = p.z - static_cast<float>(kRadius) - 1e-6f;
    wide += closest_point(baked.view, p, budget, cold).certificate.lower_m > budget.band_m - 1e-7f
                ? 0u
                : 1u;
  }
  CHECK_LE(most, tools::kPoleWork);
  CHECK_EQ(inexact, 0u);
  CHECK_EQ(wide, 0u);
}

// Where u turns about the pole, the derivative in u is nothing but rounding: no direction is better
// than a wrong one.
TEST(NoDirectionAtThePoleOfABallPointsInward) {
  const BakedModel baked(of(ball()));
  tools::Random random(78);
  uint32_t inward = 0, known = 0;
  for (int i = 0; i < 2000; ++i) {
    const double aside_m = std::pow(10.0, random.between(-11, -3)),
                 turn = random.between(0, 6.2832);
    const double side = i % 2 == 0 ? 1 : -1, off = i % 4 < 2 ? 1.05 : 0.95;
    spline::Hint hint;
    const spline::Closest c = closest_point(
        baked.view,
        tools::to_vec3({aside_m * std::cos(turn), aside_m * std::sin(turn), side * off * kRadius}),
        {2000}, hint);
    if (!(math::length(c.direction) > 0.5f)) continue;
    ++known;
    // Of the two sides of a surface it names one; turned about u and v, outward.
    inward += double{c.direction.z} * side > 0.9 ? 0u : 1u;
  }
  CHECK_EQ(inward, 0u);
  CHECK(known > 500);
}

// Everywhere about it the closed form.
TEST(EveryAnswerAboutABallIsItsRadiusAway) {
  const BakedModel baked(of(ball()));
  tools::Random random(77);
  const double allowed = 1e-6 * 2 * kRadius;
  uint32_t wrong = 0, inexact = 0;
  for (int i = 0; i < 3000; ++i) {
    // Every other one near a pole, on the outside.
    const double aside = i % 2 == 0 ? 0.3 : 1;
    const Vec3 p = tools::to_vec3({aside * 0.06 * random.bell(), aside * 0.06 * random.bell(),
                                   i % 2 == 0 ? 0.045 : 0.06 * random.bell()});
    const double off = double{math::length(p)};
    if (off < 0.3 * kRadius) continue;  // about the centre all is near
    const double truth = std::fabs(std::sqrt(double{p.x} * double{p.x} + double{p.y} * double{p.y} +
                                             double{p.z} * double{p.z}) -
                                   kRadius);
    for (const uint32_t budget : {300u, 5000u, 4000000u}) {
      spline::Hint hint;
      const spline::Closest c = closest_point(baked.view, p, {budget}, hint);
      const double high = double{c.distance_m}, low = double{c.certificate.lower_m};
      wrong += high >= truth - allowed && low <= truth ? 0u : 1u;
      inexact += budget < 4000000 || (c.certificate.exact && high <= truth + allowed &&
                                      low >= truth - allowed - 9e-7 * truth)
                     ? 0u
                     : 1u;
    }
  }
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(inexact, 0u);
}

// Only halves in u bring its weights together, though it is longer in v beside its point.
TEST(APieceWithAPoleWhoseWeightsVaryAlongItIsBaked) {
  tools::SplineSurface s;
  s.degree_u = 3, s.degree_v = 1;
  s.count_u = 4, s.count_v = 2;
  s.knots_u = {0, 0, 0, 0, 1, 1, 1, 1}, s.knots_v = {0, 0, 1, 1};
  s.u1 = s.v1 = 1;
  const double weights[] = {0.5, 2, 4, 0.1};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) s.points.push_back({1.0 * j, 0.3 * i * j, 0.1 * i * j, weights[i]});
  const BakedModel baked(of(s));
  CHECK(baked.report.problem.empty());
  CHECK(baked.report.pieces < 100);
}

// Along its fold the first derivative in u vanishes; only halves in u shorten it.
TEST(ASheetThatFoldsBackOntoItselfIsBaked) {
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 2;
  s.count_u = s.count_v = 3;
  s.knots_u = s.knots_v = {0, 0, 0, 1, 1, 1};
  s.u1 = s.v1 = 1;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) s.points.push_back({i == 1 ? 2.0 : 0.0, 0.3 * j, 0.1 * j * j, 1});
  const BakedModel baked(of(s));
  CHECK(baked.report.problem.empty());
  CHECK(baked.report.pieces < 100);
}

TEST(AModelOfTooManyPiecesIsRefusedWithTheirMostAndTheRemedy) {
  tools::SplineModel model;
  model.curves.assign(20001, bezier({{0, 0, 0, 1}, {1, 0, 0, 1}}));
  CHECK(BakedModel(model).report.problem ==
        "needs more than 20000 pieces: split the file, or bake with --small");
}
