// Small tools among several objects that move and turn, and tools of small spheres: every move is
// cast against every object.
#include <cmath>

#include "scene/hills_rig.hpp"
#include "scene/objects_rig.hpp"
#include "scene/tool_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

// Where an object begins that is skew, and how it goes on.
scene::Object skew(Vec3 place_m) {
  scene::Object object;
  object.pose = {scene::rotation_by({0.4f, -0.7f, 1.1f}), place_m};
  object.twist = {{0.05f, -0.03f, 0.02f}, {0.3f, 0.2f, -0.4f}};
  return object;
}

// A block that moves and turns, the same block far away, and a hand that goes around on the first.
struct Round {
  ObjectsRig rig;
  BrokenAmongObjects broken;
  double lag_m = 0;  // along the block's top, from the hand
  uint32_t uncertain = 0, optimal = 0;

  Round(const tools::Surface& block, float radius_m) {
    rig.add_shape(block);
    rig.contact.settings.radius_m = radius_m;
    rig.contact.settings.budget.work = 640;
    rig.add(0, skew({0.02f, 0.01f, -0.03f}));
    scene::Object far;
    far.pose.translation_m = {0, 0, -0.3f};
    rig.add(0, far);
  }

  void follow(uint32_t ticks, double step_m, double top_m) {
    for (uint32_t tick = 0; tick < ticks; ++tick) {
      scene::Object block = rig.objects[0];
      scene::advance(block, rig.contact.passed_s);
      if (rig.objects.size() > 2) stand_on(block.pose, tick);
      const Vec3 hand_m = round_hand(tick, step_m, top_m);
      rig.tick(math::apply(block.pose, hand_m), broken);
      uncertain += rig.touch.touch.moved.is_starved ? 1u : 0u;
      if (tick < 200) continue;
      optimal += rig.touch.touch.moved.is_optimal ? 1u : 0u;
      const Vec3 off_m = math::apply_inverse(rig.objects[0].pose, rig.proxy_m()) - hand_m;
      lag_m = std::fmax(lag_m, std::hypot(wide(off_m.x), wide(off_m.y)));
    }
  }
  uint32_t wrong() const {
    return broken.crossings + broken.unclear + broken.longer + broken.over_budget + broken.unsound;
  }

  // A wall of 0.1 mm, upright across the hand's way. It goes along with the block, and by so much
  // a tick to and fro.
  void add_wall(float step_m) {
    rig.add_shape(plate(0.0001f));
    scene::Object wall;
    wall.pose.translation_m = {0, 0, 0.2f};
    rig.add(1, wall);
    wall_step_m = step_m;
  }

 private:
  void stand_on(const math::RigidTransform& block, uint32_t tick) {
    const uint32_t phase = tick % 64, off = phase < 32 ? phase : 64 - phase;
    math::RigidTransform& pose = rig.objects[2].pose;
    const Vec3 own_m{-0.002f, 0.01f + static_cast<float>(off) * wall_step_m, 0};
    pose.translation_m = math::apply(block, own_m);
    constexpr float kTurn = 0.5f * 3.14159265f;
    const math::Mat3 upright = scene::rotation_by({kTurn, 0, 0});
    const auto column = [&](Vec3 axis) { return block.rotation * (upright * axis); };
    const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    pose.rotation = {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
  }

  float wall_step_m = 0;
};

}  // namespace

TEST(SmallTool_OnAnObjectThatMoves_FollowsTheHand) {
  for (const float radius_m : {0.0f, 0.00002f, 0.0001f}) {
    Round on_a_plane(hilly(50, flat), radius_m);
    on_a_plane.follow(1000, 5e-4, 0);
    CHECK_EQ(on_a_plane.wrong() + on_a_plane.uncertain + on_a_plane.broken.squeezed, 0u);
    CHECK_LE(on_a_plane.lag_m, 1e-6);
    Round over_hills(hilly(80, hills), radius_m);
    over_hills.follow(1000, 5e-4, 0.004);
    CHECK_EQ(over_hills.wrong() + over_hills.uncertain + over_hills.broken.squeezed, 0u);
    CHECK_LE(over_hills.lag_m, 0.0005);
    CHECK_LE(780u, over_hills.optimal);
  }
}

// What is known of the drum where the hand comes from does not reach as far as it goes.
TEST(SmallTool_ThatLeavesAnotherObjectBehind_FollowsTheHand) {
  for (const float radius_m : {0.0f, 0.00002f}) {
    ObjectsRig rig;
    rig.add_shape(hilly(50, flat));
    rig.add_shape(drum(0.003f, 0.003f, 8));
    rig.contact.settings.radius_m = radius_m;
    rig.contact.settings.budget.work = 640;
    rig.add(0, {});
    scene::Object small;
    small.pose.translation_m = {0, -0.08f, 0.01f};
    rig.add(1, small);
    BrokenAmongObjects broken;
    double lag_m = 0;
    for (uint32_t tick = 0; tick < 280; ++tick) {
      const float y_m = tick < 100 ? -0.045f : -0.045f + 0.0005f * static_cast<float>(tick - 100);
      const float z_m = tick < 100 ? 0.008f - 0.0001f * static_cast<float>(tick) : -0.002f;
      rig.tick({0, y_m, z_m}, broken);
      lag_m = std::fmax(lag_m, std::fabs(wide(rig.proxy_m().y) - wide(y_m)));
    }
    CHECK_LE(lag_m, 1e-6);
    CHECK_EQ(broken.crossings + broken.unclear + broken.longer + broken.over_budget, 0u);
  }
}

TEST(SmallTool_OnAnObjectBesideAThinWall_CrossesNeither) {
  uint32_t free = 0;
  for (const float radius_m : {0.0f, 0.00002f, 0.0001f})
    for (const float step_m : {0.0f, 0.001f})
      for (const bool is_level : {true, false}) {
        Round round(is_level ? hilly(50, flat) : hilly(80, hills), radius_m);
        round.add_wall(step_m);
        round.follow(1000, 5e-4, is_level ? 0 : 0.004);
        CHECK_EQ(round.wrong(), 0u);
        free += round.broken.free;
        if (step_m > 0.0f) continue;  // it squeezes the tool, whose hand is then inside
        CHECK_EQ(round.broken.squeezed, 0u);
        CHECK_LE(round.uncertain, 1u);  // in the first tick
        CHECK_LE(760u, round.optimal);
      }
  CHECK_LE(8000u, free);  // of 12,000
}

// Two spheres of a finger and its nail's point, on one mesh.
TEST(SmallTool_OfThreeSpheres_FollowsTheHand) {
  ToolRig rig(hilly(80, hills),
              {{{0, 0, 0}, 0.0f}, {{0.002f, 0, 0}, 0.00002f}, {{0, 0.002f, 0}, 0.0001f}});
  rig.contact.settings.budget.work = 2000;
  double lag_m = 0;
  for (uint32_t tick = 0; tick < 1000; ++tick) {
    if (tick % 200 == 0) rig.turn.want(2, tick % 400 == 0 ? 0.5f : -0.5f);
    rig.observe(round_hand(tick, 5e-4, 0.004));
    if (tick < 200) continue;
    CHECK(!rig.model.is_uncertain);
    for (uint32_t i = 0; i < 3; ++i) {
      const Vec3 off_m = rig.of(i).position_m - rig.touch.place_m[i];
      lag_m = std::fmax(lag_m, std::hypot(wide(off_m.x), wide(off_m.y)));
    }
  }
  CHECK_LE(lag_m, 0.0005);
  CHECK_EQ(rig.broken.crossings + rig.broken.unclear + rig.broken.over_budget + rig.broken.unsound,
           0u);
  CHECK_LE(rig.broken.longer_m, 1e-7 * wide(rig.size_m()));
}
