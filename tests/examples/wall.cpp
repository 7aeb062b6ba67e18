// What you feel: air, then a firm wall. Each millimetre that you press into it costs one newton.
// Picture: pictures/wall.svg
//
// The smallest use of the library: no asset, no board. A tick describes what is near the tool, and
// servo::step() turns that into a force with ramps, limits and faults.
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr float kWall_m = 0.01f;  // free above this height
constexpr float kStiffness_N_per_m = 1000.0f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.2f, /*tick_period_s*/ 0.001f};

servo::State state;  // from tick to tick

// One tick, every millisecond: the tool's place in, the force on the tool out.
servo::StepOutput tick(uint32_t number, float height_m, bool enable) {
  const math::Vec3 position_m{0, 0, height_m};
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  servo::ContactPlane wall;
  wall.normal = {0, 0, 1};  // out of the wall
  wall.offset_m = kWall_m;
  wall.stiffness_N_per_m = kStiffness_N_per_m;
  scene::add_plane(model, wall);

  const servo::StepInput input{position_m, /*velocity_mps*/ {}, number, enable};
  const servo::StepOutput output = servo::step(state, kSettings, model, input);
  show(position_m, output.force_N);
  return output;
}

}  // namespace

// The hand comes down from 30 mm at 20 mm/s, and goes on through the wall to 10 mm below it.
int main() {
  bool is_right = true;
  for (uint32_t i = 0; i <= 1500; ++i) {
    const float height_m = 0.03f - 0.00002f * static_cast<float>(i);
    const float depth_m = kWall_m - height_m;
    const servo::StepOutput output = tick(i, height_m, true);
    const float spring_N = depth_m > 0 ? kStiffness_N_per_m * depth_m : 0;
    is_right &= is_near(output.force_N.z, spring_N < 8.0f ? spring_N : 8.0f);  // the limit holds
    is_right &= is_near(output.force_N.x, 0) && is_near(output.force_N.y, 0);
    is_right &= output.faults == 0;
  }
  // The operator lets the enable switch go: no force is left 10 ms later.
  for (uint32_t i = 1501; i <= 1511; ++i) tick(i, 0.0f, false);
  const servo::StepOutput off = tick(1512, 0.0f, false);
  is_right &= off.mode == servo::Mode::kOff && is_near(off.force_N.z, 0);
  return is_right ? 0 : 1;
}
