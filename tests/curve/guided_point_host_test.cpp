// The penalised point against every segment in double, and a guide on a track that passes itself.
#include "firmtouch/curve/guided_point.hpp"

#include <cstdio>
#include <cstdlib>

#include "curve/hard_curves.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;
using curve_test::point;

uint32_t queries_a_curve() { return std::getenv("FIRMTOUCH_LONG") != nullptr ? 100000 : 600; }

struct Least {
  double cost = HUGE_VAL;
  double distance = 0;
};

// Of the closest points of all segments the least distance + penalty.
Least brute_cost(const Baked& baked, math::Vec3 p, const curve::ArcPenalty& penalty) {
  Least least;
  const auto arcs = baked.view.arcs();
  for (uint32_t i = 0; i + 1 < baked.samples.size(); ++i) {
    const auto [distance, t] =
        curve_test::nearest_on_segment(p, baked.samples[i], baked.samples[i + 1]);
    double change = std::abs(double{arcs[i]} * (1 - t) + double{arcs[i + 1]} * t -
                             double{penalty.previous_arc});
    if (baked.view.is_closed()) change = std::min(change, 1 - change);
    const double cost = distance + (penalty.has_previous ? double{penalty.weight_m} * change : 0);
    if (cost < least.cost) least = {cost, distance};
  }
  return least;
}

// What float32 may lose: of the distance, and of arc positions beside the weight.
double room(const Baked& baked, const Least& truth, float weight_m) {
  const double scale = std::max(double{baked.view.head().diagonal_m}, truth.distance);
  return 4e-7 * scale + 1e-6 * double{weight_m} * (1 + truth.cost / baked.report.length_m);
}

void check(const Baked& baked, math::Vec3 p, const curve::ArcPenalty& penalty,
           const curve::Constraint& found) {
  const Least truth = brute_cost(baked, p, penalty);
  const double most = room(baked, truth, penalty.weight_m);
  const double reported = double{found.cost_m}, lower = double{found.closest.certificate.lower_m};
  CHECK_LE(lower, truth.cost * (1 + 1e-15));
  CHECK_GE(reported, truth.cost - most);
  if (!found.closest.certificate.exact) return;
  CHECK_LE(reported, truth.cost + most);
  CHECK_GE(lower, truth.cost - 2 * most);
}

constexpr double kWeights[] = {0.01, 0.1, 1, 10};  // of the diagonal

// A line that comes back beside itself at a 500th of its size, twice, far along its length.
curve_test::Points track() {
  curve_test::Points points;
  for (int strand = 0; strand < 3; ++strand) {
    for (int i = 0; i < 400; ++i) {
      const double x = i / 400.0;
      points.push_back(point(strand == 1 ? 1 - x : x, 0.002 * strand, 0));
    }
    const double side = strand == 1 ? -0.15 : 1.15;  // round a turn
    if (strand < 2) points.push_back(point(side, 0.002 * strand + 0.001, 0.1));
  }
  return points;
}

struct Ride {
  uint32_t jumps = 0;      // to a part farther than a twentieth of the length
  uint32_t backwards = 0;  // ticks
  float last_arc = 0;
};

// A hand that is led along the first strand and wanders beyond the middle between it and the next.
Ride ride(const Baked& baked, double weight) {
  Ride ridden;
  curve::Following following;
  const curve::Hold hold{static_cast<float>(weight), 10.0f};
  for (int k = 0; k <= 5000; ++k) {
    const double x = 0.05 + 0.9 * k / 5000, aside = 0.00075 * (1 - std::cos((x - 0.05) * 60));
    const curve::Followed tick =
        follow(baked.view, point(x, aside, 0), hold, query::kUnlimited, following);
    CHECK(tick.is_held);
    CHECK_EQ(tick.is_new, k == 0);
    if (std::abs(tick.change_of_arc) > 0.05f) ++ridden.jumps;
    if (tick.change_of_arc < 0) ++ridden.backwards;
    ridden.last_arc = tick.closest.arc;
  }
  return ridden;
}

}  // namespace

TEST(TheLeastCostOfAllSegmentsOnHardCurves) {
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    std::mt19937 random(3);
    curve::Hint warm;
    float last_arc = 0.5f;
    const auto places = curve_test::queries(baked.samples, queries_a_curve(), 29);
    for (size_t i = 0; i < places.size(); ++i) {
      curve::ArcPenalty penalty;
      penalty.weight_m = static_cast<float>(kWeights[i % 4] * double{baked.view.head().diagonal_m});
      penalty.previous_arc =
          i % 3 == 0 ? static_cast<float>(curve_test::uniform(random)) : last_arc;
      penalty.has_previous = true;
      curve::Hint cold;
      const auto alone = guided_point(baked.view, places[i], penalty, query::kUnlimited, cold);
      const auto next = guided_point(baked.view, places[i], penalty, query::kUnlimited, warm);
      CHECK(alone.closest.certificate.exact && next.closest.certificate.exact);
      check(baked, places[i], penalty, alone);
      check(baked, places[i], penalty, next);
      last_arc = next.closest.arc;
    }
  }
}

// Where few segments beside the nearest point's can cost less, those alone are looked at.
TEST(LeastCost_OfAHandThatIsLedAlong_IsThatOfAllSegments) {
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    const float size_m = baked.view.head().diagonal_m;
    std::mt19937 random(5);
    curve::Hint hint;
    math::Vec3 p = baked.samples[0], step{};
    for (uint32_t i = 0; i < queries_a_curve(); ++i) {
      const auto any = [&] { return static_cast<float>(curve_test::uniform(random) - 0.5); };
      if (i % 50 == 0) p = baked.samples[random() % baked.samples.size()];
      if (i % 10 == 0) step = math::Vec3{any(), any(), any()} * (size_m * 0.002f);
      p = p + step;
      const curve::Closest on = curve::closest_point(baked.view, p, query::kUnlimited, hint);
      const float behind = any() * (i % 2 == 0 ? 0.002f : 0.02f);
      curve::ArcPenalty penalty{static_cast<float>(kWeights[i % 4]) * size_m, on.arc + behind,
                                true};
      penalty.previous_arc = std::min(std::max(penalty.previous_arc, 0.0f), 1.0f);
      const auto found = guided_point(baked.view, p, penalty, query::kUnlimited, hint);
      CHECK(found.closest.certificate.exact);
      check(baked, p, penalty, found);
    }
  }
}

// A sample is then as near as the foot, to the last bit, but not where the foot is.
TEST(LeastCost_OfAFootNextToASample_IsThatOfAllSegments) {
  const Baked baked({{0.1f, 0.2f, 0.3f}, {-0.4f, 0.35f, 0.7f}});
  const math::Vec3 end_m = baked.samples[1], along_m = end_m - baked.samples[0];
  const float size_m = baked.view.head().diagonal_m;
  std::mt19937 random(7);
  const auto any = [&] { return static_cast<float>(curve_test::uniform(random)); };
  for (uint32_t i = 0; i < 4000; ++i) {
    const math::Vec3 aside = math::cross(along_m, math::Vec3{any(), any(), any()});
    const float aside_m = 0.1f * any() * size_m, before_m = 3e-4f * any() * aside_m;
    const math::Vec3 p_m = end_m + aside * (aside_m / math::length(aside)) -
                           along_m * (before_m / math::length(along_m));
    curve::Hint hint;
    (void)curve::closest_point(baked.view, p_m, query::kUnlimited, hint);
    const curve::ArcPenalty penalty{static_cast<float>(kWeights[i % 4]) * size_m,
                                    i % 3 == 0 ? 1.0f : 0.99f, true};
    check(baked, p_m, penalty, guided_point(baked.view, p_m, penalty, query::kUnlimited, hint));
  }
}

TEST(EveryBudgetBracketsTheCost) {
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    curve::Hint warm;
    for (const math::Vec3& p : curve_test::queries(baked.samples, 100, 31)) {
      for (const uint32_t steps : {1u, 2u, 4u, 8u, 16u, 64u}) {
        const curve::ArcPenalty penalty{baked.view.head().diagonal_m, 0.3f, true};
        curve::Hint cold;
        const auto alone = guided_point(baked.view, p, penalty, {steps}, cold);
        CHECK_LE(alone.closest.certificate.steps, steps);
        check(baked, p, penalty, alone);
        check(baked, p, penalty, guided_point(baked.view, p, penalty, {steps}, warm));
      }
    }
  }
}

TEST(WithoutAPenaltyItIsTheClosestPointBitForBit) {
  const Baked baked(curve_test::knot(1000, 6, 1));
  curve::Hint plain, stale, fresh;
  for (const math::Vec3& p : curve_test::queries(baked.samples, 500, 37)) {
    const auto wanted = closest_point(baked.view, p, query::kUnlimited, plain);
    const auto at_zero = guided_point(baked.view, p, {0.0f, 0.7f, true}, query::kUnlimited, stale);
    const auto at_first =
        guided_point(baked.view, p, {5.0f, 0.7f, false}, query::kUnlimited, fresh);
    for (const curve::Constraint& found : {at_zero, at_first}) {
      CHECK_EQ(found.closest.distance_m, wanted.distance_m);
      CHECK_EQ(found.closest.arc, wanted.arc);
      CHECK_EQ(found.closest.segment, wanted.segment);
      CHECK_EQ(found.closest.certificate.lower_m, wanted.certificate.lower_m);
      CHECK_EQ(found.closest.certificate.steps, wanted.certificate.steps);
    }
  }
}

TEST(NoWeightJumpsWhereTheTrackPassesItselfButWeightZeroDoes) {
  const Baked baked(track());
  const double size = double{baked.view.head().diagonal_m};
  for (const double weight : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    const Ride ridden = ride(baked, weight * size);
    std::printf("      weight %5.2f of the size: %u jumps, ends at arc %.4f\n", weight,
                ridden.jumps, double{ridden.last_arc});
    CHECK_EQ(ridden.jumps, 0u);
    CHECK_EQ(ridden.backwards, 0u);
  }
  CHECK_GE(ride(baked, 0).jumps, 10u);
}
