// The theorems of a proxy among several objects that move: every move is cast against each object,
// in that object's frame.
#include <cmath>
#include <cstdint>
#include <limits>

#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "scene/objects_rig.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

scene::Object at(Vec3 place_m) {
  scene::Object object;
  object.pose.translation_m = place_m;
  return object;
}

// A rotation by turns about the axes.
math::Mat3 any_rotation(Draw& draw) {
  scene::Object turned;
  turned.twist.turn_rad_per_s = draw.within(3);
  scene::advance(turned, 1.0f);
  return turned.pose.rotation;
}

// Objects that wander about the origin, turning, now and then at another pace.
void move_about(ObjectsRig& rig, Draw& draw, double speed_mps) {
  for (scene::Object& object : rig.objects) {
    const Vec3 at_m = object.pose.translation_m;
    if (draw.below(300) == 0) {
      object.twist.velocity_mps = draw.within(speed_mps);
      object.twist.turn_rad_per_s = draw.within(10 * speed_mps);
      if (draw.below(3) == 0) object.twist = {};
    }
    Vec3& v = object.twist.velocity_mps;
    if (std::fabs(at_m.x) > 0.1f) v.x = std::copysign(v.x, -at_m.x);
    if (std::fabs(at_m.y) > 0.1f) v.y = std::copysign(v.y, -at_m.y);
    if (std::fabs(at_m.z) > 0.1f) v.z = std::copysign(v.z, -at_m.z);
  }
}

}  // namespace

TEST(Objects_AnyMotionHandAndBudget_NeverCrossASurface) {
  const uint32_t budgets[] = {8, 64, 640, 1u << 20};
  BrokenAmongObjects all;
  for (uint32_t seed = 1; seed <= 16; ++seed) {
    Draw draw(seed);
    ObjectsRig rig;
    rig.add_shape(tools::make_part(1, 2000));
    rig.add_shape(two_walls());
    rig.add_shape(plate(0.0001f), false);
    const uint32_t count = 1 + draw.below(seed % 4 == 0 ? 16 : 4);
    for (uint32_t i = 0; i < count; ++i) {
      scene::Object object = at(draw.within(0.1));
      object.pose.rotation = any_rotation(draw);
      object.friction_static = object.friction_dynamic = draw.between(0, 1);
      rig.add(draw.below(3), object);
    }
    rig.contact.settings.radius_m = draw.below(2) == 0 ? 0.003f : 0.0005f;
    rig.contact.settings.budget.work = budgets[seed % 4];
    BrokenAmongObjects broken;
    Vec3 hand_m{0, 0, 0.15f}, step_m;
    for (uint32_t tick = 0; tick < 6000; ++tick) {
      move_about(rig, draw, seed % 3 == 0 ? 2.0 : 0.3);
      if (tick % 50 == 0) step_m = draw.within(draw.below(8) == 0 ? 0.01 : 0.001);
      hand_m = hand_m + step_m;
      if (math::length(hand_m) > 0.15f) step_m = hand_m * -0.005f;
      rig.tick(hand_m, broken);
    }
    firmtouch::test::note("seed", seed);
    CHECK_EQ(broken.crossings, 0u);
    CHECK_EQ(broken.unclear, 0u);
    CHECK_EQ(broken.longer, 0u);
    CHECK_EQ(broken.over_budget, 0u);
    CHECK_EQ(broken.unsound, 0u);
    all.free += broken.free;
    all.carried += broken.carried;
    all.squeezed += broken.squeezed;
  }
  firmtouch::test::note("free", all.free);
  firmtouch::test::note("carried", all.carried);
  firmtouch::test::note("squeezed", all.squeezed);
  CHECK_GE(all.free, 30000u);  // of 96,000
  CHECK_GE(all.carried, 5000u);
  CHECK_GE(all.squeezed, 1u);
}
