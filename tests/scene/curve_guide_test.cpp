// The curve guide: when it takes hold, which way it pulls, and that its force has no jump.
#include "firmtouch/scene/curve_guide.hpp"

#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "scene/guide_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using scene_test::is_near;
using scene_test::Rig;

TEST(Guide_HoldsWithinSnap_ReleasesBeyondRelease) {
  Rig rig;
  CHECK(is_near(rig.force_N({0.05f, 0.02f, 0.5f}), {0, 0, 0}));  // too far to take hold
  CHECK(!rig.touch.is_held);
  CHECK(is_near(rig.force_N({0.05f, 0.009f, 0.5f}), {0, -0.9f, 0}));
  CHECK(rig.touch.is_held);
  CHECK(is_near(rig.force_N({0.05f, 0.029f, 0.5f}), {0, -2.9f, 0}));  // held now
  CHECK(is_near(rig.force_N({0.05f, 0.031f, 0.5f}), {0, 0, 0}));
  CHECK(!rig.touch.is_held);
  CHECK(is_near(rig.force_N({0.05f, 0.02f, 0.5f}), {0, 0, 0}));
}

TEST(GuidePullsInItsOwnPose) {
  Rig rig;
  CHECK(is_near(rig.force_N({0.05f, 0, 0.508f}), {0, 0, -0.8f}));
  CHECK(is_near(rig.force_N({0.2f, 0.05f, 0.505f}), {0, 0, -0.5f}));
}

TEST(PastAnEndThePullIsToTheEnd) {
  Rig rig;
  CHECK(is_near(rig.force_N({-0.008f, 0, 0.5f}),
                {0.8f, 0, 0}));  // straight on: no direction across is given
  CHECK(is_near(rig.force_N({-0.003f, 0.004f, 0.5f}), {0.3f, -0.4f, 0}));
  CHECK(is_near(rig.force_N({0.2f, 0.107f, 0.5f}), {0, -0.7f, 0}));
}

TEST(ForceHasNoJumpAroundTheCorner) {
  Rig rig;
  math::Vec3 before = rig.force_N({0.19f, -0.005f, 0.5f});
  float worst2 = 0;
  for (int i = 1; i <= 2000; ++i) {  // outside, around the corner at (0.2, 0)
    const float t = static_cast<float>(i) * 1e-5f;
    const math::Vec3 p_m{0.19f + t, -0.005f + (t > 0.01f ? t - 0.01f : 0.0f), 0.5f};
    const math::Vec3 now = rig.force_N(p_m);
    const float x = now.x - before.x, y = now.y - before.y, z = now.z - before.z;
    const float change2 = x * x + y * y + z * z;
    if (change2 > worst2) worst2 = change2;
    before = now;
  }
  CHECK(rig.touch.is_held);
  CHECK_LE(worst2, 0.003f * 0.003f);  // 14 um of motion at 100 N/m, and rounding
}

TEST(GuideDampsAcrossAndNotAlong) {
  Rig rig;
  rig.guide.material = {0.0f, 10.0f};
  (void)rig.force_N({0.05f, 0.004f, 0.5f});
  const math::Vec3 force_N = servo::evaluate(rig.model, {0.05f, 0.004f, 0.5f}, {0.3f, 0.1f, -0.2f});
  CHECK(is_near(force_N, {0, -1.0f, 2.0f}, 1e-4f));
}

TEST(HostileGuidesLeaveASoundModel) {
  const uint32_t bad[] = {0x7FC00000u, 0x7F800000u, 0xFF800000u, 0x7F7FFFFFu, 0x00000001u};
  for (const uint32_t bits : bad) {
    Rig rig;
    const float value = math::float_of(bits);
    const math::Vec3 places[] = {{value, 0, 0.5f}, {0, value, 0.5f}, {value, value, value}};
    for (const math::Vec3 p_m : places) {
      (void)rig.force_N(p_m);
      const bool tiny = value < 1.0f && value > -1.0f;
      CHECK(!rig.touch.is_held || tiny);
      CHECK(!rig.model.has_guide || tiny);
    }
    rig.guide.snap_m = value;
    rig.guide.release_m = value;
    (void)rig.force_N({0.05f, 0.001f, 0.5f});
    CHECK(servo::is_sound(rig.model));
  }
  Rig closed;
  closed.view = curve::View{};
  closed.touch.is_held = true;
  CHECK(is_near(closed.force_N({0, 0, 0.5f}), {0, 0, 0}));
  CHECK(!closed.touch.is_held);
}
