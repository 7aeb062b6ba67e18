// What you feel: a bar that you lay on a table. Both ends rest on it. Over the edge one end hangs
// in the air: the table feels half as stiff, and the bar wants to tip. Turned upright it is a
// stick.
// Picture: pictures/bar_tool.svg
//
// A tool of several spheres has a proxy for each of them, and each has its part of the stiffness.
// Servo gets one spring with the force and the energy of all; the torque is yours to render.
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/tool.hpp"
#include "proxy_tool.hpp"

using namespace firmtouch;

namespace {

constexpr float kRadius_m = 0.003f, kStiffness_N_per_m = 1000.0f;
constexpr float kEdge_m = 0.03f;  // the table ends at this x; its top is z = 0
constexpr scene::SphereLayout kBar[] = {{{-0.02f, 0, 0}, kRadius_m}, {{0.02f, 0, 0}, kRadius_m}};

// What the spheres touch. A mesh keeps a hint for each of them; a box needs none.
struct Table {
  scene::BoxTouched box{{{}, {kEdge_m - 0.2f, 0, -0.05f}}, {0.2f, 0.2f, 0.05f}};

  float size_m() const { return box.size_m(); }
  scene::Near near(uint32_t, math::Vec3 x_m, query::Budget budget, float needed_m) {
    return box.near(x_m, budget, needed_m);
  }
};

struct World : ProxyTool {
  Table table;
  scene::ToolTurn turn;
  scene::ToolTouch touch;
  math::Vec3 hand_m{-0.02f, 0, 0.04f};

  World() { settings.energy.reservoir_J = 0.0015f; }

  void tick(math::Vec3 to_m) {
    hand_m = to_m;
    turn.advance(settings.tick_period_s);
    scene::ProxyContact contact = begin(hand_m, kStiffness_N_per_m);
    contact.settings.budget.work = 1000;
    scene::touch_by_tool(contact, scene::StoredTool(kBar), turn.rotation, table, touch, model);
    step(hand_m);
  }
  // In a straight line, then at rest.
  void go(float x_m, float z_m) {
    const float from_x_m = hand_m.x, from_z_m = hand_m.z;
    for (uint32_t i = 1; i <= 400; ++i) {
      const float share = i < 300 ? static_cast<float>(i) / 300.0f : 1.0f;
      tick({from_x_m + (x_m - from_x_m) * share, 0, from_z_m + (z_m - from_z_m) * share});
    }
  }
};

}  // namespace

int main() {
  World world;
  bool is_right = true;
  const auto check = [&](float force_N, float torque_Nm) {
    is_right &= is_near(world.output.force_N.z, force_N, 0.01f);
    is_right &= is_near(world.touch.torque_Nm.y, torque_Nm, 1e-4f);
    is_right &= world.output.faults == 0;
  };
  // Both ends 2 mm deep: the whole stiffness, and no torque.
  world.go(-0.02f, 0.02f);
  world.go(-0.02f, kRadius_m - 0.002f);
  check(2.0f, 0);
  // One end is beyond the edge: half of it, 20 mm from the handle.
  world.go(0.02f, kRadius_m - 0.002f);
  check(1.0f, 0.02f);
  // Upright, 20 mm higher: one end again, right below the handle.
  world.go(-0.02f, 0.05f);
  is_right &= world.turn.want(/*axis*/ 1, 1.5707963f);
  world.go(-0.02f, 0.04f);
  world.go(-0.02f, 0.02f + kRadius_m - 0.002f);
  check(1.0f, 0);
  return is_right ? 0 : 1;
}
