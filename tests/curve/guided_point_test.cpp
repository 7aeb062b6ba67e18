// The penalised point and the guide's state on host and controller.
#include "firmtouch/curve/guided_point.hpp"

#include <float.h>

#include "curve/small_curve.hpp"
#include "firmtouch/core/hash.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch::curve;       // NOLINT: a test file
using namespace firmtouch::curve_test;  // NOLINT
using firmtouch::math::Vec3;
using firmtouch::query::kUnlimited;

// The published figure 2: vertex 4 lies on the way from vertex 1 to vertex 2.
constexpr Sample kReturning[] = {{0, 1, 0}, {0, 0, 0},     {2, 0, 0},
                                 {2, 1, 0}, {1, 0.25f, 0}, {1, 1, 0}};

Constraint guided(const View& view, Vec3 p, ArcPenalty penalty) {
  Hint hint;
  return guided_point(view, p, penalty, kUnlimited, hint);
}

// Sixteen loops that pass near themselves.
const LongCurve& loops() {
  static Sample samples[256];
  for (uint32_t i = 0; i < 256; ++i) {
    const uint32_t k = i % 16;
    const float side = static_cast<float>(k < 8 ? k : 16 - k) * 0.125f;
    samples[i] = {side, static_cast<float>(i) * 0x1p-9f, k < 8 ? 0.0f : 0.25f};
  }
  static const LongCurve curve(samples, 256);
  return curve;
}

}  // namespace

TEST(APenaltyKeepsTheGuideOnItsSegmentOfFigure2) {
  const SmallCurve c(kReturning);
  const View view = c.view();
  const float previous = (view.arcs()[1] + view.arcs()[2]) * 0.5f;
  const Constraint jumped = guided(view, {1, 0.25f, 0}, {0.0f, previous, true});
  CHECK_EQ(jumped.closest.distance_m, 0.0f);
  const Constraint held = guided(view, {1, 0.25f, 0}, {1.0f, previous, true});
  CHECK_EQ(held.closest.segment, 1u);
  CHECK_EQ(held.closest.distance_m, 0.25f);
  CHECK_EQ(held.closest.certificate.exact, true);
}

TEST(ThePenaltyOfAClosedCurveGoesTheShorterWay) {
  const Sample ring[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  const SmallCurve c(ring);
  const Constraint found = guided(c.view(), {0.25f, -0.125f, 0}, {1.0f, 0.9375f, true});
  CHECK_EQ(found.closest.segment, 0u);
  CHECK_EQ(found.cost_m, 0.125f + 0.125f);
}

TEST(Guide_BeyondRelease_LetsGo_AndHoldsAgain) {
  const SmallCurve c(kReturning);
  const Hold hold{1.0f, 0.5f};
  Following following;
  const Followed first = follow(c.view(), {1, -0.25f, 0}, hold, kUnlimited, following);
  CHECK(first.is_new && first.is_held);
  const Followed next = follow(c.view(), {1.125f, 0.125f, 0}, hold, kUnlimited, following);
  CHECK(!next.is_new && next.is_held);
  CHECK_EQ(next.closest.segment, 1u);
  CHECK_GE(next.change_of_arc, 0.0f);
  const Followed gone = follow(c.view(), {1, 0.25f, 3}, hold, kUnlimited, following);
  CHECK(gone.is_new && !gone.is_held && !following.is_following);
  const Followed again = follow(c.view(), {1, 0.25f, 0}, hold, kUnlimited, following);
  CHECK(again.is_new && again.is_held);
  CHECK_EQ(again.closest.distance_m, 0.0f);  // by distance alone
}

TEST(Guide_JumpToAnotherPart_HoldsItAtOnce) {
  const SmallCurve c(kReturning);
  Following following;
  const Hold hold{10.0f, 0.2f};
  (void)follow(c.view(), {0, 0.9f, 0}, hold, kUnlimited, following);
  const Followed torn = follow(c.view(), {1, 0.9f, 0}, hold, kUnlimited, following);
  CHECK(torn.is_new && torn.is_held);
  CHECK_EQ(torn.closest.segment, 4u);
  CHECK_EQ(torn.change_of_arc, 0.0f);
}

TEST(HostilePenaltiesGiveFiniteAnswers) {
  const View view = loops().view();
  const float values[] = {
      __builtin_nanf(""), __builtin_inff(), -1.0f, 0.0f, 1e-45f, 0.5f, 1.0f, 1e18f, 1e30f, FLT_MAX};
  Hint hint;
  for (const float weight : values) {
    for (const float arc : values) {
      for (const float x : values) {
        const Constraint found =
            guided_point(view, {x, 0.1f, 0.1f}, {weight, arc, true}, {20}, hint);
        CHECK(found.cost_m - found.cost_m <= 0.0f);
        CHECK(found.closest.arc >= 0.0f && found.closest.arc <= 1.0f);
        CHECK_LE(found.closest.certificate.lower_m, found.cost_m);
        CHECK_LE(found.closest.certificate.steps, 20u);
      }
    }
  }
  Following following;
  const Followed lost =
      follow(view, {__builtin_nanf(""), 0, 0}, {1.0f, 1.0f}, kUnlimited, following);
  CHECK(!lost.is_held && !following.is_following);
}

// The same on every compiler and controller: smooth pieces, cold, warm, penalised and by budget.
TEST(CubicPieces_HaveOneHash_Everywhere) {
  static LongCurve smooth = [] {
    LongCurve made = loops();
    made.head.is_smooth = 1;
    made.derive();
    return made;
  }();
  const View view = smooth.view();
  CHECK(view.is_open());
  firmtouch::core::Hash hash, starved;
  Hint hint, starved_hint;
  Following following;
  uint32_t state = 1;
  const auto next = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 8) * 0x1p-24f;
  };
  for (uint32_t i = 0; i < 300; ++i) {
    const Vec3 p{next() * 1.5f, next() * 0.75f, next() * 0.5f};
    const ArcPenalty penalty{0.5f, next(), i % 3 != 0};
    const Constraint found = guided_point(view, p, penalty, kUnlimited, hint);
    const Constraint cut = guided_point(view, p, penalty, {40}, starved_hint);
    const Followed tick = follow(view, p, {0.25f, 0.25f}, kUnlimited, following);
    const float values[] = {
        found.cost_m,           found.closest.arc,      found.closest.certificate.lower_m,
        tick.closest.point_m.x, tick.closest.tangent.y, tick.closest.certificate.lower_m};
    for (const float value : values) hash.add(firmtouch::math::bits_of(value));
    starved.add(firmtouch::math::bits_of(cut.cost_m));
    starved.add(firmtouch::math::bits_of(cut.closest.certificate.lower_m));
    starved.add(cut.closest.certificate.work);
  }
  CHECK_EQ(hash.value(), 9453317766210172144u);
  CHECK_EQ(starved.value(), 1807164924033736572u);
}
