// Spline sheets: contact from their free side, however deep they are pressed, never from behind.
#include <algorithm>
#include <cmath>

#include "harness/test.hpp"
#include "scene/spline_rig.hpp"

using namespace firmtouch;     // NOLINT: a test file
using namespace spline_touch;  // NOLINT

TEST(Sheet_PushesFromItsFreeSideOnly) {
  const Surface surface = sheet();
  Rig rig(surface, false);
  CHECK_LE(apart(rig.go({0, 0, 0.01f}, {0, 0, 0.001f}), {0, 0, 2}), 2e-3f);
  CHECK_LE(apart(rig.go({0, 0, 0.001f}, {0.01f, 0, -0.001f}), {0, 0, 4}), 4e-3f);  // pressed in
  Rig behind(surface, false);
  CHECK_LE(apart(behind.go({0.01f, 0, -0.01f}, {0.01f, 0, 0.002f}), {}),
           0.0f);  // from behind: nothing
  CHECK_LE(apart(behind.go({0.01f, 0, 0.002f}, {0.01f, 0, 0.004f}), {}), 0.0f);  // clear now
  CHECK_LE(apart(behind.go({0.01f, 0, 0.004f}, {0.01f, 0, 0.002f}), {0, 0, 1}), 2e-3f);
  Rig turned(surface, false);
  turned.object.is_turned = true;
  CHECK_LE(apart(turned.go({0, 0, 0.01f}, {0, 0, 0.001f}), {}), 0.0f);
  CHECK_LE(apart(turned.go({0, 0, -0.01f}, {0, 0, -0.001f}), {0, 0, -2}), 2e-3f);
}

TEST(Sheet_AnyDepth_Holds_UntilItsBorderIsNearest) {
  const Surface surface = sheet();
  Rig rig(surface, false);
  (void)rig.go({0, 0, 0.01f}, {0, 0, 0.001f});
  CHECK_LE(apart(rig.go({0, 0, 0.001f}, {0.01f, 0, -0.03f}), {0, 0, 33}), 0.04f);
  CHECK_LE(apart(rig.go({0.01f, 0, -0.03f}, {-0.03f, 0.02f, -0.05f}), {0, 0, 53}), 0.06f);
  CHECK_LE(apart(rig.go({-0.03f, 0.02f, -0.05f}, {-0.03f, 0.02f, 0.002f}), {0, 0, 1}), 2e-3f);
  // Round the border contact ends, and from behind there is none.
  (void)rig.go({-0.03f, 0.02f, 0.002f}, {0, 0, -0.02f});
  CHECK_GE(rig.touch.penetration_m, 0.0229f);
  CHECK_LE(apart(rig.go({0, 0, -0.02f}, {0.06f, 0, -0.02f}), {}), 0.0f);
  CHECK_LE(apart(rig.go({0.06f, 0, -0.02f}, {0, 0, -0.001f}), {}), 0.0f);
}

TEST(WhereATickLeapsNoSideOfASheetIsKnown) {
  const Surface surface = sheet();
  for (const float to : {-0.002f, -0.02f}) {
    Rig rig(surface, false);
    (void)rig.go({0, 0, 0.01f}, {0, 0, 0.0049f});
    // Within 3 mm and 2 % of the 80 mm: through; farther: by whichever way.
    (void)rig.force_N({0, 0, to > -0.01f ? 0.0005f : 0.0049f});
    const math::Vec3 force = rig.force_N({0, 0, to});
    CHECK_EQ(force.z > 0, to > -0.01f);
    if (!(to > -0.01f)) CHECK_LE(apart(rig.go({0, 0, to}, {0, 0, -0.001f}), {}), 0.0f);
  }
  Rig deep(surface, false);
  (void)deep.go({0, 0, 0.01f}, {0, 0, -0.01f});
  CHECK_GE(deep.force_N({0.001f, 0, -0.01f}).z, 12.9f);
  CHECK_LE(apart(deep.force_N({0.03f, 0, -0.01f}), {}), 0.0f);
}

// A device of 75 g on a hand that presses 4 cm beyond a wavy sheet, sways there and comes back; 1
// kHz.
TEST(ClosedLoop_HardPress_DoesNotPassASheet) {
  const Surface surface = waves();
  Rig rig(surface, false);
  float z_m = 0.02f, speed_mps = 0, deepest_m = 0, max_N = 0;
  math::Vec3 held;
  int ticks_held = 0;
  const auto tick = [&](float x_m, float hand_m) {
    held = rig.force_N({x_m, 0.3f * x_m, z_m});
    max_N = std::max(max_N, held.z);
    const float hand_N = 400 * (hand_m - z_m) - 8 * speed_mps;
    speed_mps += (hand_N + held.z) / 0.075f * 1e-3f;
    z_m += speed_mps * 1e-3f;
    deepest_m = std::min(deepest_m, z_m);
  };
  for (int i = 0; i < 500; ++i) tick(0, 0.02f - 0.06f * static_cast<float>(i) / 500);
  for (int i = 0; i < 4000; ++i) {
    tick(0.025f * std::sin(0.003f * static_cast<float>(i)), -0.04f);
    ticks_held += held.z > 3;
  }
  CHECK_EQ(ticks_held, 4000);
  CHECK_LE(deepest_m, -0.007f);  // farther than the radius and 2 % of the extent
  CHECK_GE(deepest_m, -0.025f);
  for (int i = 0; i < 500; ++i) tick(0, -0.04f + 0.07f * static_cast<float>(i) / 500);
  for (int i = 0; i < 300; ++i) tick(0, 0.03f);
  CHECK_EQ(rig.touch.penetration_m, 0.0f);  // and out again where it came in
  CHECK(rig.touch.is_from_outside);
  CHECK_LE(std::fabs(z_m - 0.03f), 1e-3f);
  CHECK_LE(max_N, 30);
}

TEST(Sheet_UnknownSide_AnyBudget_MakesNoForce) {
  const Surface surface = waves();
  for (uint32_t steps = 1; steps < 120; steps += 7) {
    Rig rig(surface, false);
    bool was_behind = false;
    for (int i = 0; i < 400; ++i) {
      // Down through it, sideways, and round the border.
      rig.budget.work = i < 100 ? UINT32_MAX : steps;
      const float t = static_cast<float>(i);
      const float z = i < 200 ? 0.01f - 1e-4f * t : -0.01f, x = i < 200 ? 0 : 4e-4f * (t - 200);
      (void)rig.force_N({x, 0, z});
      const scene::SplineTouch& touch = rig.touch;
      const bool is_exact = touch.closest.certificate.exact;
      if (touch.closest.certificate.sign == 0) CHECK_EQ(touch.penetration_m, 0.0f);
      if (!is_exact && touch.closest.certificate.sign < 0) {
        CHECK(was_behind);
        CHECK_LE(touch.penetration_m, touch.closest.certificate.lower_m + kRadius_m + 1e-6f);
      }
      if (x > 0.045f && is_exact) CHECK_EQ(touch.closest.certificate.sign, 0);
      was_behind = touch.closest.certificate.sign < 0;
    }
  }
}

TEST(SheetBorder_ForceFallsOffAndEndsBehindIt) {
  const Surface surface = sheet();
  Rig rig(surface, false);
  (void)rig.go({0, 0, 0.01f}, {0, 0, 0.001f});
  math::Vec3 before = rig.go({0, 0, 0.001f}, {0.039f, 0, 0.001f});
  float worst = 0;
  for (int i = 0; i <= 500; ++i) {  // out over the border
    const math::Vec3 now = rig.force_N({0.039f + 1e-5f * static_cast<float>(i), 0, 0.001f});
    worst = std::max(worst, apart(now, before));
    before = now;
  }
  CHECK_LE(worst,
           0.07f);  // 2 N that turns by 0.01 rad a step, and three times that where it fades in
  CHECK_LE(apart(before, {}), 0.0f);
  CHECK_LE(apart(rig.go({0.044f, 0, 0.001f}, {0.044f, 0, -0.002f}), {}), 0.0f);
  CHECK_LE(apart(rig.go({0.044f, 0, -0.002f}, {0.03f, 0, -0.002f}), {}), 0.0f);
}
