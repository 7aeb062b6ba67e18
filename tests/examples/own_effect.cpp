// What you feel: a bowl of honey. In the air the tool is free; below the surface every move is
// slow, and slower with depth. Let go, and it stays where it is.
// Picture: pictures/own_effect.svg
//
// An effect of your own is a free function that adds to the local model. This one is the
// library's viscosity, thicker with depth.
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/effect_sum.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr float kSurface_m = 0.02f;
constexpr float kPerDepth_N_s_per_m2 = 500.0f;  // 5 N s/m at 10 mm
constexpr float kMaxDamping_N_s_per_m = 10.0f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.0f, /*tick_period_s*/ 0.001f};

// The effect.
void add_honey(math::Vec3 position_m, math::Vec3 velocity_mps, servo::LocalModel& model) {
  const float depth_m = kSurface_m - position_m.z;
  if (!(depth_m > 0)) return;
  const float thick = kPerDepth_N_s_per_m2 * depth_m;
  const float damping_N_s_per_m = thick < kMaxDamping_N_s_per_m ? thick : kMaxDamping_N_s_per_m;
  scene::EffectSum sum(kSettings.force_limit_N, /*contact_N*/ {});
  sum.add(scene::viscous_N({damping_N_s_per_m, kSettings.force_limit_N}, velocity_mps));
  sum.put(position_m, model);
}

servo::State state;

math::Vec3 tick(uint32_t number, math::Vec3 position_m, math::Vec3 velocity_mps) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  add_honey(position_m, velocity_mps, model);
  const servo::StepInput input{position_m, velocity_mps, number, /*enable*/ true};
  const math::Vec3 force_N = servo::step(state, kSettings, model, input).force_N;
  show(position_m, force_N);
  return force_N;
}

}  // namespace

int main() {
  bool is_right = true;
  uint32_t now = 0;
  // Aslant from the air into the bowl, at 50 mm/s down and 100 mm/s aside.
  const math::Vec3 velocity_mps{0.1f, 0, -0.05f};
  for (uint32_t i = 0; i <= 600; ++i) {
    const float time_s = 0.001f * static_cast<float>(i), height_m = 0.03f - 0.05f * time_s;
    const math::Vec3 force_N = tick(now++, {0.1f * time_s, 0, height_m}, velocity_mps);
    const float depth_m = height_m < kSurface_m ? kSurface_m - height_m : 0;
    is_right &= is_near(force_N.x, -kPerDepth_N_s_per_m2 * depth_m * velocity_mps.x);
    is_right &= is_near(force_N.z, -kPerDepth_N_s_per_m2 * depth_m * velocity_mps.z);
  }
  // A weight of 0.2 N on the tool of 0.1 kg sinks, never rises, and reaches 0.2 N / 10 N s/m.
  math::Vec3 at_m{0, 0, 0.01f}, moving_mps;
  float last_m = at_m.z;
  for (uint32_t i = 0; i < 1000; ++i) {
    const math::Vec3 force_N = tick(now++, at_m, moving_mps);
    moving_mps.z += (force_N.z - 0.2f) / 0.1f * 0.001f;
    at_m.z += moving_mps.z * 0.001f;
    is_right &= at_m.z <= last_m;
    last_m = at_m.z;
  }
  is_right &= moving_mps.z < -0.019f && moving_mps.z > -0.021f;  // at the thickest: 10 N s/m
  // Let go: it stops at once, and nothing pushes it.
  for (uint32_t i = 0; i < 200; ++i) {
    const math::Vec3 force_N = tick(now++, at_m, moving_mps);
    moving_mps.z += force_N.z / 0.1f * 0.001f;
    at_m.z += moving_mps.z * 0.001f;
  }
  is_right &= is_near(moving_mps.z, 0) && is_near(tick(now, at_m, {}).z, 0);
  return is_right && state.faults == 0 ? 0 : 1;
}
