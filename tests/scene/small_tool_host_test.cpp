// Tools that are small beside what a hand moves in a tick: a point, and less than a millimetre.
#include <cmath>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/pose_loss.hpp"
#include "scene/hills_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

}  // namespace

TEST(SmallTool_OnAFace_IsAboveTheHandAtAnySpeed) {
  for (const float radius_m : {0.0f, 0.00002f, 0.0005f})
    for (const double step_m : {1e-5, 1e-4, 1e-3}) {
      ProxyRig rig(hilly(50, flat));
      rig.settings.radius_m = radius_m;
      Broken broken;
      uint32_t behind = 0;
      for (uint32_t tick = 0; tick < 1000; ++tick) {
        const Vec3 hand_m = round_hand(tick, step_m, 0);
        rig.tick(hand_m, broken);
        const Vec3 off_m = rig.proxy.position_m - hand_m;
        const double off = std::hypot(wide(off_m.x), wide(off_m.y));
        if (off > 3e-6 * wide(rig.view.head().diagonal_m)) ++behind;
        CHECK_LE(off, step_m);
      }
      firmtouch::test::note("step", static_cast<uint32_t>(step_m * 1e6));
      CHECK_LE(behind, 1u);  // on a joint of triangles, whose planes differ by rounding
      CHECK_EQ(broken.crossings, 0u);
    }
}

// A part of 5 cm lies 6 of its sizes from the middle of a device.
TEST(SmallTool_SomeSizesFromTheOrigin_FollowsTheHand) {
  for (const float radius_m : {0.0f, 0.00002f, 0.0001f})
    for (const float sizes : {1.0f, 3.0f, 6.0f, 10.0f}) {
      const Vec3 shift_m = Vec3{0.55f, -0.62f, 0.56f} * (0.145f * sizes);
      tools::Surface surface = hilly(50, flat);
      for (Vec3& vertex : surface.vertices) vertex = vertex + shift_m;
      ProxyRig rig(surface);
      rig.settings.radius_m = radius_m;
      Broken broken;
      double lag_m = 0;
      for (uint32_t tick = 0; tick < 1000; ++tick) {
        const Vec3 hand_m = round_hand(tick, 0.0005, 0) + shift_m;
        rig.tick(hand_m, broken);
        const Vec3 off_m = rig.proxy.position_m - hand_m;
        lag_m = std::fmax(lag_m, std::hypot(wide(off_m.x), wide(off_m.y)));
      }
      firmtouch::test::note("sizes", static_cast<uint32_t>(sizes));
      CHECK_LE(lag_m, 0.001);  // two ticks
      CHECK_EQ(broken.crossings, 0u);
    }
}

TEST(SmallTool_OverHills_FollowsTheHand) {
  for (const float radius_m : {0.0f, 0.0001f})
    for (const double step_m : {1e-4, 5e-4}) {
      ProxyRig rig(hilly(80, hills));
      rig.settings.radius_m = radius_m;
      Broken broken;
      uint32_t uncertain = 0;
      for (uint32_t tick = 0; tick < 2000; ++tick) {
        rig.tick(round_hand(tick, step_m, 0.004), broken);
        uncertain += rig.moved.is_starved ? 1 : 0;
      }
      CHECK_EQ(broken.crossings + broken.unclear + broken.over_budget + uncertain, 0u);
      CHECK_LE(0.98 * broken.ticks, 1.0 * broken.optimal);
      CHECK_LE(1.0 * broken.queries, 1.3 * broken.ticks);
    }
}

// At 4 radii a tick: all of a move is as clear as its ends, so no ridge is passed over.
TEST(SmallTool_RidgeLowerThanItsRadius_IsNotPassedOver) {
  const auto ridge = [](double x, double) { return std::fabs(x - 0.01) < 0.0009 ? 0.0003 : 0.0; };
  ProxyRig rig(hilly(60, ridge));
  rig.settings.radius_m = 0.0005f;
  const double lost_m = 3e-6 * wide(rig.view.head().diagonal_m);
  const scene::MeshTouched shape{rig.object, rig.hint};
  uint32_t long_moves = 0;
  for (uint32_t tick = 0; tick < 400; ++tick) {
    const Vec3 hand_m = round_hand(tick, 2e-3, 0);
    scene::ProxyMove move(rig.settings, shape.size_m(), hand_m, rig.proxy);
    const bool was_free = rig.proxy.phase == scene::Proxy::Phase::kFree;
    while (move.aim()) {
      const Vec3 from_m = rig.proxy.position_m;
      move.take(scene::nearest_of(shape, move));
      const Vec3 along_m = rig.proxy.position_m - from_m;
      if (!was_free || math::length(along_m) < rig.proxy.radius_m) continue;
      ++long_moves;
      for (int k = 1; k < 8; ++k)
        CHECK_LE(wide(rig.proxy.radius_m) - lost_m,
                 rig.truth_m(from_m + along_m * (0.125f * static_cast<float>(k))));
    }
    move.finish();
  }
  CHECK_LT(100u, long_moves);
}

TEST(PlacedMesh_AnswersAsAPoseThatTurnsNothing) {
  ProxyRig rig(hilly(40, hills));
  scene::PlacedMesh placed;
  placed.mesh = &rig.view;
  mesh::Hint hint;
  for (const Vec3 place_m : {Vec3{}, Vec3{0.1f, -0.02f, 0.3f}}) {
    rig.object.pose.translation_m = placed.pose.translation_m = place_m;
    const scene::MeshTouched posed{rig.object, rig.hint};
    const scene::PlacedMeshTouched shape{placed, hint};
    for (uint32_t tick = 0; tick < 400; ++tick) {
      const Vec3 x_m = round_hand(tick, 1e-3, 0.002) + place_m;
      scene::Way way;
      way.from_m = x_m;
      way.along_m = {0.01f, 0.002f, -0.003f};
      const scene::Near a = posed.near(x_m, {}, 0.003f), b = shape.near(x_m, {}, 0.003f);
      uint32_t work_a = 0, work_b = 0;
      const float part_a = posed.free_part(way, {}, work_a),
                  part_b = shape.free_part(way, {}, work_b);
      CHECK_EQ(math::bits_of(a.lower_m), math::bits_of(b.lower_m));
      CHECK_EQ(math::bits_of(a.distance_m), math::bits_of(b.distance_m));
      CHECK_EQ(math::bits_of(part_a), math::bits_of(part_b));
      CHECK_EQ(a.work + work_a, b.work + work_b);
      for (uint32_t k = 0; k < 3; ++k)
        CHECK(scene::is_same(a.feature.corner[k], b.feature.corner[k]));
      CHECK(math::length(a.outward - b.outward) <= 0.0f && a.sign == b.sign);
    }
  }
}
