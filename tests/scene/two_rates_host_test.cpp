// Contact at two rates: no late model takes a proxy through a surface.
#include "harness/long.hpp"
#include "scene/two_rates_rig.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

constexpr uint32_t kTicks = 3000;
constexpr uint32_t kBudgets[] = {4, 100, 300, 640, 2000, 1u << 20};

void add_to(Count& all, const Count& count, uint32_t seed) {
  firmtouch::test::note("seed", seed);
  CHECK_EQ(count.crossings, 0u);
  CHECK_EQ(count.lost, 0u);
  CHECK_EQ(count.unsound, 0u);
  all.moves += count.moves;
  all.loaded += count.loaded;
}

void use_friction(Draw& draw, scene::ProxyContact& contact) {
  contact.settings.friction_static = contact.settings.friction_dynamic =
      draw.below(2) == 0 ? 0.5f : 0.0f;
}

// `move(passed_s)`: what moves before a model is made.
template <class Rig, class Move>
void run(Rig& rig, Draw& draw, float reach_m, const Move& move) {
  Late late;
  late.most_ticks = 1 + draw.below(20);
  WildHand hand(draw, reach_m);
  const bool is_switched = draw.below(4) == 0;
  rig.contact.settings.budget.work = kBudgets[draw.below(6)];
  for (uint32_t tick = 0; tick < kTicks; ++tick) {
    hand.move(tick);
    rig.contact.is_on = !is_switched || tick / 200 % 4 != 0;
    rig.servo_moves(hand.at_m);
    if (!late.tick(tick, hand.at_m, rig.model, draw)) continue;
    rig.contact.passed_s = late.passed_s(tick);
    move(rig.contact.passed_s);
    rig.make(late);
  }
}

float any_radius_m(Draw& draw) {
  return draw.below(3) == 0 ? draw.between(0.00005, 0.0005) : draw.between(0.001, 0.005);
}

Count run_proxy(const tools::Surface& surface, uint32_t seed) {
  Draw draw(seed);
  LateProxy rig(surface, draw.below(4) != 0);
  rig.contact.settings.radius_m = any_radius_m(draw);
  use_friction(draw, rig.contact);
  run(rig, draw, 0.08f, [](float) {});
  return rig.count;
}

Count run_tool(const tools::Surface& surface, uint32_t seed) {
  Draw draw(seed);
  std::vector<scene::SphereLayout> spheres(1 + draw.below(scene::kMaxSpheres));
  for (scene::SphereLayout& sphere : spheres) {
    const Vec3 at_m = draw.within(0.03);
    const float radius_m = draw.below(6) == 0 ? 0 : draw.between(0.00005, 0.004);
    sphere = {{at_m.x, at_m.y, at_m.z}, radius_m};
  }
  LateTool rig(surface, spheres, draw.below(4) != 0);
  use_friction(draw, rig.contact);
  run(rig, draw, 0.08f, [&](float passed_s) {
    if (draw.below(10) == 0) rig.turn.want(draw.below(3), draw.between(-3, 3));
    rig.turn.advance(passed_s);
  });
  return rig.count;
}

// Objects that wander about the origin, turning, now and then at another pace.
void wander_about(LateObjects& rig, Draw& draw, double speed_mps) {
  for (scene::Object& object : rig.objects) {
    Vec3& v = object.twist.velocity_mps;
    if (draw.below(60) == 0) {
      v = draw.within(speed_mps);
      object.twist.turn_rad_per_s = draw.within(10 * std::fmin(speed_mps, 1.0));
      if (draw.below(3) == 0) object.twist = {};
    }
    const Vec3 at_m = object.pose.translation_m;
    if (math::length(at_m) > 0.15f) v = at_m * (math::length(v) / -math::length(at_m));
  }
}

Count run_objects(LateObjects& rig, uint32_t seed) {
  Draw draw(seed);
  const uint32_t count = 1 + draw.below(scene::kMaxObjects);
  const double spread_m = draw.below(2) == 0 ? 0.1 : 0.05;
  for (uint32_t i = 0; i < count; ++i) {
    scene::Object turned;
    turned.twist.turn_rad_per_s = draw.within(3);
    scene::advance(turned, 1.0f);
    scene::Object object;
    object.pose = {turned.pose.rotation, draw.within(spread_m)};
    object.friction_static = object.friction_dynamic = draw.below(2) == 0 ? 0.4f : 0.0f;
    rig.add(draw.below(static_cast<uint32_t>(rig.shapes.size())), object);
  }
  rig.scene_m = 0.6f;
  rig.contact.settings.radius_m = any_radius_m(draw);
  const double speeds_mps[] = {0, 0.05, 0.3, 2};
  const double speed_mps = speeds_mps[draw.below(4)];
  run(rig, draw, 0.16f, [&](float) {
    if (speed_mps > 0) wander_about(rig, draw, speed_mps);
  });
  return rig.count;
}

}  // namespace

TEST(TwoRates_AnyHandToolAndLateModel_NoSphereCrossesASurface) {
  const tools::Surface shapes[] = {two_walls(), slot(0.004f),           plate(0.0001f),
                                   groove(),    drum(0.03f, 0.02f, 40), tube(0.01f, 0.03f, 24)};
  Count all;
  for (uint32_t seed = 0; seed < (firmtouch::test::is_long() ? 6000 : 60); ++seed)
    for (const auto run_one : {run_proxy, run_tool})
      add_to(all, run_one(shapes[seed % 6], seed), seed);
  CHECK_GE(all.moves, 200000u);
  CHECK_GE(all.loaded, 60000u);
}

TEST(TwoRates_AnyHandObjectsAndLateModel_ProxyCrossesNoneOfThem) {
  LateObjects empty;
  empty.add_shape(two_walls());
  empty.add_shape(plate(0.0002f));
  empty.add_shape(drum(0.02f, 0.02f, 24), false);
  empty.add_shape(slot(0.004f));
  empty.add_shape(tools::make_part(1, 500));
  for (const ProxyRig& shape : empty.shapes) empty.all.emplace_back(shape.view);
  Count all;
  for (uint32_t seed = 0; seed < (firmtouch::test::is_long() ? 3000 : 16); ++seed) {
    LateObjects rig = empty;
    for (ProxyRig& shape : rig.shapes) shape.object.mesh = &shape.view;
    add_to(all, run_objects(rig, seed), seed);
  }
  CHECK_GE(all.moves, 200000u);
  CHECK_GE(all.loaded, 2000u);
}
