// The theorems of a proxy among several objects that move: every move is cast against each object,
// in that object's frame.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/spline_touched.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "scene/objects_rig.hpp"
#include "scene/spline_rig.hpp"
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

// Objects that wander about a place, turning, now and then at another pace.
void move_about(ObjectsRig& rig, Draw& draw, Vec3 place_m, double speed_mps) {
  for (scene::Object& object : rig.objects) {
    const Vec3 at_m = object.pose.translation_m - place_m;
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

namespace {

// A torus of splines, a ball, and a mesh: three kinds of shapes behind one query.
struct Kinds {
  spline_touch::Surface torus = spline_touch::torus();
  scene::SplineObject spline;
  spline::Hint spline_hint;
  scene::SphereTouched ball{{}, 0.02f};
  ProxyRig mesh{tools::make_part(1, 2000)};

  Kinds() {
    spline.surface = &torus.view;
    spline.is_closed = true;
  }
  float size_m() const { return 0.6f; }
  scene::Near near(uint32_t object, Vec3 x_m, query::Budget budget, float needed_m) {
    if (object == 0) return scene::SplineTouched{spline, spline_hint}.near(x_m, budget, needed_m);
    if (object == 1) return ball.near(x_m, budget, needed_m);
    return scene::MeshTouched{mesh.object, mesh.hint}.near(x_m, budget, needed_m);
  }
  // In closed form, and by brute force; a tool that is inside of one is that deep below 0.
  double distance_m(uint32_t object, Vec3 p) const {
    const auto wide = [](float a) { return static_cast<double>(a); };
    if (object == 0) return std::hypot(std::hypot(wide(p.x), wide(p.y)) - 0.05, wide(p.z)) - 0.02;
    if (object == 1) return ProxyRig::distance(p, {}) - 0.02;
    return mesh.truth_m(p);
  }
};

}  // namespace

TEST(Objects_SplineMeshAndBall_AreTouchedByOneProxy) {
  Kinds kinds;
  scene::Object objects[3] = {at({-0.08f, 0, 0}), at({0.03f, 0.03f, 0}), at({0.06f, -0.05f, 0})};
  scene::ObjectPair pairs[3];
  for (uint32_t i = 0; i < 3; ++i) pairs[i].pose = objects[i].pose;
  objects[0].twist.turn_rad_per_s = {0.5f, 0.3f, 0};
  objects[1].twist.velocity_mps = {-0.01f, 0, 0};
  objects[2].twist.turn_rad_per_s = {0, 0, -1};
  scene::ObjectsTouch touch;
  scene::ProxyContact contact;
  contact.settings.radius_m = 0.003f;
  contact.settings.budget.work = 4000;
  contact.material.stiffness_N_per_m = 1000;
  contact.is_on = contact.has_proxy = true;
  contact.passed_s = 0.001f;
  Draw draw(7);
  Vec3 hand_m{0, 0, 0.12f}, step_m;
  uint32_t touched[3] = {}, near = 0;
  for (uint32_t tick = 0; tick < 20000; ++tick) {
    if (tick % 2000 == 0) objects[1].twist.velocity_mps.x *= -1;
    for (scene::Object& object : objects) scene::advance(object, 0.001f);
    if (tick % 60 == 0) step_m = draw.within(0.0008);
    hand_m = hand_m + step_m;
    if (math::length(hand_m) > 0.13f) step_m = hand_m * -0.005f;
    contact.position_m = hand_m;
    contact.proxy_m = touch.anchor_m;
    servo::LocalModel model;
    scene::touch_objects(contact, {objects, pairs, 3}, kinds, touch, model);
    if (touch.touch.proxy.phase != scene::Proxy::Phase::kFree) continue;
    if (touch.carrier < 3) ++touched[touch.carrier];
    const double needed_m = static_cast<double>(touch.touch.proxy.radius_m) - 2e-6 * 0.6;
    for (uint32_t i = 0; i < 3; ++i)
      if (i != 2 || tick % 16 == 0)
        near +=
            kinds.distance_m(i, math::apply_inverse(objects[i].pose, touch.anchor_m)) < needed_m;
  }
  CHECK_EQ(near, 0u);
  for (const uint32_t ticks : touched) CHECK_GE(ticks, 100u);
}

namespace {

struct TwoBalls {
  scene::SphereTouched ball{{}, 0.02f};
  scene::Object object[2];
  float size_m() const { return 0.3f; }
  scene::Near near(uint32_t, Vec3 x_m, query::Budget budget, float needed_m) {
    return ball.near(x_m, budget, needed_m);
  }
  // From a place in the frame of the first one, in double.
  double truth_m(uint32_t i, Vec3 x_m) const {
    const auto wide = [](float a) { return static_cast<double>(a); };
    const math::RigidTransform &from = object[0].pose, &to = object[i].pose;
    const float off_m[3] = {to.translation_m.x, to.translation_m.y, to.translation_m.z};
    const float at_m[3] = {from.translation_m.x, from.translation_m.y, from.translation_m.z};
    double off2_m2 = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 row = from.rotation.row[k];
      const double turned_m =
          wide(row.x) * wide(x_m.x) + wide(row.y) * wide(x_m.y) + wide(row.z) * wide(x_m.z);
      off2_m2 += std::pow(turned_m + (wide(at_m[k]) - wide(off_m[k])), 2);
    }
    return std::sqrt(off2_m2) - wide(ball.radius_m);
  }
};

}  // namespace

// Two balls that are turned, up to 9 m away: the place goes from the frame of one to that of the
// other, and moves on with the bounds that are known.
TEST(Objects_AnyPosesFarFromTheMiddle_BoundsAreTrue) {
  const auto wide = [](float a) { return static_cast<double>(a); };
  Draw draw(29);
  double loosest_m = 0;
  uint32_t compared = 0;
  for (uint32_t i = 0; i < 10000; ++i) {
    const Vec3 place_m = draw.within(i % 2 == 0 ? 9 : 0.3);
    TwoBalls balls;
    scene::ObjectPair pairs[2];
    for (uint32_t k = 0; k < 2; ++k) {
      balls.object[k] = at(place_m + draw.within(0.1));
      balls.object[k].pose.rotation = any_rotation(draw);
      pairs[k].pose = balls.object[k].pose;
    }
    scene::ObjectsTouch touch;
    scene::Proxy& proxy = touch.touch.proxy;
    proxy.phase = scene::Proxy::Phase::kFree;
    proxy.radius_m = 1e-4f;
    scene::ProxyContact contact;
    contact.is_on = contact.has_proxy = true;
    contact.passed_s = 0.001f;
    contact.settings.radius_m = proxy.radius_m;
    Vec3 x_m = draw.within(0.1);
    for (uint32_t n = 0; n < 4; ++n, x_m = x_m + draw.within(0.002)) {
      touch.carrier = 0;
      proxy.position_m = x_m;
      contact.position_m = contact.proxy_m = touch.anchor_m =
          math::apply(balls.object[0].pose, x_m);
      scene::ObjectsTick tick(contact, {balls.object, pairs, 2}, balls.size_m(), touch);
      while (tick.carry()) {
        const scene::ObjectQuery& q = tick.query();
        tick.take_bound(balls.near(q.object, q.x_m, q.budget, q.needed_m));
      }
      const double truths_m[2] = {balls.truth_m(0, x_m), balls.truth_m(1, x_m)};
      const double truth_m = std::min(truths_m[0], truths_m[1]);
      if (touch.carrier != 0 || truth_m < 2e-4) break;  // in a ball, or on one
      for (uint32_t k = 0; k < 2; ++k) CHECK_LE(wide(pairs[k].left_m), truths_m[k] + 1e-8);
      scene::NearestObject<TwoBalls> nearest{tick, balls};
      const double lower_m = wide(nearest.near(x_m, query::kUnlimited, 1e-4f).lower_m);
      CHECK_LE(lower_m, truth_m + 1e-8);
      loosest_m = std::max(loosest_m, truth_m - lower_m);
      ++compared;
    }
  }
  CHECK_GE(compared, 20000u);
  CHECK_LE(loosest_m, 5e-6);
}

TEST(Objects_AnyMotionHandAndBudget_NeverCrossASurface) {
  const uint32_t budgets[] = {8, 64, 640, 1u << 20};
  BrokenAmongObjects all;
  for (uint32_t seed = 1; seed <= 16; ++seed) {
    Draw draw(seed);
    ObjectsRig rig;
    rig.add_shape(tools::make_part(1, 2000));
    rig.add_shape(two_walls());
    rig.add_shape(plate(0.0001f), false);
    // Up to 30 sizes of the scene, where coordinates round by as much as the clearance.
    const Vec3 aside_m = Vec3{0.5f, -0.3f, 0.6f} * (seed > 12 ? 16.0f : seed > 8 ? 1.0f : 0.0f);
    const uint32_t count = 1 + draw.below(seed % 4 == 0 ? 16 : 4);
    for (uint32_t i = 0; i < count; ++i) {
      scene::Object object = at(aside_m + draw.within(0.1));
      object.pose.rotation = any_rotation(draw);
      object.friction_static = object.friction_dynamic = draw.between(0, 1);
      rig.add(draw.below(3), object);
    }
    const float radii_m[] = {0.003f, 0.0005f, 0.00002f, 0};
    rig.contact.settings.radius_m = radii_m[draw.below(4)];
    rig.contact.settings.budget.work = budgets[seed % 4];
    BrokenAmongObjects broken;
    Vec3 hand_m{0, 0, 0.15f}, step_m;
    for (uint32_t tick = 0; tick < 6000; ++tick) {
      move_about(rig, draw, aside_m, seed % 3 == 0 ? 2.0 : 0.3);
      if (tick % 50 == 0) step_m = draw.within(draw.below(8) == 0 ? 0.01 : 0.001);
      hand_m = hand_m + step_m;
      if (math::length(hand_m) > 0.15f) step_m = hand_m * -0.005f;
      rig.tick(aside_m + hand_m, broken);
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
