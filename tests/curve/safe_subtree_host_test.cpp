// Warm queries of a hand that moves little: what the last answer has certified lets a search stop
// early, and must never hide a nearer point. Against brute force in double, on the hard curves,
// with runs of every length.
#include <cstdio>
#include <cstdlib>

#include "curve/hard_curves.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;

const uint32_t kSteps =
    std::getenv("FIRMTOUCH_LONG") != nullptr ? 10000 : 250;  // a curve and length
constexpr double kPromise = 4e-7;                            // of max(diagonal, distance)

// Steps from nothing to a hundredth of the diagonal, about the curve, with a jump now and then.
struct Walker {
  std::mt19937 random;
  math::Vec3 at_m;

  double sign() { return curve_test::uniform(random) * 2 - 1; }
  void step(const Baked& baked) {
    const double diagonal = double{baked.view.head().diagonal_m};
    const double size = diagonal * std::pow(10.0, -2 - 4 * curve_test::uniform(random));
    if (curve_test::uniform(random) < 0.02) {
      const auto i = static_cast<size_t>(curve_test::uniform(random) *
                                         static_cast<double>(baked.samples.size()));
      at_m = baked.samples[i];
    }
    if (curve_test::uniform(random) < 0.1) return;  // stands still
    const double x = sign() * size, y = sign() * size, z = sign() * size;
    at_m = curve_test::point(double{at_m.x} + x, double{at_m.y} + y, double{at_m.z} + z);
  }
};

}  // namespace

TEST(WhatWasCertifiedBeforeNeverHidesANearerPoint) {
  uint32_t queries = 0, stopped_early = 0;
  for (uint32_t levels = 2; levels <= 8; ++levels) {
    for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
      const Baked baked(named.points, false, levels);
      CHECK(baked.report.problem.empty());
      test::note(named.name.c_str(), levels);
      Walker walker{std::mt19937(levels), baked.samples[0]};
      curve::Hint hint, rested;
      for (uint32_t i = 0; i < kSteps; ++i) {
        walker.step(baked);
        const math::Vec3 p = walker.at_m;
        const double truth = curve_test::brute_distance(baked.samples, p);
        const double scale = std::max(double{baked.view.head().diagonal_m}, truth);
        const bool had_safe_subtree = hint.safe_subtree != query::kNowhere;
        const curve::Closest found = closest_point(baked.view, p, query::kUnlimited, hint);
        CHECK(found.certificate.exact);
        CHECK_LE(std::abs(double{found.distance_m} - truth), kPromise * scale);
        CHECK_LE(double{found.certificate.lower_m}, truth * (1 + 1e-15));
        CHECK_GE(double{found.certificate.lower_m}, truth - kPromise * scale);
        ++queries;
        curve::Hint without = hint;
        without.safe_subtree = query::kNowhere;
        without.position_m = p;
        if (had_safe_subtree &&
            found.certificate.steps <
                closest_point(baked.view, p, query::kUnlimited, without).certificate.steps)
          ++stopped_early;
        // A hint that a penalised query or a short budget left is as good.
        if (i % 16 == 5) (void)guided_point(baked.view, p, {0.1f, found.arc, true}, {40}, hint);
        if (i % 16 == 9) (void)closest_point(baked.view, p, {2}, hint);
      }
    }
  }
  std::printf("      %u of %u queries stopped early\n", stopped_early, queries);
  CHECK_GE(stopped_early, queries / 50);
}
