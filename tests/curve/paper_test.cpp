// The published way of a curve constraint and the cases of its figures 1 and 2, on host and
// controller.
#include "curve/small_curve.hpp"
#include "firmtouch/curve/nearest_constraint.hpp"
#include "harness/test.hpp"

namespace {

using firmtouch::core::Span;
using namespace firmtouch::curve;  // NOLINT: a test file
using firmtouch::curve_test::SmallCurve;
using firmtouch::math::Vec3;
using firmtouch::query::kUnlimited;

// Figures 1 and 2: a long segment from vertex 1 to 2 (here samples 1 and 2), and the curve coming
// back so that vertex 4 lies near the middle of that segment.
constexpr Sample kReturning[] = {{-0.5f, 0.5f, 0}, {0, 0, 0},     {2, 0, 0},
                                 {2, 1, 0},        {1, 0.25f, 0}, {0.5f, 1, 0}};

Constraint constrain(const View& view, Vec3 p, const ArcPenalty& penalty, uint32_t n) {
  static Neighbour memory[firmtouch::curve::kMaxNearest];
  return nearest_constraint(view, p, penalty, Span<Neighbour>(memory, n), kUnlimited);
}

ArcPenalty held_at(float arc, float weight_m) { return {weight_m, arc, true}; }

}  // namespace

TEST(Figure1TheNearestSampleAloneTiesToTheWrongSegment) {
  const SmallCurve c(kReturning);
  const Vec3 device{1, 0.0625f, 0};  // nearer to the long segment than to vertex 4
  const Constraint one = constrain(c.view(), device, {}, 1);
  CHECK(one.closest.segment == 3 || one.closest.segment == 4);
  CHECK_EQ(one.closest.certificate.exact, false);
  CHECK_LE(one.closest.certificate.lower_m, 0.0625f);
}

TEST(Figure1_EnoughNeighbours_FindTheSegment_ExactSearchNeedsNone) {
  const SmallCurve c(kReturning);
  const Vec3 device{1, 0.0625f, 0};
  const Constraint three = constrain(c.view(), device, {}, 4);
  CHECK_EQ(three.closest.segment, 1u);
  CHECK_EQ(three.closest.distance_m, 0.0625f);
  Hint hint;
  const firmtouch::curve::Closest exact = closest_point(c.view(), device, kUnlimited, hint);
  CHECK_EQ(exact.segment, 1u);
  CHECK_EQ(exact.distance_m, 0.0625f);
}

TEST(Figure2_Penalty_KeepsTheSegment_AtVertex4) {
  const SmallCurve c(kReturning);
  const View view = c.view();
  const Vec3 device{1, 0.25f, 0};  // on vertex 4
  const float previous = (view.arcs()[1] + view.arcs()[2]) * 0.5f;
  const Constraint jumped = constrain(view, device, held_at(previous, 0.0f), 6);
  CHECK_EQ(jumped.closest.distance_m, 0.0f);
  CHECK(jumped.closest.segment == 3 || jumped.closest.segment == 4);
  const Constraint held = constrain(view, device, held_at(previous, 1.0f), 6);
  CHECK_EQ(held.closest.segment, 1u);
  CHECK_EQ(held.closest.distance_m, 0.25f);
  CHECK_EQ(held.closest.point_m.x, 1.0f);
}

TEST(WithoutAPreviousStateThereIsNoPenalty) {
  const SmallCurve c(kReturning);
  const Constraint first = constrain(c.view(), {1, 0.25f, 0}, {1e6f, 0.4f, false}, 6);
  CHECK_EQ(first.closest.distance_m, 0.0f);
  CHECK_EQ(first.cost_m, 0.0f);
}

TEST(AStalePreviousArcChangesNothingAtWeightZero) {
  const SmallCurve c(kReturning);
  for (uint32_t i = 0; i <= 10; ++i) {
    const float stale = static_cast<float>(i) * 0.1f;
    const Constraint found = constrain(c.view(), {1, 0.1f, 0.3f}, held_at(stale, 0.0f), 6);
    const Constraint fresh = constrain(c.view(), {1, 0.1f, 0.3f}, {}, 6);
    CHECK_EQ(found.closest.segment, fresh.closest.segment);
    CHECK_EQ(found.cost_m, fresh.cost_m);
  }
}

TEST(TheArcOfAPointRunsFromTheFirstSampleToTheSecond) {
  // The printed code has it the other way round: at a quarter of the segment it would say 3/4.
  const Sample line[] = {{0, 0, 0}, {4, 0, 0}};
  const SmallCurve c(line);
  CHECK_EQ(constrain(c.view(), {1, 1, 0}, {}, 2).closest.arc, 0.25f);
}

TEST(TheCostIsDistancePlusWeightedChangeOfArc) {
  const Sample line[] = {{0, 0, 0}, {4, 0, 0}};
  const SmallCurve c(line);
  const Constraint found = constrain(c.view(), {1, 1, 0}, held_at(0.75f, 2.0f), 2);
  CHECK_EQ(found.cost_m, 2.0f);  // 1 m and 2 m * 0.5
}

TEST(OnAClosedCurveTheChangeOfArcIsTakenTheShorterWay) {
  const Sample ring[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  const SmallCurve c(ring);
  const Constraint found = constrain(c.view(), {0.25f, -0.125f, 0}, held_at(0.9375f, 1.0f), 5);
  CHECK_EQ(found.closest.segment, 0u);
  CHECK_EQ(found.cost_m, 0.125f + 0.125f);
}

TEST(CandidatesAreEachSegmentOnceAndAtMostTwiceTheSamples) {
  const SmallCurve c(kReturning);
  for (uint32_t n = 1; n <= 6; ++n) {
    const Constraint found = constrain(c.view(), {0.7f, 0.4f, 0.1f}, {}, n);
    CHECK_LE(found.candidates, 2 * n);
    CHECK_LE(found.candidates, 5u);
    CHECK_GE(found.candidates, 1u);
  }
  CHECK_EQ(constrain(c.view(), {0.7f, 0.4f, 0.1f}, {}, 6).candidates, 5u);
  CHECK_EQ(constrain(c.view(), {0.7f, 0.4f, 0.1f}, {}, 100).candidates, 5u);
}

TEST(HostileInputsGiveFiniteConstraints) {
  const SmallCurve c(kReturning);
  const float nan = __builtin_nanf(""), inf = __builtin_inff();
  const float values[] = {nan, inf, -inf, 1e30f, 1e-45f, -0.0f, 3e38f};
  for (const float x : values) {
    for (const float w : values) {
      const Constraint found = constrain(c.view(), {x, 0.5f, 0}, held_at(w, x), 3);
      CHECK(found.cost_m - found.cost_m <= 0.0f);
      CHECK(found.closest.distance_m - found.closest.distance_m <= 0.0f);
      const Constraint other = constrain(c.view(), {0.5f, 0.5f, 0}, held_at(w, x), 3);
      CHECK(other.cost_m - other.cost_m <= 0.0f);
    }
  }
  const Constraint none = constrain(c.view(), {1, 0.0625f, 0}, {}, 0);
  CHECK_EQ(none.closest.distance_m, 0.0625f);
  CHECK_EQ(none.candidates, 0u);
}

TEST(ABudgetThatEndsLeavesACertifiedConstraint) {
  const SmallCurve c(kReturning);
  Neighbour memory[4];
  const Vec3 device{1, 0.0625f, 0};
  for (uint32_t steps = 0; steps < 8; ++steps) {
    const Constraint found =
        nearest_constraint(c.view(), device, {}, Span<Neighbour>(memory), {steps});
    CHECK_LE(found.closest.certificate.steps, steps == 0 ? 1u : steps);
    CHECK_LE(found.closest.certificate.lower_m, 0.0625f);
    CHECK_GE(found.closest.distance_m, 0.0625f);
    CHECK_GE(found.candidates, 1u);
  }
}
