#include "firmtouch/scene/effects.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/effect_sum.hpp"
#include "firmtouch/scene/textured.hpp"
#include "firmtouch/servo/force_parts.hpp"
#include "target/bounds/meter.hpp"
#include "target/random.hpp"

namespace firmtouch::target {
namespace {

using math::Vec3;

constexpr uint32_t kTicks = 20000;

void measure_vibration() {
  Random random(14);
  Worst worst;
  scene::Vibration vibration;
  float force_N = 0;
  for (uint32_t i = 0; i < kTicks; ++i) {
    vibration = {{1, 0, 0}, 1, 0.25f + 0.24f * random.sign(), 0, random.below(100), 0, 100};
    vibration.hold_ticks = random.below(1000);
    const uint32_t tick = random.below(1200);
    worst.of([&] { force_N = scene::vibration_N(vibration, tick); });
    asm volatile("" ::"r"(&force_N) : "memory");
  }
  print_figure("scene/effects.hpp", worst);
}

void measure_passive_effects() {
  constexpr scene::Attraction kMagnet{{}, 400, 0, 2, 0.04f};
  constexpr scene::Detents kRail{{}, {0.6f, 0.8f, 0}, 0.004f, 2};
  constexpr scene::DetentRing kRing{{}, {0.6f, 0.8f, 0}, {0, 0, 1}, 12, 0.005f, 2};
  Random random(15);
  Worst attraction, rail, ring, viscous, wall;
  scene::EffectForce force;
  Vec3 force_N;
  for (uint32_t i = 0; i < kTicks; ++i) {
    const Vec3 at_m = random.cube() * 0.03f, velocity_mps = random.cube();
    attraction.of([&] { force = scene::attraction_at(kMagnet, at_m); });
    rail.of([&] { force = scene::detents_at(kRail, at_m); });
    ring.of([&] { force = scene::detents_at(kRing, at_m); });
    asm volatile("" ::"r"(&force) : "memory");
    viscous.of([&] { force_N = scene::viscous_N({5, 2}, velocity_mps); });
    wall.of([&] { force_N = scene::speed_wall_N({0.3f, {5, 2}}, velocity_mps); });
    asm volatile("" ::"r"(&force_N) : "memory");
  }
  const Worst* const effects[] = {&attraction, &rail, &ring, &viscous, &wall};
  for (const Worst* worst : effects) print_figure("scene/effects.hpp", *worst);
}

void measure_effect_sum() {
  Random random(16);
  Worst begin, damper, stored, put, contact, guide;
  scene::EffectStore store;
  Vec3 contact_N, guide_N;
  for (uint32_t i = 0; i < kTicks; ++i) {
    const Vec3 at_m = random.cube() * 0.01f, velocity_mps = random.cube();
    servo::LocalModel model;
    scene::begin_model(model, at_m, i, 3);
    for (uint32_t k = 0; k < servo::kMaxPlanes; ++k) {
      model.plane[k] = {{k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f}};
      model.plane[k].stiffness_N_per_m = 1000;
    }
    model.plane_count = servo::kMaxPlanes;
    model.spring.is_used = true;
    model.spring.reach_m = 0.005f;
    model.spring.stiffness_N_per_m = 1000;
    model.guide.direction = {0, 0, 1};
    model.guide.stiffness_N_per_m = 500;
    model.guide.tunnel_m = 0.002f;
    model.guide.drive_limit_N = 1;
    model.has_guide = true;
    contact.of([&] { contact_N = servo::contact_N(model, at_m, velocity_mps); });
    guide.of([&] { guide_N = servo::guide_N(model, at_m, velocity_mps); });
    asm volatile("" ::"r"(&contact_N), "r"(&guide_N) : "memory");
    contact_N = random.cube() * 4.0f;
    // To measure the constructor, it is called again in place.
    scene::EffectSum sum(5, contact_N);
    begin.of([&] { sum = scene::EffectSum(5, contact_N); });
    const Vec3 force_N = random.cube() * 3.0f;
    const scene::EffectForce effect{random.cube() * 3.0f, 1 + random.sign()};
    damper.of([&] { sum.add(force_N); });
    stored.of([&] { sum.add(effect, store); });
    put.of([&] { sum.put(at_m, model); });
    asm volatile("" ::"r"(&model), "r"(&store) : "memory");
  }
  damper.take(stored.taken);
  const Worst* const sums[] = {&begin, &damper, &put};
  for (const Worst* worst : sums) print_figure("scene/effect_sum.hpp", *worst);
#include "firmtouch/scene/textured.hpp"
  print_figure("servo/force_parts.hpp", contact);
  print_figure("servo/force_parts.hpp", guide);
}

void measure_textured() {
  Random random(17);
  Worst worst;
  scene::ProxyTouch touch;
  touch.proxy.is_loaded = true;
  scene::TexturedTouch state;
  for (uint32_t i = 0; i < kTicks; ++i) {
    scene::ProxyContact contact;
    contact.position_m = random.cube() * 0.001f;
    touch.penetration_m = math::length(contact.position_m);
    const scene::Cut cut{random.sign() > 0 ? 1e-4f : 1e-3f, random.cube() * 0.4f};
    servo::LocalModel model;
    model.spring.is_used = true;
    model.spring.stiffness_N_per_m = 1000;
    worst.of([&] { scene::end_texture(contact, cut, {}, touch, state, model); });
    asm volatile("" ::"r"(&model), "r"(&state) : "memory");
  }
  print_figure("scene/textured.hpp", worst);
}

}  // namespace

void measure_effects() {
  measure_vibration();
  measure_passive_effects();
  measure_effect_sum();
  measure_textured();
}

}  // namespace firmtouch::target
