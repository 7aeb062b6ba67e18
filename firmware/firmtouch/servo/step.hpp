#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/energy.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::servo {

// Ramp from a fault that does not cut to no force: at most 10 ms. In ticks: rounded down, at
// least 1.
constexpr float kRampOut_s = 0.008f;

// So long models may be uncertain before kFaultContact, and energy overdrawn before kFaultEnergy.
constexpr float kLasting_s = 0.0099f;
// Motors that are enabled while the model is uncertain stay off until one is certain, so long.
constexpr float kEnabling_s = 0.1999f;

// Settings beyond these are kFaultSettings: no device that a hand holds needs more, and most
// flipped bits of a setting exceed them.
constexpr float kMaxForceLimit_N = 100.0f;
constexpr float kMaxSlewLimit_N_per_s = 1e6f;
constexpr float kMaxTickPeriod_s = 0.1f;
constexpr float kMaxReservoir_J = 1000.0f;

enum class Mode : uint8_t {
  kOff,     // not enabled, or no model is certain yet: no force
  kRampIn,  // enabled a moment ago: the force grows in over ramp_in_s
  kOn,
  kRampOut,  // disabled, or a fault: the last force falls to 0
  kFault,    // latched: no force
};

struct Settings {
  float force_limit_N = 0;
  float slew_limit_N_per_s = 0;
  float ramp_in_s = 0;
  float tick_period_s = 0;
  EnergySettings energy{};
};

struct StepInput {
  math::Vec3 position_m;  // fresh, device frame
  math::Vec3 velocity_mps;
  uint32_t tick = 0;
  bool enable = false;
  bool clear_faults = false;  // taken only while enable is false
  uint32_t reported = 0;      // faults that other modules detected in this tick
};

struct StepOutput {
  math::Vec3 force_N;
  math::Vec3 proxy_m;  // the tool's position where there is no proxy
  Mode mode = Mode::kOff;
  uint32_t faults = 0;  // latched
};

struct State {
  Mode mode = Mode::kOff;
  uint32_t faults = 0;
  uint32_t ramp_in_ticks = 0;
  uint32_t ramp_out_left = 0;
  math::Vec3 force_N;             // of the last tick
  math::Vec3 position_m, move_m;  // of the tool in the last tick
  math::Vec3 part_N;  // while on, what of it planes and guide make; in a ramp out, where it began
  math::Vec3 proxy_m;
  bool has_proxy = false;
  uint32_t uncertain_ticks = 0;  // of the models while enabled, without a break
  float reservoir_J = 0;         // what both springs have left; full where the motors come on
  Energy energy;                 // of the proxy's
  Energy guide_energy;           // of the guide's
  float guide_N_per_m = -1;      // its stiffness in the last tick; below 0: no guide
  uint32_t made_tick = 0;        // of the last tick's model
};

/// Force of this tick: the local model evaluated at the fresh position, ramped in, limited in size
/// and in its change; or none. A function of its arguments.
/// Bounds: constant; re-entrant.
/// Result, for every input, NaN in any field included:
///   force finite and |force| <= force_limit_N;
///   |change| <= slew_limit_N_per_s * tick_period_s, except toward zero: faults and a lowered limit
///   reduce the force faster, those of kCutAtOnce at once;
///   a fault is latched in the tick that shows it, and no force is left 10 ms later;
///   enabling while a fault is present gives no force.
StepOutput step(State& state, const Settings& settings, const LocalModel& model,
                const StepInput& input);

}  // namespace firmtouch::servo
