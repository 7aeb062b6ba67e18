// A tool of several spheres: the theorems of the proxy hold for each of them, and the one spring of
// the model has the force, the energy and the torque of all.
#include <cmath>
#include <limits>

#include "scene/tool_rig.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

std::vector<scene::SphereLayout> random_tool(Draw& draw, uint32_t count, double reach_m) {
  std::vector<scene::SphereLayout> spheres;
  for (uint32_t i = 0; i < count; ++i) {
    const Vec3 at_m = draw.within(reach_m);
    spheres.push_back(
        {{at_m.x, at_m.y, at_m.z}, draw.below(8) == 0 ? 0 : draw.between(0.0002, 0.004)});
  }
  return spheres;
}

// A hand that wanders about, in and out of the shape, turns, and now and then leaps.
void wander(ToolRig& rig, Draw& draw, uint32_t ticks) {
  Vec3 at_m{0, 0, 0.08f}, step_m;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    if (tick % 50 == 0) step_m = draw.within(draw.below(4) == 0 ? 0.005 : 0.0005);
    if (draw.below(400) == 0) at_m = draw.within(0.06);
    if (draw.below(100) == 0) rig.turn.want(draw.below(3), draw.between(-3, 3));
    at_m = at_m + step_m;
    if (math::length(at_m) > 0.08f) step_m = at_m * -0.01f;
    rig.observe(at_m);
  }
}

}  // namespace

TEST(Tool_AnyHandTurnSpheresAndBudget_NoSphereCrossesASurface) {
  const tools::Surface shapes[] = {two_walls(), slot(0.004f), plate(0.0001f),
                                   tools::make_part(1, 2000)};
  const uint32_t budgets[] = {4, 300, 2000, 1u << 20};
  uint32_t seed = 0, free = 0, loaded = 0;
  for (const tools::Surface& surface : shapes) {
    for (const uint32_t count : {1u, 2u, 5u, 8u}) {
      Draw draw(++seed);
      ToolRig rig(surface, random_tool(draw, count, 0.03), seed % 3 != 0);
      rig.contact.settings.budget.work = budgets[seed * 7 / 3 % 4];
      const bool is_rough = seed % 2 == 0;
      rig.contact.settings.friction_static = rig.contact.settings.friction_dynamic =
          is_rough ? 0.5f : 0.0f;
      wander(rig, draw, 3000);
      firmtouch::test::note("seed", seed);
      CHECK_EQ(rig.broken.crossings, 0u);
      CHECK_EQ(rig.broken.unclear, 0u);
      CHECK_EQ(rig.broken.over_budget, 0u);
      CHECK_EQ(rig.broken.unsound, 0u);
      CHECK_EQ(rig.broken.untrue, 0u);
      // A proxy without friction may be away by rounding; the comparison itself rounds, too.
      CHECK_LE(rig.broken.longer_m, (is_rough ? 1e-12 : 1e-7 * wide(rig.size_m())));
      CHECK_LE(rig.broken.force_off, 2e-5);
      CHECK_LE(rig.broken.energy_off, 1e-4);
      CHECK_LE(rig.broken.torque_off_Nm, 1e-5);
      CHECK_LE(rig.broken.stiffest, 1 + 1e-5);
      free += rig.broken.free, loaded += rig.broken.loaded;
    }
  }
  CHECK_GE(free, 100000u);
  CHECK_GE(loaded, 20000u);
}

// Of a bar whose ends are d1 and d2 below the plane: K/2 (d1 + d2), and about its middle
// K/2 (d1 - d2) times half its length.
TEST(Tool_BarOnAPlane_HasForceAndTorqueOfTheClosedForm) {
  constexpr float kHalf_m = 0.02f, kRadius_m = 0.003f;
  for (const float tilt_rad : {0.0f, 0.03f, -0.06f, 0.3f}) {
    ToolRig rig(plate(0.01f), bar(kHalf_m, kRadius_m));
    CHECK(rig.turn.want(1, tilt_rad));
    for (uint32_t i = 0; i < 100; ++i) rig.touch_at({0.001f, 0.002f, 0.02f});
    const float z_m = 0.0015f;
    for (uint32_t i = 0; i <= 200; ++i)
      rig.touch_at({0.001f, 0.002f, 0.02f + (z_m - 0.02f) * static_cast<float>(i) / 200.0f});
    // A turn about y by a takes (-h, 0, 0) to z = h sin(a).
    const double rise_m = wide(kHalf_m) * std::sin(wide(tilt_rad)),
                 reach = std::cos(wide(tilt_rad));
    const double left_m = std::fmax(0, wide(kRadius_m) - wide(z_m) - rise_m);
    const double right_m = std::fmax(0, wide(kRadius_m) - wide(z_m) + rise_m);
    const double force_N = 500 * (left_m + right_m);
    const double torque_Nm = 500 * wide(kHalf_m) * reach * (left_m - right_m);
    CHECK_LE(std::fabs(wide(rig.force_N().z) - force_N), 0.005 * force_N);
    CHECK_LE(std::hypot(wide(rig.force_N().x), wide(rig.force_N().y)), 0.005 * force_N);
    CHECK_LE(std::fabs(wide(rig.touch.torque_Nm.y) - torque_Nm),
             0.005 * 500 * wide(kHalf_m) * (left_m + right_m));
    CHECK_LE(std::hypot(wide(rig.touch.torque_Nm.x), wide(rig.touch.torque_Nm.z)), 1e-4);
  }
}

// One end on the floor, the other one on the wall: each has half of the stiffness.
TEST(Tool_BarInACorner_HasTheForcesOfBothWalls) {
  ToolRig rig(two_walls(), {{{-0.02f, 0, -0.01f}, 0.003f}, {{0.01f, 0, 0.01f}, 0.002f}});
  const Vec3 free_m{-0.02f, 0, 0.02f};
  const Vec3 hand_m{-0.01f, 0, 0.011f};  // floor: 2 mm, wall: 2 mm
  for (uint32_t i = 0; i <= 300; ++i)
    rig.touch_at(free_m + (hand_m - free_m) * (static_cast<float>(i) / 300.0f));
  CHECK_LE(std::fabs(wide(rig.force_N().z) - 500 * 0.002), 0.005);
  CHECK_LE(std::fabs(wide(rig.force_N().x) + 500 * 0.002), 0.005);
  // -0.02 x (0, 0, 1) and 0.01 up x (-1, 0, 0): both turn about y.
  CHECK_LE(std::fabs(wide(rig.touch.torque_Nm.y) - (0.02 * 1 - 0.01 * 1)), 0.005 * 0.03);
}

TEST(Tool_SpheresAtOnePlace_AreOneSphereOfTheWholeStiffness) {
  const scene::SphereLayout one{{0, 0, 0}, 0.003f};
  ToolRig alone(two_walls(), {one});
  ToolRig all(two_walls(), std::vector<scene::SphereLayout>(scene::kMaxSpheres, one));
  for (uint32_t i = 0; i <= 400; ++i) {
    const float share = static_cast<float>(i) / 400.0f;
    const Vec3 hand_m{-0.02f + 0.021f * share, 0, 0.02f - 0.021f * share};
    alone.touch_at(hand_m), all.touch_at(hand_m);
    CHECK_LE(ProxyRig::distance(alone.force_N(), all.force_N()), 1e-4);
  }
  CHECK_GE(math::length(alone.force_N()), 4.0f);
  CHECK_LE(math::length(all.touch.torque_Nm), 1e-9f);
}

// Where the second sphere of a bar begins to touch, neither force nor length of the spring steps.
TEST(Tool_SecondSphereBeginsToTouch_SpringDoesNotStep) {
  ToolRig rig(plate(0.01f), bar(0.02f, 0.003f));
  CHECK(rig.turn.want(1, 0.1f));
  for (uint32_t i = 0; i < 100; ++i) rig.touch_at({0, 0, 0.02f});
  double force_N = 0, length_m = 0, step_N = 0, step_m = 0;
  constexpr float kStep_m = 1e-5f;
  uint32_t of_both = 0;
  for (float z_m = 0.008f; z_m > -0.003f; z_m -= kStep_m) {
    rig.touch_at({0, 0, z_m});
    step_N = std::fmax(step_N, std::fabs(wide(math::length(rig.force_N())) - force_N));
    step_m = std::fmax(step_m, std::fabs(wide(rig.touch.penetration_m) - length_m));
    force_N = wide(math::length(rig.force_N())), length_m = wide(rig.touch.penetration_m);
    of_both += rig.of(0).is_loaded && rig.of(1).is_loaded ? 1u : 0u;
  }
  CHECK_GE(of_both, 100u);
  CHECK_LE(step_N, 1000 * wide(kStep_m) * 1.1);
  CHECK_LE(step_m, wide(kStep_m) * 2.1);
}

TEST(Tool_FarSpheres_CostNoQuery) {
  ToolRig rig(plate(0.01f),
              {{{0, 0, 0}, 0.002f}, {{0, 0, 0.03f}, 0.002f}, {{0, 0.01f, 0.04f}, 0.002f}});
  for (uint32_t i = 0; i < 300; ++i) rig.touch_at({0, 0, 0.02f - 0.0001f * static_cast<float>(i)});
  uint32_t queries = 0;
  for (uint32_t i = 0; i < 300; ++i) {
    rig.touch_at({0.00005f * static_cast<float>(i), 0, 0.001f});
    queries += rig.queries;
  }
  CHECK(rig.of(0).is_loaded);
  CHECK(!rig.of(1).is_loaded);
  // The first one's: a slide on one plane takes one.
  CHECK_LE(queries, 330u);
}

// At two rates servo lets the hand go as far as that.
TEST(Tool_InTheFree_ReachesAsFarAsTheSphereWithTheLeastRoom) {
  ToolRig rig(plate(0.01f), {{{0, 0, 0.03f}, 0.002f}, {{0, 0, 0}, 0.002f}});
  rig.touch_at({0, 0, 0.01f});
  CHECK(rig.model.spring.is_used && !rig.model.spring.is_held);
  CHECK_LE(std::fabs(wide(rig.model.spring.reach_m) - 0.008), 1e-6);
}

TEST(Tool_OneOfTwoSpheresTouches_HasHalfOfStiffnessAndDamping) {
  ToolRig rig(plate(0.01f), {{{0, 0, 0.03f}, 0.002f}, {{0, 0, 0}, 0.002f}});
  rig.contact.material.damping_N_s_per_m = 4;
  for (uint32_t i = 0; i <= 90; ++i) rig.touch_at({0, 0, 0.01f - 0.0001f * static_cast<float>(i)});
  CHECK_LE(std::fabs(wide(rig.model.spring.stiffness_N_per_m) - 500), 0.01);
  CHECK_LE(std::fabs(wide(rig.model.spring.damping_N_s_per_m) - 2), 1e-4);
}

// The work of a tick moves some of eight pressed spheres: they take turns, and the model says so.
TEST(Tool_WorkForSomeSpheres_TheyTakeTurnsAndTheModelIsUncertain) {
  std::vector<scene::SphereLayout> spheres;
  for (int i = 0; i < 8; ++i)
    spheres.push_back({{-0.028f + 0.008f * static_cast<float>(i), 0, 0}, 0.003f});
  ToolRig rig(plate(0.01f), spheres);
  for (uint32_t i = 0; i < 200; ++i)
    rig.touch_at({0, 0, 0.02f - 0.0000875f * static_cast<float>(i)});
  CHECK(!rig.model.is_uncertain);
  rig.contact.settings.budget.work = 3 * scene::kSphereWork;
  Vec3 before_m[8];
  for (uint32_t i = 0; i < 8; ++i) before_m[i] = rig.of(i).position_m;
  for (uint32_t tick = 0; tick < 4; ++tick) {
    rig.touch_at({0.001f * static_cast<float>(tick), 0, 0.0025f});
    CHECK(rig.model.is_uncertain);
    CHECK_LE(rig.touch.work, rig.contact.settings.budget.work);
  }
  for (uint32_t i = 0; i < 8; ++i)
    CHECK(ProxyRig::distance(before_m[i], rig.of(i).position_m) > 5e-4);
  rig.contact.settings.budget.work = 8 * scene::kSphereWork + 400;
  rig.touch_at({0.003f, 0, 0.0025f});
  CHECK(!rig.model.is_uncertain);
}

TEST(Tool_HostileHandsAndSpheres_LeaveASoundModel) {
  const float special[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(), -1e30f, 3.4e38f, 1e-45f};
  // Farther apart than the part, without radius, and all at one place.
  const std::vector<scene::SphereLayout> tools_of[] = {
      {{{-1, 0, 0}, 0.003f}, {{1, 0, 0}, 0.003f}},
      {{{0, 0, 0}, 0}, {{0.01f, 0, 0}, 0}},
      {{{0, 0, 0}, 0.1f}, {{0, 0, 0}, 0.1f}, {{0, 0, 0}, 0.1f}}};
  for (const auto& spheres : tools_of) {
    ToolRig rig(two_walls(), spheres);
    Draw draw(3);
    for (uint32_t tick = 0; tick < 2000; ++tick) {
      Vec3 at_m = draw.within(0.05);
      if (draw.below(5) == 0) at_m.y = special[draw.below(5)];
      rig.observe(at_m);
      if (draw.below(30) == 0) rig.touch.sphere[draw.below(3)].proxy.feature_count = draw.below(99);
    }
    CHECK_EQ(rig.broken.crossings, 0u);
    CHECK_EQ(rig.broken.unsound, 0u);
  }
}

TEST(ToolTurn_FollowsAtALimitedRate_AndRefusesWhatIsNoAngle) {
  scene::ToolTurn turn;
  for (const float bad : {6.3f, -6.3f, std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()})
    CHECK(!turn.want(0, bad));
  for (const uint32_t axis : {3u, 4u, 0x100u, UINT32_MAX}) CHECK(!turn.want(axis, 0.1f));
  CHECK(turn.want(0, 2) && turn.want(1, -1) && turn.want(2, 3));
  Vec3 at_m{0, 0, 0.1f};
  double fastest_mps = 0;
  for (uint32_t i = 0; i < 1000; ++i) {
    turn.advance(0.001f);
    const Vec3 now_m = turn.rotation * Vec3{0, 0, 0.1f};
    fastest_mps = std::fmax(fastest_mps, ProxyRig::distance(now_m, at_m) / 0.001);
    at_m = now_m;
  }
  CHECK_LE(fastest_mps, 0.1 * wide(scene::kMaxToolTurn_rad_per_s) * 1.0001);
  CHECK_GE(fastest_mps, 0.3);
  CHECK_EQ(turn.turn_rad.z, 3.0f);
}

// Without motors a hand takes the spheres through the part, and where the work does not suffice
// some have no proxy yet.
TEST(Tool_MotorsOffAndLittleWork_BoundsOfTheNearestSphereAreTrue) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    Draw draw(seed);
    ToolRig rig(seed % 2 == 0 ? tools::make_part(1, 500) : two_walls(), random_tool(draw, 8, 0.02));
    rig.contact.settings.budget.work = 100 + 300 * (seed % 4);
    for (uint32_t tick = 0; tick < 1000; ++tick) {
      rig.contact.is_on = tick / 50 % 2 == 0;
      rig.observe(draw.within(tick % 30 == 0 ? 0.08 : 0.03));
    }
    firmtouch::test::note("seed", seed);
    CHECK_EQ(rig.broken.untrue, 0u);
    CHECK_EQ(rig.broken.unsound, 0u);
  }
}
