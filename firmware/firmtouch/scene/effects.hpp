#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// Effects that take the guide of a local model (scene/compose.hpp): one of them a tick, and no
// curve. An effect with a setting out of range, or with NaN, makes no force.
namespace firmtouch::scene {

/// A force that swings along a line, with an envelope in ticks: it rises, holds, and falls.
struct Vibration {
  math::Vec3 direction;     // unit, device frame
  float amplitude_N = 0;    // 0 to servo::kMaxDriveLimit_N
  float cycles_a_tick = 0;  // frequency times tick period: above 0, below 0.5
  uint32_t start_tick = 0;
  uint32_t rise_ticks = 0;
  uint32_t hold_ticks = 0;
  uint32_t fall_ticks = 0;
};

/// Force along the direction. It is 0 before the start and after the end. The phase is counted in
/// 2^-32 cycles, without a sum that rounds: at any time it is that of cycles_a_tick to 2^-33 a
/// tick.
/// Bounds: about 210 instructions. Error: 1e-6 of the amplitude.
float vibration_N(const Vibration& vibration, uint32_t tick);

/// Result: false, and the model unchanged, if there is no force or the model has a guide.
bool add_vibration(const Vibration& vibration, uint32_t tick, math::Vec3 position_m,
                   servo::LocalModel& model);

/// A point that draws the tool, by a spring of limited force.
struct Attraction {
  math::Vec3 point_m;  // device frame
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
  float limit_N =
      0;  // of the spring, and of spring and damper together along the line to the point
  float reach_m = 0;  // from there on no force
};

/// Force min(stiffness x distance, limit) towards the point, less the damper. Without the damper it
/// has a potential: a closed loop gives no energy.
/// Result: false, and the model unchanged, out of reach or if the model has a guide.
bool add_attraction(const Attraction& attraction, math::Vec3 position_m, servo::LocalModel& model);

}  // namespace firmtouch::scene
