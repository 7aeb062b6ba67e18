// Patches that the baker must cut with care: with a pole (an edge that is one point), or folded.
#include <cmath>
#include <vector>

#include "firmtouch/spline/closest_point.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace spline_test;
using math::Vec3;
using query::kUnlimited;

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
