#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/material_touch.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/proxy_contact.hpp"
#include "target/bounds/asset.hpp"
#include "target/bounds/hand.hpp"
#include "target/bounds/meter.hpp"
#include "target/worst_cases.hpp"

namespace firmtouch::target {
namespace {

using math::Vec3;

constexpr uint32_t kTicks = 30000;

// The mesh as a shape; counts what its queries take.
struct Counted {
  const scene::MaterialMeshObject& object;
  mesh::Hint hint;
  uint32_t taken = 0;
  Vec3 surface_m;
  float size_m() const { return object.mesh->head().diagonal_m; }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) {
    const scene::MeshTouchedWith<false, false, scene::MaterialMeshObject> shape{object, hint};
    const uint32_t before = hal::clock_work();
    const scene::Near near = shape.near(x_m, budget, needed_m);
    taken += instructions(hal::clock_work() - before);
    surface_m = near.feature.corner[0];
    return near;
  }
};

// Without a texture, of waves, of a map; of a proxy beside its queries.
struct TouchFigures {
  Worst plain, waves, relief, own;
};

// Ticks through a proxy, as touch_materials() goes: of a hand that creeps and leaps, and of hands
// about those whose ticks took longest.
class TouchAttack {
 public:
  TouchAttack(const mesh::Head& head, uint32_t seed, TouchFigures& figures)
      : hand_(head.low_m, head.high_m, seed), figures_(figures) {
    object_.mesh = &asset().mesh;
    object_.materials = &asset().materials;
    contact_.material = {1000, 2};
    contact_.is_on = true;
    contact_.passed_s = 0.001f;
  }

  void run() {
    for (uint32_t i = 0; i < kTicks; ++i) {
      if (i > kTicks / 8 && random().below(2) == 0)
        try_worst();
      else
        go_on(i);
      tick(i);
    }
  }

 private:
  // Before a tick.
  struct State {
    scene::ProxyTouch touch;
    scene::MaterialTouch materials;
    mesh::Hint hint;
    Vec3 at_m;
    scene::ProxySettings settings;
    uint32_t taken = 0;
  };

  Random& random() { return hand_.random(); }

  void go_on(uint32_t i) {
    scene::ProxySettings& settings = now_.settings;
    if (i % 500 == 0) {
      settings.radius_m = random().scale(2e-4f, 4);
      settings.friction_static = i % 1000 == 0 ? 0 : 0.5f;
      settings.friction_dynamic = settings.friction_static * 0.8f;
      settings.budget = query::Budget{10000};
    }
    now_.at_m = hand_.next(shape_.surface_m);
  }

  void try_worst() {
    now_ = worst_.any(random());
    now_.at_m = now_.at_m + random().cube() * random().scale(1e-6f * hand_.extent_m(), 16);
  }

  void tick(uint32_t i) {
    State before = now_;
    shape_.hint = now_.hint;
    shape_.taken = 0;
    contact_.settings = now_.settings;
    contact_.position_m = now_.at_m;
    contact_.proxy_m = now_.touch.proxy.position_m;
    contact_.has_proxy = i > 0;
    servo::LocalModel model;
    scene::begin_model(model, now_.at_m, i, 10);
    scene::ProxyContact used = contact_;
    uint32_t added =
        instructions_of([&] { scene::begin_materials(used, now_.touch, now_.materials); });
    const uint32_t all =
        instructions_of([&] { scene::touch_by_proxy(used, shape_, now_.touch, model); });
    added += instructions_of(
        [&] { scene::end_materials(contact_, object_, now_.touch, now_.materials, model); });
    now_.hint = shape_.hint;
    before.taken = all > shape_.taken ? all - shape_.taken : 0;
    figures_.own.take(before.taken);
    const uint8_t was = before.materials.textured, is = now_.materials.textured;
    const uint8_t textured = was > is ? was : is;
    (textured >= 3 ? figures_.relief : textured == 2 ? figures_.waves : figures_.plain).take(added);
    worst_.keep(before);
  }

  Hand hand_;
  scene::MaterialMeshObject object_;
  Counted shape_{object_, {}, 0, {}};
  scene::ProxyContact contact_;
  State now_;
  WorstCases<State, &State::taken> worst_;
  TouchFigures& figures_;
};

}  // namespace

// Three searches, each from a hand of its own: one may begin where little is to be found.
void measure_touch() {
  TouchFigures worst;
  const mesh::Head& head = asset().mesh.head();
  static TouchAttack attacks[] = {// too large for the stack
                                  {head, 10, worst},
                                  {head, 11, worst},
                                  {head, 12, worst}};
  for (TouchAttack& attack : attacks) attack.run();
  print_figure("scene/material_touch.hpp", worst.plain);
  print_figure("scene/material_touch.hpp", worst.waves);
  print_figure("scene/material_touch.hpp", worst.relief);
  print_figure("scene/proxy.hpp", worst.own);
}

}  // namespace firmtouch::target
