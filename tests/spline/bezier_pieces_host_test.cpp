// Pieces between knots are the spline itself, checked against its basis functions.
#include <cmath>

#include "harness/test.hpp"
#include "random_splines.hpp"
#include "spline/spline.hpp"

namespace {

using namespace firmtouch;
using tools::ControlPoint;
using tools::Point;

double apart(Point a, Point b) { return tools::length(a - b); }

bool same_bits(const ControlPoint& a, const ControlPoint& b) {
  return test::equal(a.x, b.x) && test::equal(a.y, b.y) && test::equal(a.z, b.z) &&
         test::equal(a.w, b.w);
}

// A quarter of the unit circle, then a half turn on: three pieces of degree 2.
tools::SplineCurve three_quarter_circle() {
  const double h = std::sqrt(0.5);
  tools::SplineCurve c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 3};
  c.points = {{1, 0, 0, 1},  {1, 1, 0, h},   {0, 1, 0, 1}, {-1, 1, 0, h},
              {-1, 0, 0, 1}, {-1, -1, 0, h}, {0, -1, 0, 1}};
  c.t1 = 3;
  return c;
}

}  // namespace

TEST(PiecesOfACurveFollowItsBasisFunctions) {
  double worst = 0;
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    tools::Random random(seed);
    const int degree = 1 + static_cast<int>(random.below(5));
    const tools::SplineCurve curve = spline_test::random_curve(random, degree, degree);
    for (const tools::BezierCurve& piece : tools::bezier_pieces(curve)) {
      for (double s : {0.0, 0.125, 0.37, 0.5, 0.81, 0.999}) {
        const double t = piece.t0 + s * (piece.t1 - piece.t0);
        worst = std::fmax(worst, apart(point_at(piece, s), point_at(curve, t)));
      }
    }
  }
  CHECK_LE(worst, 1e-13);
}

TEST(PiecesCoverTheRangeAndMeetToTheBit) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const int degree = 1 + static_cast<int>(random.below(5));
    const tools::SplineCurve curve = spline_test::random_curve(random, degree, degree);
    const std::vector<tools::BezierCurve> pieces = tools::bezier_pieces(curve);
    CHECK_EQ(pieces.front().t0, curve.t0);
    CHECK_EQ(pieces.back().t1, curve.t1);
    for (size_t i = 1; i < pieces.size(); ++i) {
      CHECK_EQ(pieces[i].t0, pieces[i - 1].t1);
      CHECK(same_bits(pieces[i].points.front(), pieces[i - 1].points.back()));
    }
  }
}

TEST(AKnotOfDegreePlusOneCutsTheCurve) {
  tools::SplineCurve c;
  c.degree = 1;
  c.knots = {0, 0, 1, 1, 2, 2};
  c.points = {{0, 0, 0, 1}, {1, 0, 0, 1}, {5, 0, 0, 1}, {6, 0, 0, 1}};
  c.t1 = 2;
  const std::vector<tools::BezierCurve> pieces = tools::bezier_pieces(c);
  CHECK_EQ(pieces.size(), 2u);
  CHECK_EQ(pieces[0].points[1].x, 1.0);
  CHECK_EQ(pieces[1].points[0].x, 5.0);
}

TEST(ACircleKeepsItsRadius) {
  const tools::SplineCurve circle = three_quarter_circle();
  const std::vector<tools::BezierCurve> pieces = tools::bezier_pieces(circle);
  CHECK_EQ(pieces.size(), 3u);
  double worst = 0;
  for (const tools::BezierCurve& piece : pieces)
    for (int k = 0; k <= 64; ++k)
      worst = std::fmax(worst, std::fabs(tools::length(point_at(piece, k / 64.0)) - 1));
  CHECK_LE(worst, 4e-16);
}

TEST(PartOfACurveIsThatPart) {
  tools::SplineCurve part = three_quarter_circle();
  part.t0 = 0.25, part.t1 = 2.5;
  const std::vector<tools::BezierCurve> pieces = tools::bezier_pieces(part);
  CHECK_EQ(pieces.size(), 3u);
  CHECK_EQ(pieces.front().t0, 0.25);
  CHECK_EQ(pieces.back().t1, 2.5);
  CHECK_LE(apart(point_at(pieces.front(), 0), point_at(part, 0.25)), 1e-15);
  CHECK_LE(apart(point_at(pieces.back(), 1), point_at(part, 2.5)), 1e-15);
  CHECK_LE(apart(point_at(part, -1), point_at(part, 0.25)), 0.0);
}

TEST(EqualWeightsGiveWeightsOfOneWithoutRounding) {
  tools::Random random(5);
  tools::SplineCurve curve = spline_test::random_curve(random, 3, 1);
  for (ControlPoint& p : curve.points) p.w = 0.3;
  CHECK(!tools::is_rational(curve.points));
  for (const tools::BezierCurve& piece : tools::bezier_pieces(curve))
    for (const ControlPoint& p : piece.points) CHECK_EQ(p.w, 1.0);
}

TEST(PiecesWithoutLengthAreLeftOut) {
  tools::SplineCurve c;
  c.degree = 3;
  c.knots = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6};
  for (double x : {0., 1., 2., 2., 2., 2., 3., 4., 5.}) c.points.push_back({x, x, 0, 1});
  c.t1 = 6;
  const std::vector<tools::BezierCurve> pieces = tools::bezier_pieces(c);
  CHECK_EQ(pieces.size(), 5u);  // of six: four points coincide
  for (ControlPoint& p : c.points) p = {1, 2, 3, 1};
  CHECK_EQ(tools::bezier_pieces(c).size(), 0u);
}

TEST(PatchesOfASurfaceFollowItsBasisFunctions) {
  double worst = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    tools::Random random(seed);
    const int m = 1 + static_cast<int>(random.below(5)), n = 1 + static_cast<int>(random.below(5));
    const tools::SplineSurface s = spline_test::random_surface(random, m, n, m < n ? m : n);
    for (const tools::BezierPatch& patch : tools::bezier_pieces(s)) {
      CHECK_EQ(patch.points.size(), static_cast<size_t>((m + 1) * (n + 1)));
      for (double a : {0.0, 0.3, 0.96}) {
        for (double b : {0.0, 0.55, 0.9}) {
          const Point truth = point_at(s, patch.u0 + a * (patch.u1 - patch.u0),
                                       patch.v0 + b * (patch.v1 - patch.v0));
          worst = std::fmax(worst, apart(point_at(patch, a, b), truth));
        }
      }
    }
  }
  CHECK_LE(worst, 1e-13);
}

TEST(NeighbouringPatchesHaveTheSameEdgeToTheBit) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const tools::SplineSurface s = spline_test::random_surface(random, 3, 2, 2);
    const std::vector<tools::BezierPatch> patches = tools::bezier_pieces(s);
    for (const tools::BezierPatch& a : patches) {
      for (const tools::BezierPatch& b : patches) {
        const bool beside = test::equal(a.u1, b.u0) && test::equal(a.v0, b.v0);
        const bool above = test::equal(a.v1, b.v0) && test::equal(a.u0, b.u0);
        for (size_t j = 0; beside && j < 3; ++j)
          CHECK(same_bits(a.points[j * 4 + 3], b.points[j * 4]));
        for (size_t i = 0; above && i < 4; ++i) CHECK(same_bits(a.points[8 + i], b.points[i]));
      }
    }
  }
}
