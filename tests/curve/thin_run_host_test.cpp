// A recorded run, thinned: removed positions lie within the stated deviation, each checked against
// every piece.
#include "curve/thin_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "curve/hard_curves.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using tools::Place;

// A hand that goes along a knot, rests, trembles, turns back and goes on; encoders of 10 um.
std::vector<Place> hand(uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Place> run;
  double k = 0, shake[3] = {};
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 1000 < 800) k += (i % 2500 < 300 ? -1 : 1) * 6.3 / count;  // rests, goes back
    double at[3] = {0.1 * std::cos(3 * k), 0.1 * std::sin(2 * k), 0.03 * std::sin(7 * k)};
    for (int axis = 0; axis < 3; ++axis) {
      shake[axis] = 0.9 * shake[axis] + 2e-5 * (curve_test::uniform(random) - 0.5);
      at[axis] = std::round((at[axis] + shake[axis]) * 1e5) * 1e-5;
    }
    run.push_back({at[0], at[1], at[2]});
  }
  return run;
}

double to_piece(const Place& p, math::Vec3 a, math::Vec3 b) {
  const double e[3] = {double{b.x} - double{a.x}, double{b.y} - double{a.y},
                       double{b.z} - double{a.z}};
  const double v[3] = {p.x_m - double{a.x}, p.y_m - double{a.y}, p.z_m - double{a.z}};
  const double length2 = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
  const double t =
      length2 > 0 ? std::clamp((v[0] * e[0] + v[1] * e[1] + v[2] * e[2]) / length2, 0.0, 1.0) : 0;
  return std::hypot(v[0] - t * e[0], v[1] - t * e[1], v[2] - t * e[2]);
}

}  // namespace

TEST(EveryPlaceOfARunLiesWithinTheDeviationOfItsOwnPiece) {
  for (const double max_m : {1e-2, 1e-3, 1e-4, 1e-5, 1e-7}) {
    const std::vector<Place> run = hand(20000, 7);
    const tools::ThinnedRun thinned = tools::thin_run(run, max_m, "run");
    CHECK(thinned.points.problem.empty());
    const auto& samples = thinned.points.samples_m;
    const auto& rows = thinned.points.rows;
    CHECK_EQ(rows.front(), 0u);
    double worst_m = 0;
    for (size_t piece = 0; piece + 1 < samples.size(); ++piece)
      for (size_t i = rows[piece]; i <= rows[piece + 1]; ++i)
        worst_m = std::max(worst_m, to_piece(run[i], samples[piece], samples[piece + 1]));
    for (size_t i = rows.back(); i < run.size(); ++i)
      worst_m = std::max(worst_m, to_piece(run[i], samples.back(), samples.back()));
    CHECK_LE(worst_m, max_m);
    CHECK_LE(worst_m, thinned.max_deviation_m * (1 + 1e-9) + 1e-12);
    if (max_m >= 1e-4) {
      CHECK_LE(samples.size() * 20, run.size());  // thinned indeed
      CHECK_GE(worst_m, 0.5 * max_m);             // and as far as that allows
    }
  }
}

TEST(TheGuideNeverLeavesTheRunByMoreThanTheDeviationEither) {
  const std::vector<Place> run = hand(4000, 9);
  const tools::ThinnedRun thinned = tools::thin_run(run, 5e-4, "run");
  const auto& samples = thinned.points.samples_m;
  const auto& rows = thinned.points.rows;
  double worst_m = 0;
  for (size_t piece = 0; piece + 1 < samples.size(); ++piece) {
    for (int share = 0; share <= 20; ++share) {
      const double t = share / 20.0;
      const math::Vec3 a = samples[piece], b = samples[piece + 1];
      const Place q{double{a.x} + t * (double{b.x} - double{a.x}),
                    double{a.y} + t * (double{b.y} - double{a.y}),
                    double{a.z} + t * (double{b.z} - double{a.z})};
      double min_m = HUGE_VAL;
      for (size_t i = rows[piece]; i < rows[piece + 1]; ++i) {
        const auto stored = [](const Place& p) { return curve_test::point(p.x_m, p.y_m, p.z_m); };
        min_m = std::min(min_m, to_piece(q, stored(run[i]), stored(run[i + 1])));
      }
      worst_m = std::max(worst_m, min_m);
    }
  }
  CHECK_LE(worst_m, 5e-4 + 2e-8);  // the oracle joins positions rounded to float32
}

TEST(RunsThatTeachNothingAreRefused) {
  const auto problem = [](const std::vector<Place>& run, double max_m) {
    return tools::thin_run(run, max_m, "run.ftl").points.problem;
  };
  CHECK(problem({}, 1e-4).find("run.ftl: 0 recorded places") == 0);
  CHECK(problem({{0, 0, 0}}, 1e-4).find("1 recorded") != std::string::npos);
  CHECK(!problem(std::vector<Place>(5000, {0.1, 0.2, 0.3}), 1e-4).empty());  // stands still
  CHECK(problem({{100.1, 0, 0}, {100.2, 0, 0}, {100.3, 0, 0}}, 1e-7).find("finer than float32") !=
        std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!problem({{0, 0, 0}, {nan, 0, 0}, {1, 0, 0}}, 1e-4).empty());
  CHECK(!problem({{0, 0, 0}, {1, 0, 0}}, nan).empty());
}
