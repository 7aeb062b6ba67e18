// Closest point of a curve against brute force in double, on curves that an inexact search gets
// wrong.
#include "firmtouch/curve/closest_point.hpp"

#include <cstdio>
#include <cstdlib>

#include "curve/hard_curves.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;

const uint32_t kQueries = std::getenv("FIRMTOUCH_LONG") != nullptr ? 100000 : 2500;  // a curve
constexpr double kPromise = 4e-7;  // of max(diagonal, distance)

struct Findings {
  double worst_error = 0, worst_lower = 0;  // of max(diagonal, distance)
  uint64_t steps = 0;
};

void check(const Baked& baked, math::Vec3 p, double truth, const curve::Closest& found,
           Findings& findings) {
  const double diagonal = double{baked.view.head().diagonal_m};
  const double scale = std::max(diagonal, truth);
  const double upper = double{found.distance_m}, lower = double{found.certificate.lower_m};
  CHECK_LE(lower, truth * (1 + 1e-15));
  CHECK_GE(upper, truth - kPromise * scale);
  if (found.certificate.exact) {
    CHECK_LE(upper, truth + kPromise * scale);
    CHECK_GE(lower, truth - kPromise * scale);
    findings.worst_error = std::max(findings.worst_error, std::abs(upper - truth) / scale);
    findings.worst_lower = std::max(findings.worst_lower, (truth - lower) / scale);
  }
  // The other fields belong to the same point.
  CHECK_LT(found.segment, baked.view.segment_count());
  const float from = baked.view.arcs()[found.segment], to = baked.view.arcs()[found.segment + 1];
  CHECK_GE(found.arc, from - 1e-7f);
  CHECK_LE(found.arc, to + 1e-7f);
  const double room =
      kPromise * (scale + std::abs(double{p.x}) + std::abs(double{p.y}) + std::abs(double{p.z})) +
      2e-7 * (std::abs(double{found.point_m.x}) + std::abs(double{found.point_m.y}) +
              std::abs(double{found.point_m.z}));
  CHECK_LE(curve_test::nearest_on_segment(found.point_m, baked.samples[found.segment],
                                          baked.samples[found.segment + 1])
               .distance,
           room);
  CHECK_LE(std::abs(std::hypot(double{found.tangent.x}, double{found.tangent.y},
                               double{found.tangent.z}) -
                    1),
           1e-6);
  findings.steps += found.certificate.steps;
}

}  // namespace

TEST(ExactOnHardCurvesColdAndWarm) {
  Findings all;
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    CHECK(baked.report.problem.empty());
    test::note(named.name.c_str(), 0);
    curve::Hint warm;
    for (const math::Vec3& p : curve_test::queries(baked.samples, kQueries, 17)) {
      const double truth = curve_test::brute_distance(baked.samples, p);
      curve::Hint cold;
      const curve::Closest alone = closest_point(baked.view, p, query::kUnlimited, cold);
      const curve::Closest next = closest_point(baked.view, p, query::kUnlimited, warm);
      CHECK(alone.certificate.exact && next.certificate.exact);
      check(baked, p, truth, alone, all);
      check(baked, p, truth, next, all);
    }
  }
  std::printf("      worst error %.2e, worst lower bound %.2e of max(diagonal, distance)\n",
              all.worst_error, all.worst_lower);
}

TEST(EveryBudgetBracketsTheTruthColdAndWarmAndNeverWidens) {
  const uint32_t budgets[] = {1, 2, 4, 16, 64, 256, UINT32_MAX};
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    curve::Hint warm[7];
    curve::Hint before;  // the same for every budget: warm gaps can be compared
    for (const math::Vec3& p : curve_test::queries(baked.samples, kQueries / 5, 23)) {
      const double truth = curve_test::brute_distance(baked.samples, p);
      Findings findings;
      float cold_gap_m = HUGE_VALF, warm_gap_m = HUGE_VALF;
      curve::Hint after;
      for (uint32_t b = 0; b < 7; ++b) {
        curve::Hint cold, same = before;
        const curve::Closest alone = closest_point(baked.view, p, {budgets[b]}, cold);
        const curve::Closest one = closest_point(baked.view, p, {budgets[b]}, same);
        check(baked, p, truth, alone, findings);
        check(baked, p, truth, one, findings);
        check(baked, p, truth, closest_point(baked.view, p, {budgets[b]}, warm[b]), findings);
        CHECK_LE(alone.certificate.steps, budgets[b]);
        CHECK_LE(alone.distance_m - alone.certificate.lower_m, cold_gap_m);
        CHECK_LE(one.distance_m - one.certificate.lower_m, warm_gap_m);
        cold_gap_m = alone.distance_m - alone.certificate.lower_m;
        warm_gap_m = one.distance_m - one.certificate.lower_m;
        after = same;
      }
      before = after;
    }
  }
}

TEST(SixtyFourStepsKnowMostOfTheDistance) {
  for (const uint32_t count : {2000u, 100000u}) {
    const Baked baked(curve_test::knot(count, 1, 5));
    std::vector<double> parts;
    std::mt19937 random(6);
    const auto next = [&] { return curve_test::uniform(random) * 0.4 - 0.2; };
    for (uint32_t i = 0; i < 1000; ++i) {
      const double x = next(), y = next(), z = next();
      const math::Vec3 p = curve_test::point(x, y, z);
      curve::Hint cold, whole;
      const curve::Closest quick = closest_point(baked.view, p, {64}, cold);
      const curve::Closest exact = closest_point(baked.view, p, query::kUnlimited, whole);
      parts.push_back(double{quick.certificate.lower_m} / double{exact.distance_m});
    }
    std::sort(parts.begin(), parts.end());
    std::printf("      %u samples: median lower bound %.3f of the truth, 5th percentile %.3f\n",
                count, parts[500], parts[50]);
    CHECK_GE(parts[500], count == 2000 ? 0.85 : 0.8);
  }
}
