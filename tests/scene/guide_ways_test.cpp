// What a guide does besides pulling: tunnel, one side, ends, drive, progress, and which part it
// keeps to.
#include <float.h>
#include <stdint.h>

#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "scene/guide_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using curve_test::SmallCurve;
using scene_test::is_near;
using scene_test::Rig;

namespace {

constexpr float kTick_s = 0.001f;

// A square of 0.1 m a side.
constexpr curve::Sample kRing[] = {
    {0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0}, {0, 0, 0}};
// The same, recorded without coming quite home.
constexpr curve::Sample kOpenRing[] = {
    {0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0}, {0, 0.001f, 0}};
// Two parallel strands, 4 mm apart, joined 0.2 m away.
constexpr curve::Sample kHairpin[] = {{0, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.004f, 0}, {0, 0.004f, 0}};

SmallCurve g_ring{kRing}, g_open_ring{kOpenRing}, g_hairpin{kHairpin};

// Once around the square from (0.05, 0), `away_m` outside it.
math::Vec3 around(uint32_t step, uint32_t steps, float away_m) {
  const float s = static_cast<float>(step % steps) / static_cast<float>(steps) * 4.0f + 0.5f;
  const uint32_t side = static_cast<uint32_t>(s) % 4;
  const float t = (s - static_cast<float>(static_cast<uint32_t>(s))) * 0.1f;
  if (side == 0) return {t, -away_m, 0.5f};
  if (side == 1) return {0.1f + away_m, t, 0.5f};
  if (side == 2) return {0.1f - t, 0.1f + away_m, 0.5f};
  return {-away_m, 0.1f - t, 0.5f};
}

bool is_about(float is, float wanted) { return is > wanted - 0.01f && is < wanted + 0.01f; }

scene::Drive drive(scene::Drive::Kind kind, float force_N, float speed_mps) {
  return {kind, force_N, speed_mps, kTick_s};
}

}  // namespace

TEST(Tunnel_NoForceInsideAndNoJumpAtItsWall) {
  Rig rig;
  rig.guide.tunnel_m = 0.002f;
  rig.guide.material.damping_N_s_per_m = 5.0f;
  CHECK(is_near(rig.force_N({0.05f, 0.0019f, 0.5f}), {0, 0, 0}));
  CHECK(is_near(servo::evaluate(rig.model, {0.05f, 0.0019f, 0.5f}, {0.1f, 0.3f, 0.2f}), {0, 0, 0}));
  CHECK(is_near(rig.force_N({0.05f, 0.005f, 0.5f}), {0, -0.3f, 0}));
  CHECK(rig.touch.is_held);
  const math::Vec3 at_wall =
      servo::evaluate(rig.model, {0.05f, 0.002001f, 0.5f}, {0.1f, 0.3f, 0.2f});
  CHECK(is_near(at_wall, {0, 0, 0}, 2e-3f));  // damping too grows in
}

TEST(AOneSidedGuideIsTheEdgeOfARuler) {
  Rig rig;
  rig.guide.free_side = {0, 2, 0};  // any length
  CHECK(is_near(rig.force_N({0.05f, -0.004f, 0.5f}), {0, 0.4f, 0}));
  CHECK(is_near(rig.force_N({0.05f, -0.004f, 0.503f}), {0, 0.4f, 0}));  // free up and down
  CHECK(is_near(rig.force_N({0.05f, 0.004f, 0.503f}), {0, 0, 0}));
  CHECK(rig.touch.is_held);
  CHECK(is_near(rig.force_N({0.2f, 0.05f, 0.504f}), {0, 0, 0}));  // there it runs to its free side
  rig.guide.tunnel_m = 0.001f;
  CHECK(is_near(rig.force_N({0.05f, -0.004f, 0.5f}), {0, 0.3f, 0}));
}

// 5 mm behind the edge all around the outside of the corner. The edge of one side was used until
// the other side was nearer: 0.5 N fell to none, and came back at once along the other axis.
TEST(OneSidedGuide_AroundACorner_ForceHasNoJump) {
  Rig rig;
  rig.guide.free_side = {-1, 1, 0};
  constexpr uint32_t kSteps = 200;
  math::Vec3 before;
  for (uint32_t i = 0; i < 3 * kSteps; ++i) {
    const float t = (static_cast<float>(i % kSteps) + 0.5f) / static_cast<float>(kSteps);
    const math::SineCosine turn = math::sine_cosine(1.57079633f * t);
    math::Vec3 at_m{0.19f + 0.01f * t, -0.005f, 0.5f};
    if (i >= kSteps) at_m = {0.2f + 0.005f * turn.sine, -0.005f * turn.cosine, 0.5f};
    if (i >= 2 * kSteps) at_m = {0.205f, 0.01f * t, 0.5f};
    const math::Vec3 force_N = rig.force_N(at_m);
    CHECK(is_near(force_N, force_N * (0.5f / math::length(force_N)), 1e-3f));
    if (i > 0) CHECK(is_near(force_N, before, 0.01f));
    before = force_N;
  }
}

TEST(AGuideThatLetsGoAtItsEndsTakesHoldOnlyAfterTheToolWasClearOrCameBack) {
  Rig rig;
  rig.guide.ends = scene::Ends::kRelease;
  CHECK(is_near(rig.force_N({0.005f, 0.003f, 0.5f}), {0, -0.3f, 0}));
  CHECK(is_near(rig.force_N({-0.001f, 0.003f, 0.5f}), {0, 0, 0}));
  CHECK(!rig.touch.is_held);
  CHECK(is_near(rig.force_N({0.001f, 0.003f, 0.5f}), {0, 0, 0}));  // no chatter about the end
  CHECK(is_near(rig.force_N({0.011f, 0.003f, 0.5f}), {0, -0.3f, 0}));
  CHECK(is_near(rig.force_N({-0.001f, 0.003f, 0.5f}), {0, 0, 0}));
  (void)rig.force_N({-0.02f, 0, 0.5f});                             // clear
  CHECK(is_near(rig.force_N({-0.002f, 0.003f, 0.5f}), {0, 0, 0}));  // still past the end
  CHECK(is_near(rig.force_N({0.001f, 0.003f, 0.5f}), {0, -0.3f, 0}));
}

TEST(AnOpenRingThatGoesOnIsFollowedRoundAfterRound) {
  const scene::Ends both[] = {scene::Ends::kContinue, scene::Ends::kHold};
  for (const scene::Ends ends : both) {
    Rig rig;
    rig.view = g_open_ring.view();
    rig.guide.ends = ends;
    rig.guide.arc_penalty = 2.0f;
    float worst_m = 0;
    for (uint32_t i = 0; i < 3 * 400; ++i) {
      (void)rig.force_N(around(i, 400, 0.002f));
      if (rig.touch.closest.distance_m > worst_m) worst_m = rig.touch.closest.distance_m;
    }
    CHECK(rig.touch.is_held);
    if (ends == scene::Ends::kContinue) {
      CHECK_LE(worst_m, 0.004f);
      CHECK(is_about(rig.touch.progress_m, 3 * 0.4f));
    } else {
      CHECK_GE(worst_m, 0.02f);  // held at the end, till it let go
    }
  }
}

TEST(ProgressCountsRoundsOfAClosedGuideBothWays) {
  Rig rig;
  rig.view = g_ring.view();
  rig.guide.arc_penalty = 2.0f;
  for (uint32_t i = 0; i <= 2 * 400; ++i) (void)rig.force_N(around(i, 400, 0.001f));
  CHECK(is_about(rig.touch.progress_m, 0.8f));
  for (uint32_t i = 5 * 400; i-- > 400;) (void)rig.force_N(around(i, 400, 0.001f));
  CHECK(is_about(rig.touch.progress_m, -0.8f));
  (void)rig.force_N({0.05f, -0.05f, 0.5f});
  (void)rig.force_N({0.05f, -0.001f, 0.5f});
  CHECK_EQ(rig.touch.progress_m, 0.0f);  // from where it took hold
}

TEST(APushGoesAlongAndEndsAtTheEnd) {
  Rig rig;
  rig.guide.drive = drive(scene::Drive::Kind::kPush, 0.5f, 0);
  CHECK(is_near(rig.force_N({0.05f, 0.004f, 0.5f}), {0.5f, -0.4f, 0}));
  CHECK(is_near(rig.force_N({0.2f, 0.05f, 0.5f}), {0, 0.5f, 0}));
  CHECK(is_near(rig.force_N({0.201f, 0.103f, 0.5f}), {-0.1f, -0.3f, 0}));  // past the end
  rig.guide.drive.force_N = -0.5f;
  CHECK(is_near(rig.force_N({0.05f, 0.004f, 0.5f}), {-0.5f, -0.4f, 0}));
  rig.guide.drive.force_N = 1e9f;  // beyond all sense: none
  CHECK(is_near(rig.force_N({0.05f, 0.004f, 0.5f}), {0, -0.4f, 0}));
}

TEST(ALeadPullsAtItsSpeedWithAtMostItsForceAndWaits) {
  Rig rig;
  rig.guide.drive = drive(scene::Drive::Kind::kLead, 0.5f, 0.1f);
  math::Vec3 force_N;
  for (uint32_t i = 0; i < 20; ++i) force_N = rig.force_N({0.05f, 0, 0.5f});  // tool stays
  CHECK(is_near(force_N, {0.2f, 0, 0}, 1e-4f));  // 20 ticks of 0.1 mm at 100 N/m
  // A servo of its own rate: 1 mm ahead of where the model was made.
  CHECK(is_near(servo::evaluate(rig.model, {0.051f, 0, 0.5f}, {}), {0.1f, 0, 0}, 1e-4f));
  for (uint32_t i = 0; i < 500; ++i) force_N = rig.force_N({0.05f, 0, 0.5f});
  CHECK(is_near(force_N, {0.5f, 0, 0}, 1e-4f));
  for (uint32_t i = 0; i <= 30; ++i)  // the tool comes after, a little faster
    force_N = rig.force_N({0.05f + 0.0002f * static_cast<float>(i), 0, 0.5f});
  CHECK(is_near(force_N, {0.2f, 0, 0}, 1e-3f));  // the carriage had not run away meanwhile
}

TEST(Lead_WithoutSpeed_HoldsItsPosition_SlipsBeyondItsForce) {
  Rig rig;
  rig.guide.drive = drive(scene::Drive::Kind::kLead, -0.5f, 0);
  (void)rig.force_N({0.05f, 0, 0.5f});
  CHECK(is_near(rig.force_N({0.053f, 0, 0.5f}), {-0.3f, 0, 0}));
  CHECK(is_near(rig.force_N({0.048f, 0, 0.5f}), {0.2f, 0, 0}));
  CHECK(is_near(rig.force_N({0.058f, 0, 0.5f}), {-0.5f, 0, 0}));
  CHECK(is_near(rig.force_N({0.057f, 0, 0.5f}), {-0.4f, 0, 0}));
}

TEST(Guide_Penalty_KeepsItsStrand_AndReturnsBeyondRelease) {
  const float penalties[] = {0.0f, 0.25f, 250.0f};
  for (const float penalty : penalties) {
    Rig rig;
    rig.view = g_hairpin.view();
    rig.guide.arc_penalty = penalty;
    CHECK(is_near(rig.force_N({0.05f, 0.001f, 0.5f}), {0, -0.1f, 0}));
    const math::Vec3 aside_N = rig.force_N({0.05f, 0.003f, 0.5f});
    CHECK(is_near(aside_N, {0, penalty > 0.0f ? -0.3f : 0.1f, 0}));
    CHECK(is_near(
        rig.force_N({0.05f, 0.033f, 0.5f}),
        {0, penalty > 0.0f ? 0.0f : -2.9f, 0}));  // the nearer strand is not within its snap
    CHECK_EQ(rig.touch.is_held, !(penalty > 0.0f));
    CHECK(is_near(rig.force_N({0.05f, 0.005f, 0.5f}), {0, -0.1f, 0}));
  }
}

TEST(HostileSettingsOfAGuideLeaveASoundModel) {
  const float bad[] = {__builtin_nanf(""),
                       __builtin_inff(),
                       -__builtin_inff(),
                       FLT_MAX,
                       -FLT_MAX,
                       1e-45f,
                       -1.0f,
                       0.0f};
  const float places[] = {0.05f, 0.051f, -0.001f, 0.2f, __builtin_nanf(""), 0.05f};
  for (uint32_t field = 0; field < 9; ++field) {
    for (const float value : bad) {
      for (uint32_t kind = 0; kind < 9; ++kind) {
        Rig rig;
        rig.guide.drive = drive(static_cast<scene::Drive::Kind>(kind % 3), 1.0f, 0.1f);
        rig.guide.ends = static_cast<scene::Ends>(kind / 3);
        float* const fields[] = {
            &rig.guide.tunnel_m,      &rig.guide.arc_penalty,     &rig.guide.free_side.x,
            &rig.guide.drive.force_N, &rig.guide.drive.speed_mps, &rig.guide.drive.tick_period_s,
            &rig.guide.snap_m,        &rig.guide.release_m,       &rig.guide.free_side.z};
        *fields[field] = value;
        for (const float x : places) {
          (void)rig.force_N({x, 0.001f, 0.5f});
          const bool is_place = x - x <= 0.0f;
          CHECK(!is_place || servo::is_sound(rig.model));
          CHECK(is_place || !rig.touch.is_held);
          CHECK(rig.touch.ahead_m - rig.touch.ahead_m <= 0.0f);
          CHECK(rig.touch.progress_m - rig.touch.progress_m <= 0.0f);
        }
      }
    }
  }
}
