// What you feel: a ball that lies on a table and rolls towards your hand. It pushes the tool along
// the table. Where a second wall is in the way, the tool would be squeezed, and lets go.
// Picture: pictures/two_objects.svg
//
// An object is a shape in its own frame, a pose, a twist and a material. One proxy touches them
// all: what moves carries or pushes it, and it goes through none of them.
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/objects.hpp"
#include "firmtouch/servo/fault.hpp"
#include "proxy_tool.hpp"

using namespace firmtouch;

namespace {

constexpr float kTool_m = 0.003f, kBall_m = 0.02f;

// The shapes, each about its own origin: a switch is all that several kinds need.
struct Shapes {
  scene::PlaneTouched table{{0, 0, 0}, {0, 0, 1}, /*scale_m*/ 0.5f};
  scene::SphereTouched ball{{0, 0, 0}, kBall_m};

  float size_m() const { return 0.5f; }
  scene::Near near(uint32_t object, math::Vec3 x_m, query::Budget budget, float needed_m) const {
    return object == 1 ? ball.near(x_m, budget, needed_m) : table.near(x_m, budget, needed_m);
  }
};

struct World : ProxyTool {
  Shapes shapes;
  scene::Object object[3];  // the table, the ball, a wall
  scene::ObjectPair pair[3];
  scene::ObjectsTouch touch;

  explicit World(float wall_x_m) {
    settings.energy.reservoir_J = 0.0015f;
    object[1].pose.translation_m = {-0.0555f, 0, kBall_m};
    object[1].twist.velocity_mps = {0.05f, 0, 0};
    object[1].twist.turn_rad_per_s = {0, 0.05f / kBall_m, 0};  // it rolls
    object[2].pose.translation_m = {wall_x_m, 0, 0};
    object[2].pose.rotation = {{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};  // faces the ball
    for (uint32_t i = 0; i < 3; ++i) pair[i].pose = object[i].pose;
  }

  math::Vec3 tick(math::Vec3 hand_m) {
    for (scene::Object& each : object) scene::advance(each, settings.tick_period_s);
    scene::ProxyContact contact = begin(hand_m, 1000.0f);
    contact.settings.radius_m = kTool_m;
    scene::touch_objects(contact, {object, pair, 3}, shapes, touch, model);
    return step(hand_m);
  }
};

// The hand rests 1 mm deep in the table, at the origin, while the ball comes.
// Result: whether at least 0.9 of the tool was in front of ball and table in every tick without a
// fault.
bool meet(World& world) {
  bool is_right = true;
  for (uint32_t i = 0; i <= 100; ++i) world.tick({0, 0, 0.007f - 0.00005f * static_cast<float>(i)});
  for (uint32_t i = 0; i < 800 && world.output.faults == 0; ++i) {
    world.tick({0, 0, 0.002f});
    const math::Vec3 at_m = world.output.proxy_m;
    const float x_m = at_m.x - world.object[1].pose.translation_m.x, z_m = at_m.z - kBall_m;
    const float tool_m = 0.9f * kTool_m, least_m = tool_m + kBall_m;
    const bool is_clear = at_m.z >= tool_m && x_m * x_m + z_m * z_m >= least_m * least_m;
    is_right &= is_clear || world.output.faults != 0;
  }
  return is_right;
}

}  // namespace

int main() {
  // Room enough: the ball pushes the tool along the table. There they touch 2 sqrt(r R) apart.
  World open(/*wall_x_m*/ 0.2f);
  bool is_right = meet(open);
  const float pushed_m = open.output.proxy_m.x;
  const float apart_m = pushed_m - open.object[1].pose.translation_m.x;
  is_right &= is_between(apart_m, 0.01549f - 2e-5f, 0.01549f + 2e-5f);
  is_right &= is_between(open.output.force_N.z, 0.99f, 1.01f);
  is_right &= is_between(open.output.force_N.x, 990 * pushed_m, 8.0f);
  is_right &= open.output.faults == 0;

  // A wall 5 mm behind the tool: it is squeezed, which is a fault, and the force is gone in 10 ms.
  World closed(/*wall_x_m*/ 0.005f);
  is_right &= meet(closed);
  is_right &= closed.output.faults == servo::kFaultSqueezed;
  for (uint32_t i = 0; i < 10; ++i) closed.tick({0, 0, 0.002f});
  const math::Vec3 force_N = closed.output.force_N;
  is_right &= is_between(force_N.x, 0, 0) && is_between(force_N.z, 0, 0);
  return is_right ? 0 : 1;
}
