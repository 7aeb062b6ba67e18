// The proxy's theorems over baked meshes: every move of every tick is observed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "scene/proxy_rig.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

// A hand that wanders about the shape, now and then at up to `speed_m` a tick, now and then
// leaping.
class Hand {
 public:
  Hand(uint32_t seed, double reach_m, double speed_m)
      : random_(seed), reach_m_(reach_m), speed_m_(speed_m) {}
  Vec3 next() {
    if (left_-- == 0) {
      left_ = 20 + word() % 80;
      const double size_m = speed_m_ * std::pow(between(0, 1), 3.0);
      for (double& step : step_) step = size_m * between(-1, 1);
      if (random_() % 40 == 0)
        for (double& at : at_) at = reach_m_ * between(-1, 1);
    }
    for (int k = 0; k < 3; ++k) {
      at_[k] += step_[k];
      if (std::fabs(at_[k]) > reach_m_) step_[k] = -step_[k], at_[k] += 2 * step_[k];
    }
    return {static_cast<float>(at_[0]), static_cast<float>(at_[1]), static_cast<float>(at_[2])};
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 5) / 134217728.0;
  }
  uint32_t word() { return static_cast<uint32_t>(random_()); }

 private:
  std::mt19937 random_;
  double reach_m_, speed_m_, at_[3] = {0, 0, 0.06}, step_[3] = {};
  uint32_t left_ = 0;
};

constexpr uint32_t kTicks = 12000;

Broken ride(ProxyRig& rig, Hand& hand) {
  Broken broken;
  for (uint32_t tick = 0; tick < kTicks; ++tick) rig.tick(hand.next(), broken);
  return broken;
}

}  // namespace

TEST(Proxy_AnyHandSpeedRadiusAndBudget_NeverCrossesASurface) {
  const tools::Surface shapes[] = {two_walls(), groove(), slot(0.004f), plate(0.0001f),
                                   tools::make_part(1, 2000)};
  const float radii_m[] = {0.0f, 0.00002f, 0.0005f, 0.003f};
  const uint32_t budgets[] = {4, 16, 64, 1u << 20};
  uint32_t seed = 0, ticks = 0;
  for (const tools::Surface& surface : shapes) {
    for (const bool is_signed : {true, false}) {
      for (const float radius_m : radii_m) {
        ProxyRig rig(surface, is_signed);
        Hand hand(++seed, 0.06, 0.01);
        rig.settings.radius_m = radius_m;
        rig.settings.budget.work = budgets[seed % 4];
        rig.settings.friction_static = rig.settings.friction_dynamic =
            static_cast<float>(seed % 3) * 0.5f;
        rig.settings.viscous_share = static_cast<float>(seed % 4) * 0.3f;
        const Broken broken = ride(rig, hand);
        firmtouch::test::note("seed", seed);
        CHECK_EQ(broken.crossings, 0u);
        CHECK_EQ(broken.unclear, 0u);
        CHECK_EQ(broken.over_budget, 0u);
        if (rig.settings.friction_static > 0) CHECK_EQ(broken.longer, 0u);
        CHECK_LE(broken.worst_longer_m, 1e-7 * wide(rig.view.head().diagonal_m));
        ticks += broken.ticks;
      }
    }
  }
  CHECK_EQ(ticks, 40 * kTicks);
}

// The theorems need nothing of what stands in the working set or in the hint.
TEST(Proxy_AnyBitsInWorkingSetAndHint_CrossesNothing) {
  ProxyRig rig(tools::make_part(1, 2000));
  Hand hand(5, 0.05, 0.003);
  Broken broken;
  for (uint32_t tick = 0; tick < kTicks; ++tick) {
    rig.tick(hand.next(), broken);
    if (tick % 7 != 0) continue;
    const uint32_t at = hand.word() % scene::kMaxFeatures;
    scene::Feature& feature = rig.proxy.feature[at];
    const uint32_t bits = hand.word();
    std::memcpy(&feature.corner[hand.word() % 3].y, &bits, sizeof bits);
    feature.kind = static_cast<scene::Feature::Kind>(hand.word() % 4);
    std::memcpy(&rig.proxy.plane[at].normal.y, &bits, sizeof bits);
    rig.proxy.planes_at_m.x *= static_cast<float>(hand.word() % 3);
    rig.proxy.active.plane[hand.word() % 3] = static_cast<uint8_t>(hand.word());
    rig.proxy.active.count = static_cast<uint8_t>(hand.word() % 6);
    rig.proxy.feature_count = hand.word() % (scene::kMaxFeatures + 3);
    rig.hint.leaf_slot = hand.word() % 4096;
  }
  CHECK_EQ(broken.crossings, 0u);
  CHECK_EQ(broken.unclear, 0u);
}

TEST(Proxy_HandThatIsNotFinite_StaysWhereItIs) {
  ProxyRig rig(two_walls());
  Broken broken;
  rig.tick({-0.02f, 0, 0.02f}, broken);
  rig.tick({-0.02f, 0, 0.002f}, broken);
  const Vec3 before_m = rig.proxy.position_m;
  const float special[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity()};
  for (const float value : special) {
    rig.tick({value, 0, 0}, broken);
    CHECK_EQ(rig.proxy.position_m.x, before_m.x);
    CHECK_EQ(rig.proxy.position_m.z, before_m.z);
  }
  rig.tick({1e30f, 0, 0.002f}, broken);
  CHECK_EQ(broken.crossings, 0u);
}

// Penalty contact has one plane a tick: pressed into an inside corner it turned by 90 degrees from
// tick to tick, 1.93 N rms.
TEST(Proxy_InsideCorner_StandsInTheCornerInTheSameTick) {
  ProxyRig rig(two_walls());
  Broken broken;
  rig.tick({-0.0031f, 0, 0.0031f}, broken);
  rig.tick({0.003f, 0.001f, -0.003f}, broken);
  CHECK(rig.moved.is_optimal);
  CHECK_LE(std::fabs(wide(rig.proxy.position_m.x) + 0.003), 4e-7);
  CHECK_LE(std::fabs(wide(rig.proxy.position_m.z) - 0.003), 4e-7);
  CHECK_LE(std::fabs(wide(rig.proxy.position_m.y) - 0.001), 4e-7);
}

// Penalty contact let a ball of 6 mm into a slot of 4 mm.
TEST(Proxy_BallOnASlot_RestsWhereTheClosedFormSays) {
  ProxyRig rig(slot(0.004f));
  Broken broken;
  for (int tick = 0; tick < 200; ++tick)
    rig.tick({0.0004f, 0.002f, static_cast<float>(0.01 - 0.0001 * tick)}, broken);
  CHECK_LE(std::fabs(wide(rig.proxy.position_m.z) - std::sqrt(0.003 * 0.003 - 0.002 * 0.002)),
           1e-6);
  CHECK_LE(std::fabs(wide(rig.proxy.position_m.x)), 1e-6);
}

// Nearly every side of a bore is as near as the nearest one: more than the working set holds. Once
// it kept the nearest, those that hold the tool came and went, and the tool stood still.
TEST(Proxy_BoreThatTheToolJustFits_FollowsAHandInside) {
  for (const uint32_t sides : {48u, 160u}) {
    for (const double step_m : {0.0001, 0.0003, 0.001}) {
      ProxyRig rig(tube(0.0031f, 0.06f, sides));
      Broken broken;
      rig.tick({0, -0.05f, 0}, broken);
      rig.settings.friction_static = 0.3f, rig.settings.friction_dynamic = 0.2f;
      rig.settings.slide_share = 1;  // friction by the last tick alone: its stops are the hard case
      rig.settings.budget.work = sides == 48 ? 640 : 2000;
      uint32_t starved = 0, run = 0, longest = 0;
      for (int tick = 0; tick < 300; ++tick) {  // 2 mm aside, round and along
        const double turn = 0.05 * tick, y_m = -0.05 + step_m * std::abs(45 - tick % 90);
        rig.tick({static_cast<float>(0.002 * std::cos(turn)), static_cast<float>(y_m),
                  static_cast<float>(0.002 * std::sin(turn))},
                 broken);
        run = rig.moved.is_starved ? run + 1 : 0;
        longest = std::max(longest, run);
        starved += rig.moved.is_starved;
      }
      CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
      CHECK_EQ(broken.crossings, 0u);
      CHECK_LE(starved, 25u);
      CHECK_LE(longest, 4u);  // 10 are a fault
    }
  }
}

// Penalty contact let go of a plate of 2 mm at 4.01 N, and pulled.
TEST(Proxy_ThinPlateAtSpeed_HoldsAHandFarBehindIt) {
  const float radii_m[] = {0.0f, 0.00002f, 0.0005f, 0.003f};
  for (const float radius_m : radii_m) {
    for (const double step_m : {0.00005, 0.002, 0.01}) {
      ProxyRig rig(plate(0.00005f));
      rig.settings.radius_m = radius_m;
      Broken broken;
      for (double z = 0.02; z > -0.03; z -= step_m)
        rig.tick({0.0023f, 0.0011f, static_cast<float>(z)}, broken);
      rig.tick({0.0023f, 0.0011f, -0.03f}, broken);
      CHECK_LE(std::fabs(wide(rig.proxy.position_m.z) - wide(radius_m)), 1e-6);
      CHECK_EQ(broken.crossings, 0u);
    }
  }
}

TEST(Proxy_StuckByFriction_DoesNotCreep) {
  ProxyRig rig(groove());
  rig.settings.friction_static = rig.settings.friction_dynamic = 0.6f;
  Broken broken;
  Hand hand(9, 1, 1);
  rig.tick({-0.03f, 0, 0.01f}, broken);
  rig.tick({-0.03f, 0, -0.002f}, broken);
  rig.tick({-0.03f, 0, -0.002f}, broken);
  const Vec3 before_m = rig.proxy.position_m;
  for (int tick = 0; tick < 5000; ++tick)
    rig.tick({static_cast<float>(-0.03 + 0.001 * hand.between(-1, 1)),
              static_cast<float>(0.001 * hand.between(-1, 1)), -0.002f},
             broken);
  CHECK_LE(ProxyRig::distance(rig.proxy.position_m, before_m), 1e-9);
}

// An encoder of 10 um counts in every fourth tick at 2.5 mm/s: between its counts nothing rests.
TEST(Proxy_MoveWithinItsCertificate_NeedsNoQuery) {
  scene::PlaneTouched plane{{0, 0, 0.01f}, {0, 0, 1}, 0.1f};
  scene::ProxySettings settings;
  settings.radius_m = 0.002f;
  scene::Proxy proxy;
  (void)scene::move_proxy(settings, {0, 0, 0.02f}, plane, proxy);
  for (int tick = 0; tick < 4; ++tick)
    (void)scene::move_proxy(settings, {0, 0, 0.008f}, plane, proxy);
  const double step_m = 4e-7 * wide(plane.size_m());
  uint32_t queries = 0;
  for (int tick = 1; tick <= 100; ++tick) {
    const float x_m = static_cast<float>(tick * step_m);
    const scene::ProxyMoved moved = scene::move_proxy(settings, {x_m, 0, 0.008f}, plane, proxy);
    queries += moved.queries;
    CHECK(moved.is_optimal);
    CHECK_LE(std::fabs(wide(proxy.position_m.x) - wide(x_m)), step_m / 100);
    CHECK_GE(proxy.free_m, settings.radius_m);
    CHECK_LE(wide(proxy.free_m), wide(proxy.position_m.z) - 0.01);  // the true distance
  }
  CHECK_EQ(queries, 33u);  // a place that a query certified has room for two such moves
}

TEST(Proxy_SlowSlideInCounts_KeepsItsDynamicFriction) {
  ProxyRig rig(plate(0.03f));
  rig.settings.friction_static = 0.6f, rig.settings.friction_dynamic = 0.3f;
  Broken broken;
  rig.tick({-0.02f, 0, 0.01f}, broken);
  double most = 0;
  for (int tick = 0; tick < 4000; ++tick) {
    const Vec3 hand_m{static_cast<float>(-0.02 + 1e-5 * (tick / 4)), 0, 0.002f};
    rig.tick(hand_m, broken);
    const double across_m = wide(rig.proxy.position_m.z) - wide(hand_m.z);
    if (tick > 1000)
      most = std::fmax(most, (wide(hand_m.x) - wide(rig.proxy.position_m.x)) / across_m);
  }
  CHECK_LE(most, 0.31);
  for (int tick = 0; tick < 100; ++tick) rig.tick({-0.01f, 0, 0.002f}, broken);
  const Vec3 rest_m = rig.proxy.position_m;
  rig.tick({rest_m.x + 0.00055f, 0, 0.002f}, broken);  // rested: static again
  CHECK_LE(ProxyRig::distance(rig.proxy.position_m, rest_m), 1e-9);
  CHECK_EQ(broken.longer, 0u);
}

// A frozen proxy would be a tool that is glued to the part.
TEST(Proxy_VisitsThatDoNotSuffice_AreReportedInTheSameTick) {
  ProxyRig rig(tools::make_part(1, 4000));
  Broken broken;
  rig.tick({0, 0, 0.08f}, broken);
  CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
  rig.settings.budget.work = 1;
  uint32_t silent = 0;
  for (int tick = 0; tick < 400; ++tick) {
    const Vec3 hand_m{0, 0, static_cast<float>(0.08 - 0.0002 * tick)};
    rig.tick(hand_m, broken);
    const bool is_there = ProxyRig::distance(rig.proxy.position_m, hand_m) < 1e-9;
    if (!is_there && !rig.moved.is_starved && !rig.moved.is_optimal) ++silent;
  }
  CHECK_EQ(silent, 0u);
}

// A part hundreds of its sizes from the origin: a tool stood, wherever its hand went.
TEST(Proxy_FreeRadiusOfTheSizeOfRounding_IsReported) {
  const scene::SphereTouched far{{2.1f, -0.25f, 0}, 0.005f};
  scene::ProxySettings settings;
  settings.radius_m = 0.0001f;
  uint32_t stuck = 0, silent = 0;
  for (float k = 0; k < 2000; ++k) {
    scene::Proxy proxy;
    const Vec3 out{std::cos(0.0031f * k), std::sin(0.0031f * k), 0};
    const Vec3 hand_m = far.centre_m + out * (0.005f + 1e-9f * k);
    const Vec3 away_m = hand_m + out * 0.001f;
    scene::ProxyMoved moved;
    for (int tick = 0; tick < 20; ++tick)
      moved = scene::move_proxy(settings, tick == 0 ? hand_m : away_m, far, proxy);
    if (ProxyRig::distance(proxy.position_m, away_m) < 1e-6) continue;
    ++stuck;
    silent += !moved.is_starved;
  }
  CHECK_GE(stuck, 1u);
  CHECK_EQ(silent, 0u);
}

// A last query that finds a place within the clearance is not the last of the tick if that place is
// refused: the tool stood for 24 ticks with all work, for 222 with little.
TEST(Proxy_LastQueryWithinTheClearance_IsTaken) {
  for (const uint32_t work : {40u, 80u, 120u, 640u}) {
    ProxyRig rig(tools::make_part(1, 4000));
    Broken broken;
    rig.tick({0, 0, 0.08f}, broken);
    uint32_t run = 0, longest = 0;
    for (int tick = 0; tick < 6000; ++tick) {
      if (tick == 10) rig.settings.budget.work = work;
      const Vec3 before_m = rig.proxy.position_m;
      const double turn = 0.0007 * tick, rise = 0.00113 * tick;
      rig.tick({static_cast<float>(0.02 * std::cos(turn) * std::cos(rise)),
                static_cast<float>(0.02 * std::sin(turn) * std::cos(rise)),
                static_cast<float>(0.02 * std::sin(rise) + (tick < 10 ? 0.06 : 0))},
               broken);
      run = ProxyRig::distance(rig.proxy.position_m, before_m) <= 0 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
    CHECK_LE(longest, 9u);
    CHECK_EQ(broken.crossings, 0u);
  }
}

// Closed forms: where a proxy rests on each shape.
TEST(Proxy_AnalyticShapes_RestOnThem) {
  scene::ProxySettings settings;
  settings.radius_m = 0.002f;
  const auto height_on = [&settings](auto shape) {
    scene::Proxy proxy;
    for (int tick = 0; tick < 85; ++tick) {
      const Vec3 hand_m{0.001f, 0.0005f, static_cast<float>(0.08 - 0.001 * tick)};
      (void)scene::move_proxy(settings, hand_m, shape, proxy);
    }
    const Vec3 hand_m{0.001f, 0.0005f, -0.004f};
    for (int tick = 0; tick < 20; ++tick) (void)scene::move_proxy(settings, hand_m, shape, proxy);
    return proxy;
  };
  const scene::Proxy on_plane = height_on(scene::PlaneTouched{{0, 0, 0.01f}, {0, 0, 1}, 0.1f});
  CHECK_LE(std::fabs(wide(on_plane.position_m.z) - 0.012), 1e-6);
  const scene::Proxy on_sphere = height_on(scene::SphereTouched{{0, 0, 0}, 0.03f});
  CHECK_LE(std::fabs(ProxyRig::distance(on_sphere.position_m, {}) - 0.032), 1e-6);
  const scene::Proxy on_box = height_on(scene::BoxTouched{{}, {0.02f, 0.02f, 0.01f}});
  CHECK_LE(std::fabs(wide(on_box.position_m.z) - 0.012), 1e-6);
  const scene::Proxy on_end =
      height_on(scene::CylinderTouched{{{0, 0, -0.01f}, {0, 0, 0.01f}}, 0.02f});
  CHECK_LE(std::fabs(wide(on_end.position_m.z) - 0.012), 1e-6);
  const scene::Proxy on_capsule =
      height_on(scene::CapsuleTouched{{{-0.02f, 0, 0}, {0.02f, 0, 0}}, 0.01f});
  CHECK_LE(
      std::fabs(std::hypot(wide(on_capsule.position_m.y), wide(on_capsule.position_m.z)) - 0.012),
      1e-6);
}
