// Instructions of contact with 16 objects, one of them touched. A row each:
//     NAME | MEAN | WORST | QUERIES IN A HUNDRED TICKS
// and sizes:   RAM | TOOL | PAIR | STATE OF A TICK
// tools/bench/cortex-m7-touch --objects runs it.
#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/objects.hpp"
#include "target/count.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

constexpr uint32_t kTicks = 2000;
constexpr float kTick_s = 0.001f;

// Boxes of 40 mm.
struct Boxes {
  scene::BoxTouched box{{}, {0.02f, 0.02f, 0.02f}};
  uint32_t queries = 0;
  float size_m() const { return 0.5f; }
  scene::Near near(uint32_t, math::Vec3 x_m, query::Budget budget, float needed_m) {
    ++queries;
    return box.near(x_m, budget, needed_m);
  }
};

// One of them, as a shape.
struct OneBox {
  Boxes& boxes;
  float size_m() const { return boxes.size_m(); }
  scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m) {
    return boxes.near(0, x_m, budget, needed_m);
  }
};

// A hand slides over the first object, pressed 2 mm, at 50 mm/s; the others are in two rows above,
// and creep and turn, or stand.
struct Scene {
  Boxes boxes;
  OneBox one{boxes};
  scene::Object object[scene::kMaxObjects];
  scene::ObjectPair pair[scene::kMaxObjects];
  scene::ObjectsTouch touch;
  scene::ProxyContact contact;
  servo::LocalModel model;
  uint32_t count;
  bool is_moving;

  Scene(uint32_t objects, bool moving) : count(objects), is_moving(moving) {
    for (uint32_t i = 0; i < count; ++i) {
      const float k = static_cast<float>(i);
      if (i == 0) continue;
      object[i].pose.translation_m = {0.05f * (k - 8), i % 2 == 0 ? 0.1f : -0.1f, 0.15f};
      if (moving) object[i].twist = {{0.002f, -0.001f, 0.001f}, {0.1f, 0.2f, 0.3f}};
    }
    contact.settings.radius_m = 0.003f;
    contact.material.stiffness_N_per_m = 1000;
    contact.is_on = contact.has_proxy = true;
    contact.passed_s = kTick_s;
  }

  void tick(math::Vec3 hand_m) {
    if (is_moving)
      for (uint32_t i = 0; i < count; ++i) scene::advance(object[i], kTick_s);
    contact.position_m = hand_m;
    contact.proxy_m = count == 0 ? touch.touch.proxy.position_m : touch.anchor_m;
    model = {};
    if (count == 0)
      scene::touch_by_proxy(contact, one, touch.touch, model);
    else
      scene::touch_objects(contact, {object, pair, count}, boxes, touch, model);
  }
};

void run(const char* name, uint32_t objects, bool is_moving) {
  Scene all(objects, is_moving);
  all.tick({0, 0, 0.03f});
  const uint32_t empty = target::empty_work();
  uint64_t sum = 0;
  uint32_t worst = 0, held = 0;
  all.boxes.queries = 0;
  for (uint32_t i = 0; i < kTicks; ++i) {
    const uint32_t way = i % 400 < 200 ? i % 400 : 400 - i % 400;  // to 10 mm and back
    const math::Vec3 hand_m{0.00005f * static_cast<float>(way), 0, 0.021f};
    const uint32_t start = hal::clock_work();
    all.tick(hand_m);
    const uint32_t took = hal::clock_work() - start - empty;
    sum += took;
    worst = took > worst ? took : worst;
    held += all.touch.touch.penetration_m > 0.0019f ? 1 : 0;
  }
  if (held != kTicks) target::print("not touched in some ticks; touched: ", held);
  hal::board_print(name);
  target::print(" | ", target::instructions(sum / kTicks));
  target::print(" | ", target::instructions(worst));
  target::print(" | ", all.boxes.queries * 100 / kTicks);
  hal::board_print("\n");
}

}  // namespace

int main() {
  hal::board_begin();
  run("1 shape, touch_by_proxy()", 0, false);
  run("1 object", 1, false);
  run("16 objects, 15 far", 16, false);
  run("16 objects, 15 far that move and turn", 16, true);
  target::print("RAM | ", sizeof(scene::ObjectsTouch));
  target::print(" | ", sizeof(scene::ObjectPair));
  target::print(" | ", sizeof(scene::ObjectsTick));
  hal::board_print("\n");
  return 0;
}
