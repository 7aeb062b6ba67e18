// How contact begins: the side of the hand, and hands that are too near to a surface.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "scene/proxy_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

}  // namespace

// On its axis a turned part is equally near all around: the side was never found, and contact was
// a fault. The bounds were those of the place where the search began.
TEST(Proxy_BeginsOnTheAxisOfATurnedPart_FindsItsSideWhileTheHandMoves) {
  for (const uint32_t work : {12u, 640u}) {
    ProxyRig rig(drum(0.03f, 0.02f, 400));
    rig.settings.budget.work = work;
    Broken broken;
    uint32_t unknown = 0, wrong = 0;
    for (int tick = 0; tick < 100; ++tick) {
      const Vec3 hand_m = kDrumAxis * static_cast<float>(0.08 - 0.0005 * tick);
      rig.tick(hand_m, broken);
      const bool is_free = rig.proxy.phase == scene::Proxy::Phase::kFree;
      unknown += is_free ? 0 : 1;
      const double truth_m = rig.truth_m(is_free ? rig.proxy.position_m : hand_m);
      const scene::Bounds bounds = scene::bounds_of(rig.proxy, hand_m);
      if (wide(bounds.lower_m) > truth_m + 1e-7 || wide(bounds.upper_m) < truth_m - 1e-7) ++wrong;
    }
    CHECK_EQ(wrong, 0u);
    CHECK_EQ(broken.crossings, 0u);
    if (work == 640) CHECK_LE(unknown, 4u);
  }
}

TEST(Proxy_BeginsTooNearForItsRadius_GrowsWhereThereIsRoom) {
  ProxyRig rig(two_walls());
  Broken broken;
  rig.tick({-0.03f, 0, 0.001f}, broken);
  CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
  CHECK_LE(rig.proxy.radius_m, 0.001f);
  rig.settings.growth_m = 5e-6f;
  for (int tick = 0; tick < 500; ++tick) rig.tick({-0.03f, 0, 0.001f}, broken);
  CHECK_GE(rig.proxy.radius_m, 0.0029f);
  CHECK_GE(rig.proxy.position_m.z, 0.0029f);
  rig.tick({-0.03f, 0, 0.01f}, broken);
  CHECK_EQ(rig.proxy.radius_m, 0.003f);
}

TEST(Proxy_BeginsOnTheSurface_GrowsBesideIt) {
  for (const float high_m : {0.0f, 2e-7f, -2e-7f, -4e-7f}) {
    ProxyRig rig(two_walls());
    Broken broken;
    const Vec3 hand_m{-0.03f, 0.01f, high_m};
    rig.tick(hand_m, broken);
    CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
    CHECK(!rig.moved.is_starved);
    CHECK_LE(wide(rig.proxy.position_m.z), 2e-6);
    rig.settings.growth_m = 5e-6f;
    for (int tick = 0; tick < 700; ++tick) rig.tick(hand_m, broken);
    CHECK_GE(rig.proxy.radius_m, 0.0029f);
    CHECK_GE(rig.proxy.position_m.z, 0.0029f);
    CHECK_EQ(broken.crossings, 0u);
  }
}

// What it has for a tick does not suffice to look where it stands, too.
TEST(Proxy_BeginsTooNearWithLittleWork_GoesOnGrowing) {
  ProxyRig rig(groove());
  Broken broken;
  rig.settings.budget.work = 16;
  rig.settings.friction_static = rig.settings.friction_dynamic = 0.4f;
  uint32_t starved = 0;
  for (int tick = 0; tick < 50; ++tick) {
    rig.tick({0.0012789655f, 0.000273805083f, -0.00868459325f}, broken);
    rig.settings.growth_m = 5e-6f;
    starved += rig.moved.is_starved ? 1 : 0;
  }
  CHECK_LE(starved, 1u);
}

// No hand about the surface is left without a side, on whichever shape.
template <class Shape>
void begin_about(Shape shape, Vec3 out) {
  for (int i = -16; i <= 16; ++i) {
    const float off_m = 5e-7f * static_cast<float>(i) * shape.size_m();
    const Vec3 hand_m = out * (0.02f + off_m);
    scene::Proxy proxy;
    scene::ProxySettings settings;
    settings.radius_m = 0.003f;
    const scene::ProxyMoved moved = scene::move_proxy(settings, hand_m, shape, proxy);
    firmtouch::test::note("place", static_cast<uint32_t>(i + 100));
    CHECK(!moved.is_starved);
    CHECK(proxy.phase == (i < -8 ? scene::Proxy::Phase::kInside : scene::Proxy::Phase::kFree) ||
          i == -8 || i == -9);
  }
}

TEST(Proxy_BeginsAboutTheSurface_HasASide) {
  begin_about(scene::SphereTouched{{}, 0.02f}, {0.36f, 0.48f, 0.8f});
  begin_about(scene::PlaneTouched{{0, 0, 0.02f}, {0, 0, 1}, 0.1f}, {0, 0, 1});
  begin_about(scene::BoxTouched{{}, {0.02f, 0.03f, 0.04f}}, {1, 0, 0});
}

// A hand a little behind a sheet is not held by it on its way back.
TEST(Proxy_BeginsBehindASheet_StaysBehindIt) {
  tools::Surface sheet;
  sheet.vertices = {{-0.05f, -0.05f, 0}, {0.05f, -0.05f, 0}, {0.05f, 0.05f, 0}, {-0.05f, 0.05f, 0}};
  sheet.faces = {{0, 1, 2}, {0, 2, 3}};
  sheet.source = {0, 1};
  for (const float side : {1.0f, -1.0f}) {
    ProxyRig rig(sheet, false);
    Broken broken;
    rig.tick({0.01f, 0.02f, 2e-7f * side}, broken);
    CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
    for (int tick = 1; tick <= 100; ++tick)
      rig.tick({0.01f, 0.02f, 1e-4f * static_cast<float>(tick) * side}, broken);
    CHECK_LE(wide(rig.proxy.position_m.z * -side), -0.0099);
    CHECK_EQ(broken.crossings, 0u);
  }
}

TEST(Proxy_BeginsInside_IsNotFree) {
  ProxyRig rig(two_walls());
  Broken broken;
  rig.tick({0.01f, 0, 0.01f}, broken);
  CHECK(rig.proxy.phase == scene::Proxy::Phase::kInside);
  rig.tick({-0.01f, 0, 0.01f}, broken);
  CHECK(rig.proxy.phase == scene::Proxy::Phase::kFree);
}
