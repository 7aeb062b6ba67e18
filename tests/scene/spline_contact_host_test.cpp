// Contact with spline surfaces: which side, how deep, which way, and what is never pushed on.
#include <cmath>
#include <vector>

#include "harness/test.hpp"
#include "scene/spline_rig.hpp"

using namespace firmtouch;     // NOLINT: a test file
using namespace spline_touch;  // NOLINT

TEST(ASolidOfSplinesPushesOutAlongItsNormalAsDeepAsTheSphereIsIn) {
  for (const bool is_turned : {false, true}) {
    const Surface surface = torus(is_turned);
    Rig rig(surface, true);
    rig.object.is_turned = is_turned;
    for (int i = 0; i < 400; ++i) {
      const double angle = 0.37 * i, tilt = 0.11 * i;
      const double off = 0.002 * std::sin(0.3 * i);  // from 2 mm within to 2 mm outside
      const math::Vec3 p = on_torus(angle, tilt, off);
      const math::Vec3 force = rig.force_N(p);
      const double wanted_N = 1000 * (static_cast<double>(kRadius_m) - off);
      const math::Vec3 wanted{static_cast<float>(wanted_N * std::cos(tilt) * std::cos(angle)),
                              static_cast<float>(wanted_N * std::cos(tilt) * std::sin(angle)),
                              static_cast<float>(wanted_N * std::sin(tilt))};
      if (std::fabs(off) < 1e-6) continue;  // on the surface: by continuity or not at all
      CHECK_LE(apart(force, wanted), 2e-3f * static_cast<float>(wanted_N));
      CHECK_EQ(rig.touch.closest.certificate.sign, off > 0 ? 1 : -1);
    }
  }
}

TEST(SplineSurface_GlidingTouch_ForceIsSmooth) {
  const Surface surface = torus();
  Rig rig(surface, true);
  float worst = 0;
  math::Vec3 before;
  for (int i = 0; i < 4000; ++i) {
    const math::Vec3 now = rig.force_N(on_torus(1e-4 * i, 2e-4 * i, 0.001));
    if (i > 0) worst = std::max(worst, apart(now, before));
    before = now;
  }
  // 2 N that turns by at most 3e-4 rad a tick, and 1 um of the depth.
  CHECK_LE(worst, 2 * 3e-4f + 1e-3f);
}

TEST(OverTheCreasesOfASolidTheForceTurnsWithoutAJump) {
  const Surface surface = cube();
  Rig rig(surface, true);
  (void)rig.go({0, 0, 0.04f}, {0, 0, 0.0215f});
  math::Vec3 before = rig.force_N({0, 0, 0.0215f});
  float worst = 0;
  // Over the edge at x = z = 0.02, 1.5 mm off, then round the corner beyond it.
  std::vector<math::Vec3> way;
  for (int i = 0; i <= 400; ++i) way.push_back({0.02f * static_cast<float>(i) / 400, 0, 0.0215f});
  for (int i = 0; i <= 200; ++i) {
    const double a = 1.5707963 * i / 200;
    way.push_back({static_cast<float>(0.02 + 0.0015 * std::sin(a)), 0,
                   static_cast<float>(0.02 + 0.0015 * std::cos(a))});
  }
  for (int i = 0; i <= 400; ++i)
    way.push_back({0.0215f, 0.0199f * static_cast<float>(i) / 400,
                   0.02f - 0.01f * static_cast<float>(i) / 400});
  for (const math::Vec3& p : way) {
    const math::Vec3 now = rig.force_N(p);
    CHECK_EQ(rig.touch.closest.certificate.sign, 1);
    CHECK_LE(std::fabs(std::sqrt(now.x * now.x + now.y * now.y + now.z * now.z) - 1.5f), 5e-3f);
    worst = std::max(worst, apart(now, before));
    before = now;
  }
  CHECK_LE(worst, 0.06f);
}

TEST(SolidWithMixedNormals_GivesTheContactOfATurnedOne) {
  for (const uint32_t inward : {0x01u, 0x02u, 0x18u, 0x24u}) {
    const Surface sound = cube(), mixed = cube(inward);
    Rig a(sound, true), b(mixed, true);
    math::Vec3 at{0, 0, 0.04f};
    for (int i = 0; i < 3000; ++i) {
      const float t = 0.004f * static_cast<float>(i);
      at = {0.024f * std::sin(t), 0.024f * std::sin(2.1f * t + 1), 0.024f * std::cos(0.7f * t)};
      const math::Vec3 fa = a.force_N(at), fb = b.force_N(at);
      if (a.touch.closest.piece != b.touch.closest.piece) continue;  // two sides equally near
      CHECK_LE(apart(fa, fb), 2e-3f + 1e-3f * apart(fa, {}));
      CHECK_EQ(a.touch.closest.certificate.sign, b.touch.closest.certificate.sign);
    }
  }
}

TEST(Sign_IsKnownInConvexAndConcaveCornersOfASolid) {
  const Surface surface = cube();
  Rig rig(surface, true);
  const math::Vec3 in = rig.go({0, 0, 0.03f}, {0.019f, 0.019f, 0.0185f});
  CHECK_EQ(rig.touch.closest.certificate.sign, -1);
  CHECK_GE(in.x + in.y + in.z, 3.0f);  // out, by the nearest side
  Rig cold(surface, true);             // without a past the sign is known too
  (void)cold.force_N({0.01f, 0.005f, 0.019f});
  CHECK_EQ(cold.touch.closest.certificate.sign, -1);
}

TEST(AnUnknownSideOfASplineIsNeverPushedOn) {
  const Surface surface = torus();
  for (uint32_t steps = 1; steps < 60; ++steps) {
    Rig rig(surface, true);
    rig.budget.work = steps;
    for (int i = 0; i < 30; ++i) {
      rig.touch.hint = {};
      const double off = 0.004 * std::sin(1.0 + i);
      const math::Vec3 force = rig.force_N(on_torus(0.8 * i, 0.4 * i, off));
      const scene::SplineTouch& t = rig.touch;
      if (t.closest.certificate.sign == 0) CHECK_EQ(t.penetration_m, 0.0f);
      if (!t.closest.certificate.exact) CHECK_EQ(t.closest.certificate.sign, 0);
      const float size = std::sqrt(force.x * force.x + force.y * force.y + force.z * force.z);
      CHECK_LE(size, 1000 * static_cast<float>(0.003 - off) + 2e-3f +
                         (off > 0.003 ? 1000 * static_cast<float>(off - 0.003) : 0));
    }
  }
  // A vertex of a cube, cold, from the diagonal: no normal is along the line, so no side, no force.
  const Surface corner = cube();
  Rig rig(corner, true);
  CHECK_EQ(apart(rig.force_N({0.0205f, 0.0205f, 0.0205f}), {}), 0.0f);
  CHECK_EQ(rig.touch.closest.certificate.sign, 0);
  (void)rig.go({0.03f, 0.0f, 0.0f}, {0.03f, 0.03f, 0.03f});
  CHECK_GE(apart(rig.go({0.03f, 0.03f, 0.03f}, {0.0205f, 0.0205f, 0.0205f}), {}), 1.0f);
}

TEST(HostileTouchesOfSplinesLeaveASoundModel) {
  const Surface surface = torus();
  const float bad[] = {__builtin_nanf(""), __builtin_inff(), -__builtin_inff(), 3e38f, 1e-45f};
  for (const float value : bad)
    for (const bool is_closed : {false, true}) {
      Rig rig(surface, is_closed);
      (void)rig.force_N(on_torus(0, 0, 0.001));
      (void)rig.force_N({value, 0, 0});
      (void)rig.force_N({value, value, -value});
      CHECK_EQ(rig.model.plane_count, value < 1 && value > 0 ? rig.model.plane_count : 0u);
      rig.touch.hint.foot = 0xFFFFFFFEu;
      rig.touch.hint.position_m.x = value;
      const math::Vec3 force = rig.force_N(on_torus(0, 0, 0.001));
      CHECK(force.x - force.x <= 0.0f);
    }
  Rig none(surface, true);
  none.object.surface = nullptr;
  CHECK_EQ(apart(none.force_N({0, 0, 0}), {}), 0.0f);
}
