// All foot-points, against dense sampling, known shapes, and what must change where.
#include "footpoint/footpoints.hpp"

#include <cmath>
#include <cstdlib>

#include "harness/test.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"

namespace {

using namespace firmtouch;
using tools::FootKind;
using tools::Footpoint;
using tools::Footpoints;
using tools::Point;

Footpoints of_curve(const tools::SplineCurve& c) { return {tools::bezier_pieces(c), {}}; }
Footpoints of_surface(const tools::SplineSurface& s) { return {{}, tools::bezier_pieces(s)}; }

std::vector<Footpoint> all(const Footpoints& feet, Point p) {
  bool is_complete = false;
  std::vector<Footpoint> found = feet.all(p, is_complete);
  CHECK(is_complete);
  return found;
}

size_t count(const std::vector<Footpoint>& found, FootKind kind) {
  size_t n = 0;
  for (const Footpoint& f : found) n += f.kind == kind;
  return n;
}

Point random_place(tools::Random& random) {
  return {random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-1.3, 1.3)};
}

// Changes of direction of the distance along a curve, counted by samples.
size_t turns_of(const tools::SplineCurve& c, Point p, int samples) {
  size_t turns = 0;
  double last = 0, before = -1;
  for (int k = 0; k <= samples; ++k) {
    const double d = tools::length(point_at(c, c.t0 + (c.t1 - c.t0) * k / samples) - p);
    if (k > 0) {
      const double step = d - last;
      if (k > 1 && step * before < 0) ++turns;
      before = step;
    }
    last = d;
  }
  return turns;
}

// The nearest of samples, and from there downhill.
double nearest_sample(const tools::SplineSurface& s, Point p, int samples) {
  double best = 1e300, u = 0, v = 0;
  const auto try_at = [&](double a, double b) {
    a = std::fmin(std::fmax(a, s.u0), s.u1), b = std::fmin(std::fmax(b, s.v0), s.v1);
    const double d = tools::length(point_at(s, a, b) - p);
    if (!(d < best)) return false;
    best = d, u = a, v = b;
    return true;
  };
  const double du = (s.u1 - s.u0) / samples, dv = (s.v1 - s.v0) / samples;
  for (int j = 0; j <= samples; ++j)
    for (int i = 0; i <= samples; ++i) try_at(s.u0 + du * i, s.v0 + dv * j);
  for (double step = 1; step > 1e-6; step *= 0.5)
    while (try_at(u + step * du, v) || try_at(u - step * du, v) || try_at(u, v + step * dv) ||
           try_at(u, v - step * dv)) {
    }
  return best;
}

// `check(surface, feet, point)` at points about surfaces that differ.
template <class Check>
void about_hilly_surfaces(const Check& check) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const tools::SplineSurface s = tools::hilly_surface(seed, 7, 0.25, seed % 2 == 0);
    const Footpoints feet = of_surface(s);
    for (int k = 0; k < 6; ++k)
      check(s, feet,
            Point{random.between(-0.2, 1.2), random.between(-0.2, 1.2), random.between(-0.6, 0.6)});
  }
}

}  // namespace

TEST(FootPointsOfCurvesAreAllTurnsOfTheDistance) {
  size_t checked = 0, differing = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    tools::Random random(seed);
    const int degree = 2 + static_cast<int>(random.below(4));
    const tools::SplineCurve c = spline_test::random_curve(random, degree, degree - 1);
    const Footpoints feet = of_curve(c);
    for (int k = 0; k < 5; ++k) {
      const Point p = random_place(random);
      const std::vector<Footpoint> found = all(feet, p);
      const size_t inner = count(found, FootKind::kMin) + count(found, FootKind::kMax);
      ++checked;
      differing += inner != turns_of(c, p, 4000);
    }
  }
  CHECK_EQ(checked, 200u);
  CHECK_LE(differing, 2u);  // two turns between two samples
}

TEST(EveryFootPointOfACurveIsNormalToIt) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const int degree = 2 + static_cast<int>(random.below(4));
    const tools::SplineCurve c = spline_test::random_curve(random, degree, degree - 1);
    const Footpoints feet = of_curve(c);
    const Point p = random_place(random);
    for (const Footpoint& f : all(feet, p)) {
      CHECK_LE(tools::length(point_at(c, f.u) - f.point_m), 1e-12);
      CHECK_LE(std::fabs(tools::length(f.point_m - p) - f.distance_m), 1e-15);
      if (f.kind == FootKind::kEnd) continue;
      const double step = 1e-7 * (c.t1 - c.t0);
      const Point tangent = point_at(c, f.u + step) - point_at(c, f.u - step);
      CHECK_LE(std::fabs(dot(tangent, f.point_m - p)),
               2e-6 * tools::length(tangent) * f.distance_m + 1e-15);
    }
  }
}

TEST(TheNearestFootPointIsTheNearestPointOfTheCurve) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::Random random(seed);
    const int degree = 1 + static_cast<int>(random.below(5));
    const tools::SplineCurve c = spline_test::random_curve(random, degree, degree);  // corners too
    const Point p = random_place(random);
    double best = 1e300;
    for (int k = 0; k <= 3000; ++k)
      best = std::fmin(best, tools::length(point_at(c, c.t0 + (c.t1 - c.t0) * k / 3000) - p));
    const double reported = all(of_curve(c), p).front().distance_m;
    CHECK_LE(reported, best + 1e-12);
    CHECK_GE(reported, best - 2e-2 * best - 1e-3);
  }
}

// Crossing the evolute changes the number by two: the parabola y = x^2 has one foot-point below its
// evolute and three above, and the evolute is y = 1/2 + 3 (x/4)^(2/3).
TEST(AParabolaHasOneFootPointBelowItsEvoluteAndThreeAbove) {
  tools::SplineCurve c;
  c.degree = 2;
  c.knots = {-2, -2, -2, 2, 2, 2};
  c.points = {{-2, 4, 0, 1}, {0, -4, 0, 1}, {2, 4, 0, 1}};
  c.t0 = -2, c.t1 = 2;
  const Footpoints feet = of_curve(c);
  for (const double x : {-0.3, -0.01, 0.0, 0.2, 0.5}) {
    const double evolute = 0.5 + 3 * std::cbrt(x * x / 16);
    for (const double aside : {1e-3, 1e-6, 1e-9}) {
      const std::vector<Footpoint> below = all(feet, {x, evolute - aside, 0});
      const std::vector<Footpoint> above = all(feet, {x, evolute + aside, 0});
      CHECK_EQ(count(below, FootKind::kMin) + count(below, FootKind::kMax), 1u);
      CHECK_EQ(count(above, FootKind::kMin), 2u);
      CHECK_EQ(count(above, FootKind::kMax), 1u);
      CHECK_EQ(count(above, FootKind::kEnd), 2u);
    }
  }
}

TEST(CentreOfACircle_IsReportedAsIncomplete) {
  const tools::SplineModel model =
      tools::read_spline_file(std::string(FIRMTOUCH_CAD_FILES) + "/circle-and-ellipse.igs", 0);
  CHECK(model.problem.empty());
  tools::SplineCurve circle = model.curves[0];
  bool is_complete = true;
  // Exact coordinates, so that the centre is one.
  const double h = 0.5, y = std::sqrt(3.0);
  circle.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 3};
  circle.t0 = 0, circle.t1 = 3;
  circle.points = {{1, 0, 0, 1},         {1, y, 0, h},  {-0.5, y / 2, 0, 1}, {-2, 0, 0, h},
                   {-0.5, -y / 2, 0, 1}, {1, -y, 0, h}, {1, 0, 0, 1}};
  const Footpoints feet = of_curve(circle);
  const std::vector<Footpoint> at_centre = feet.all({0, 0, 0}, is_complete);
  CHECK(!is_complete);
  CHECK_LE(std::fabs(at_centre.front().distance_m - 1), 1e-12);
  const std::vector<Footpoint> beside = feet.all({0.3, 0.1, 0}, is_complete);
  CHECK(is_complete);
  CHECK_EQ(beside.size(), 2u);  // closed and smooth: no ends
}

TEST(RepeatedControlPointsAndCornersAreListed) {
  tools::SplineCurve c;
  c.degree = 3;
  c.knots = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6};
  for (double x : {0., 1., 2., 2., 2., 3., 4., 5., 6.})
    c.points.push_back({x, x < 2.5 ? x * x : 8 - 2 * x, 0, 1});
  c.t1 = 6;
  const std::vector<Footpoint> found = all(of_curve(c), {2.2, 9, 0});  // above the corner (2, 4)
  CHECK(found.front().kind == FootKind::kEnd);
  CHECK_LE(tools::length(found.front().point_m - Point{2, 4, 0}), 1e-12);
}

TEST(TheNearestFootPointIsTheNearestPointOfTheSurface) {
  about_hilly_surfaces([](const tools::SplineSurface& s, const Footpoints& feet, Point p) {
    const double sampled = nearest_sample(s, p, 150), reported = all(feet, p).front().distance_m;
    CHECK_LE(reported, sampled + 1e-12);
    CHECK_GE(reported, sampled - 1e-6);
  });
}

TEST(EveryFootPointOfASurfaceIsNormalToItAndOfItsKind) {
  about_hilly_surfaces([](const tools::SplineSurface& s, const Footpoints& feet, Point p) {
    for (const Footpoint& f : all(feet, p)) {
      CHECK_LE(tools::length(point_at(s, f.u, f.v) - f.point_m), 1e-12);
      if (f.kind == FootKind::kEnd) continue;
      const double e = 1e-4;
      if (f.u < s.u0 + e || f.u > s.u1 - e || f.v < s.v0 + e || f.v > s.v1 - e) continue;
      const auto d2 = [&](double a, double b) {
        const Point d = point_at(s, f.u + a * e, f.v + b * e) - p;
        return dot(d, d);
      };
      const double here = d2(0, 0), uu = d2(1, 0) + d2(-1, 0) - 2 * here,
                   vv = d2(0, 1) + d2(0, -1) - 2 * here,
                   uv = (d2(1, 1) + d2(-1, -1) - d2(1, -1) - d2(-1, 1)) / 4;
      CHECK_LE(std::fabs(d2(1, 0) - d2(-1, 0)), 1e-10);
      CHECK_LE(std::fabs(d2(0, 1) - d2(0, -1)), 1e-10);
      if (std::fabs(uu * vv - uv * uv) < 1e-19) continue;
      const FootKind kind = uu * vv < uv * uv ? FootKind::kSaddle
                            : uu > 0          ? FootKind::kMin
                                              : FootKind::kMax;
      CHECK(kind == f.kind);
    }
  });
}

// Index of the distance on a closed surface: minima - saddles + maxima is its Euler number.
TEST(OnATorusMinimaAndMaximaAreAsManyAsSaddles) {
  const tools::SplineModel model =
      tools::read_spline_file(std::string(FIRMTOUCH_CAD_FILES) + "/torus.igs", 0);
  CHECK(model.problem.empty());
  const Footpoints feet = of_surface(model.surfaces[0]);
  CHECK_EQ(feet.corners().size(), 0u);
  tools::Random random(3);
  for (int k = 0; k < 12; ++k) {
    test::note("query", k);
    const Point p{random.between(-0.1, 0.1), random.between(-0.1, 0.1),
                  random.between(-0.03, 0.03)};
    const std::vector<Footpoint> found = all(feet, p);
    CHECK_EQ(found.size(), 4u);  // two meridians, near and far side of each tube
    CHECK_EQ(count(found, FootKind::kMin) + count(found, FootKind::kMax),
             count(found, FootKind::kSaddle));
    const double ring = std::sqrt(p.x * p.x + p.y * p.y) - 0.05;
    const double truth = std::fabs(std::sqrt(ring * ring + p.z * p.z) - 0.02);
    CHECK_LE(std::fabs(found.front().distance_m - truth), 1e-11);
  }
}

TEST(TheTeapotsFootPointsHoldItsNearestPoint) {
  const char* folder = std::getenv("FIRMTOUCH_MODELS");
  if (folder == nullptr) return test::skip("FIRMTOUCH_MODELS is not set");
  const tools::SplineModel model = tools::read_spline_file(std::string(folder) + "/teapot.bpt", 0);
  std::vector<tools::BezierPatch> patches;
  for (const tools::SplineSurface& s : model.surfaces)
    for (tools::BezierPatch& p : tools::bezier_pieces(s)) patches.push_back(std::move(p));
  const Footpoints feet({}, patches);
  tools::Random random(2);
  for (int k = 0; k < 12; ++k) {
    test::note("query", k);
    const Point p{random.between(-3, 3), random.between(-2, 2), random.between(-0.5, 3.5)};
    double sampled = 1e300;
    for (const tools::SplineSurface& s : model.surfaces)
      sampled = std::fmin(sampled, nearest_sample(s, p, 40));
    bool is_complete = false;
    const double reported = feet.all(p, is_complete).front().distance_m;
    CHECK(is_complete);
    CHECK_LE(reported, sampled + 1e-12);
    CHECK_GE(reported, sampled - 1e-6);
  }
}
