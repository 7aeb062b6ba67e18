// The published way against a plain rendering of its text in double.
#include "firmtouch/curve/nearest_constraint.hpp"

#include <set>
#include <utility>

#include "curve/hard_curves.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;

double length(math::Vec3 a, math::Vec3 b) {
  return std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y},
                    double{a.z} - double{b.z});
}

double cost(const Baked& baked, math::Vec3 p, const curve::ArcPenalty& penalty, size_t segment) {
  const math::Vec3 a = baked.samples[segment], b = baked.samples[segment + 1];
  const double whole = length(a, b);
  const double along = ((double{p.x} - double{a.x}) * (double{b.x} - double{a.x}) +
                        (double{p.y} - double{a.y}) * (double{b.y} - double{a.y}) +
                        (double{p.z} - double{a.z}) * (double{b.z} - double{a.z})) /
                       (whole * whole);
  const double t = std::clamp(along, 0.0, 1.0);
  const auto index = static_cast<uint32_t>(segment);
  const double arc =
      double{baked.view.arcs()[index]} * (1 - t) + double{baked.view.arcs()[index + 1]} * t;
  double change = std::abs(arc - double{penalty.previous_arc});
  if (baked.view.is_closed()) change = std::min(change, 1 - change);
  return curve_test::nearest_on_segment(p, a, b).distance +
         (penalty.has_previous ? double{penalty.weight_m} * change : 0);
}

struct Plain {
  double least = HUGE_VAL, most = HUGE_VAL;
};

// Sorts all samples by distance, takes n, collects segments in an ordered set, tries each. Samples
// as near as the last one taken, to float32, may be among the n or not: `least` has them all,
// `most` has none of them.
Plain plainly(const Baked& baked, math::Vec3 p, const curve::ArcPenalty& penalty, size_t n) {
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < baked.samples.size(); ++i)
    order.push_back({length(baked.samples[i], p), i});
  std::sort(order.begin(), order.end());
  n = std::min(n, order.size());
  const double last = order[n - 1].first, within = last * (1 + 1e-6), below = last * (1 - 1e-6);
  const bool is_tied = n < order.size() && order[n].first <= within;
  std::set<size_t> most, least;
  for (size_t i = 0; i < order.size() && (i < n || order[i].first <= within); ++i) {
    const size_t sample = order[i].second;
    for (size_t s = sample == 0 ? 0 : sample - 1; s <= sample && s + 1 < baked.samples.size();
         ++s) {
      least.insert(s);
      if (!is_tied || order[i].first < below) most.insert(s);
    }
  }
  Plain plain;
  for (const size_t s : least) plain.least = std::min(plain.least, cost(baked, p, penalty, s));
  for (const size_t s : most) plain.most = std::min(plain.most, cost(baked, p, penalty, s));
  return plain;
}

}  // namespace

TEST(TheSameCostAsThePlainTextOnHardCurves) {
  static curve::Neighbour memory[curve::kMaxNearest];
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    const double diagonal = double{baked.view.head().diagonal_m};
    std::mt19937 random(31);
    for (const math::Vec3& p : curve_test::queries(baked.samples, 150, 29)) {
      for (const uint32_t n : {1u, 10u, 100u}) {
        const curve::ArcPenalty penalty{
            static_cast<float>(diagonal * 3 * curve_test::uniform(random)),
            static_cast<float>(curve_test::uniform(random)), random() % 4 != 0};
        const curve::Constraint found =
            nearest_constraint(baked.view, p, penalty, {memory, n}, query::kUnlimited);
        const Plain plain = plainly(baked, p, penalty, n);
        const double reported = double{found.cost_m}, slack = 1e-6 * (diagonal + reported);
        CHECK_GE(reported, plain.least - slack);
        CHECK_LE(reported, plain.most + slack);
        CHECK_LE(found.candidates, 2 * n);
        const double truth = curve_test::brute_distance(baked.samples, p);
        CHECK_LE(double{found.closest.certificate.lower_m}, truth * (1 + 1e-15));
        if (found.closest.certificate.exact)
          CHECK_LE(double{found.closest.distance_m}, truth + 4e-7 * std::max(diagonal, truth));
      }
    }
  }
}

TEST(TenNearestSamples_VaryingSpacing_Miss_ExactSearchDoesNot) {
  static curve::Neighbour memory[10];
  const Baked baked(curve_test::strands());
  uint32_t missed = 0, wrong = 0;
  const auto points = curve_test::queries(baked.samples, 1000, 37);
  for (const math::Vec3& p : points) {
    curve::Hint cold;
    const float exact = closest_point(baked.view, p, query::kUnlimited, cold).distance_m;
    const float nearest =
        nearest_constraint(baked.view, p, {}, {memory, 10}, query::kUnlimited).closest.distance_m;
    missed += nearest > exact * 1.001f ? 1 : 0;
    wrong +=
        double{exact} > curve_test::brute_distance(baked.samples, p) + 1e-6 * (1 + double{exact});
  }
  CHECK_GE(missed, 50u);
  CHECK_EQ(wrong, 0u);
}

TEST(NearestConstraint_WithoutTree_AnswersAsClosestPoint) {
  tools::CurvePoints points;
  points.samples_m = curve_test::knot(500, 1, 3);
  tools::CurveReport report;
  const auto sections = tools::bake_curve(points, "curve", report);
  curve::View view;
  CHECK(tools::open_baked(sections, "curve", view).ok());
  CHECK(view.tree().empty());
  curve::Neighbour memory[10];
  for (const math::Vec3& p : curve_test::queries(points.samples_m, 40, 21)) {
    curve::Hint cold;
    const curve::Closest closest = closest_point(view, p, query::kUnlimited, cold);
    const curve::Constraint found = nearest_constraint(view, p, {}, memory, query::kUnlimited);
    CHECK_EQ(found.closest.distance_m, closest.distance_m);
    CHECK_EQ(found.closest.segment, closest.segment);
    CHECK(found.closest.certificate.exact);
  }
}
