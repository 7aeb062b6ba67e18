// Jumps and paths by the hundred thousand against intervals that hold the truth: no wrong minimum.
// Daily a few; FIRMTOUCH_LONG: 100,000 jumps and as many path queries of each curve, 50,000 of each
// surface.
#include <cmath>
#include <cstdlib>
#include <string>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/exact_distance.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using tools::Point;

using firmtouch::test::is_long;
double reflected(double x, double low, double high) {
  const double span = high - low;
  double at = std::fmod(std::fabs(x - low), 2 * span);
  return low + (at > span ? 2 * span - at : at);
}

void run(const tools::SplineModel& model, uint32_t seed, uint32_t queries) {
  const spline_test::BakedModel baked(model);
  const tools::SplineReport& report = baked.report;
  const spline::View& view = baked.view;
  CHECK(view.is_open());
  if (!view.is_open()) return;
  const spline_test::ExactDistance exact(model);
  const double unit = (report.is_rational ? 1e-6 : 4e-7) * report.extent_m;
  tools::Random random(seed);
  const spline::Head& head = view.head();
  spline::Hint jumping, going, banded;
  double low[3], high[3], at[3], speed[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double side = double{head.high_m[k]} - double{head.low_m[k]} + 0.2 * report.extent_m;
    low[k] = double{head.low_m[k]} - 0.25 * side;
    high[k] = double{head.high_m[k]} + 0.25 * side;
    at[k] = 0.5 * (low[k] + high[k]);
  }
  uint32_t wrong = 0, false_bounds = 0, inexact = 0, short_bands = 0;
  const auto check_at = [&](const Point& p, spline::Hint& hint) {
    const spline::Closest c = closest_point(view, tools::to_vec3(p), query::kUnlimited, hint);
    const spline_test::Interval d = exact.distance(tools::to_point(tools::to_vec3(p)));
    const double lo = static_cast<double>(d.lo), hi = static_cast<double>(d.hi);
    wrong += double{c.distance_m} <= hi + unit && double{c.distance_m} >= lo - unit ? 0u : 1u;
    false_bounds += double{c.certificate.lower_m} <= lo ? 0u : 1u;
    inexact += c.certificate.exact ? 0u : 1u;
    return d;
  };
  // Bands from 0 to beyond the distance, with work enough or not, from one hint.
  const auto check_band = [&](const Point& p, const spline_test::Interval& d) {
    const double lo = static_cast<double>(d.lo), hi = static_cast<double>(d.hi);
    const uint32_t work = random.below(2) == 0 ? UINT32_MAX : 1 + random.below(200);
    const query::Budget budget{work, static_cast<float>(hi * random.between(-0.1, 2.0))};
    const spline::Closest c = closest_point(view, tools::to_vec3(p), budget, banded);
    const bool is_exact = c.certificate.exact;
    wrong += double{c.distance_m} >= lo - unit && !(is_exact && double{c.distance_m} > hi + unit)
                 ? 0u
                 : 1u;
    false_bounds += double{c.certificate.lower_m} <= lo ? 0u : 1u;
    if (work != UINT32_MAX || is_exact) return;
    short_bands += double{c.certificate.lower_m} >= double{budget.band_m} - unit ? 0u : 1u;
    inexact += double{budget.band_m} > hi ? 1u : 0u;
  };
  for (uint32_t i = 0; i < queries; ++i) {
    check_at({random.between(low[0], high[0]), random.between(low[1], high[1]),
              random.between(low[2], high[2])},
             jumping);
    for (int k = 0; k < 3; ++k) {  // about 0.2 % of the extent a step
      speed[k] += 0.1 * (0.0012 * report.extent_m * random.bell() - speed[k] * 0.1);
      at[k] = reflected(at[k] + speed[k], low[k], high[k]);
    }
    const Point p{at[0], at[1], at[2]};
    check_band(p, check_at(p, going));
  }
  firmtouch::test::note("seed", seed);
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(false_bounds, 0u);
  CHECK_EQ(inexact, 0u);
  CHECK_EQ(short_bands, 0u);
}

// Of 10 to 19 points; weights, and its third coordinate, as passed.
tools::SplineModel cubic(uint32_t seed, bool is_rational, bool is_planar) {
  tools::Random random(seed);
  tools::SplineCurve c;
  c.degree = 3;
  const size_t points = 10 + random.below(10);
  for (size_t i = 0; i < points; ++i)
    c.points.push_back({random.between(-1, 1), random.between(-1, 1),
                        is_planar ? 0.0 : random.between(-1, 1),
                        is_rational ? random.between(0.2, 5) : 1.0});
  double knot = 0;
  for (size_t i = 0; i < points + 4; ++i) {
    if (i > 3 && i <= points) knot += random.between(0.1, 1);
    c.knots.push_back(knot);
  }
  c.t0 = c.knots[3], c.t1 = c.knots[points];
  tools::SplineModel model;
  model.curves.push_back(c);
  return model;
}

}  // namespace

TEST(TenPlanarTenRationalAndTenSpaceCubicsAreNeverWrong) {
  const uint32_t queries = is_long() ? 100000 : 20;
  for (uint32_t seed = 0; seed < 30; ++seed)
    run(cubic(seed + 1, seed % 3 == 1, seed % 3 != 2), seed, queries);
}

TEST(TenBicubicSurfacesAreNeverWrong) {
  const uint32_t queries = is_long() ? 50000 : 60;
  for (uint32_t seed = 0; seed < (is_long() ? 10u : 2u); ++seed) {
    tools::Random random(seed + 40);
    tools::SplineSurface s;
    s.degree_u = s.degree_v = 3;
    s.count_u = 7 + random.below(2), s.count_v = 7 + random.below(3) % 2;
    const bool is_rational = seed % 2 == 1;
    for (size_t j = 0; j < s.count_v; ++j)
      for (size_t i = 0; i < s.count_u; ++i)
        s.points.push_back({0.15 * static_cast<double>(i) + random.between(-0.03, 0.03),
                            0.15 * static_cast<double>(j) + random.between(-0.03, 0.03),
                            random.between(-0.15, 0.15), is_rational ? random.between(0.3, 3) : 1});
    for (auto* knots : {&s.knots_u, &s.knots_v}) {
      const size_t count = knots == &s.knots_u ? s.count_u : s.count_v;
      double knot = 0;
      for (size_t i = 0; i < count + 4; ++i) {
        if (i > 3 && i <= count) knot += random.between(0.3, 1);
        knots->push_back(knot);
      }
    }
    s.u0 = s.knots_u[3], s.u1 = s.knots_u[s.count_u];
    s.v0 = s.knots_v[3], s.v1 = s.knots_v[s.count_v];
    tools::SplineModel model;
    model.surfaces.push_back(s);
    run(model, seed, queries);
  }
}

TEST(TheTeapotIsNeverWrong) {
  const char* models = std::getenv("FIRMTOUCH_MODELS");
  if (models == nullptr) return firmtouch::test::skip("FIRMTOUCH_MODELS is not set");
  run(tools::read_spline_file(std::string(models) + "/teapot.bpt", 0.01), 3,
      is_long() ? 50000 : 10);
}
