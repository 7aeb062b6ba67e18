#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// Effects: viscosity, speed wall, detents, attraction, vibration. Several at once, beside a guide:
// scene/effect_sum.hpp. add_...() puts one alone in the model, instead of a guide.
// An effect with a setting out of range, or with NaN, makes no force.
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

/// Force along the direction. It is 0 before the start and after the end. The tick may wrap between
/// them, unless rise, hold or fall is 2^31 ticks or more. The phase is counted in 2^-32 cycles,
/// without a sum that rounds: at any time it is that of cycles_a_tick to 2^-33 a tick.
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

/// Force of an effect that stores energy, and how much of it, at least 0. The force is minus the
/// slope of the potential: a closed loop gives no energy.
struct EffectForce {
  math::Vec3 force_N;
  float potential_J = 0;
};

/// As add_attraction() without its damper, for an EffectSum. Beyond its reach the potential stays
/// what it is there.
/// Bounds: about 140 instructions.
EffectForce attraction_at(const Attraction& attraction, math::Vec3 position_m);

/// Notches along a line, one every `pitch_m`: force = -limit sin(2 pi x / pitch), with x from the
/// notch at `notch_m` along the direction.
struct Detents {
  math::Vec3 notch_m;    // device frame
  math::Vec3 direction;  // unit
  float pitch_m = 0;     // 1e-6 up
  float limit_N = 0;     // 0 to servo::kMaxDriveLimit_N
};

/// Bounds: about 220 instructions. Error: that of x, which rounds as the position does, and 1e-6 of
/// the limit. No force beyond 1e6 notches.
EffectForce detents_at(const Detents& detents, math::Vec3 position_m);

/// Notches around an axis, such as of a knob. The potential is
/// 2 limit / count sin(count angle / 2)^2 w, with w the distance r from the axis less core_m / 2,
/// and r^2 / (2 core_m) within core_m. So the force around is limit sin(count angle), whatever r,
/// and fades within core_m; between notches it also points to the axis.
struct DetentRing {
  math::Vec3 centre_m;  // device frame
  math::Vec3 axis;      // unit
  math::Vec3 notch;     // unit, across the axis: from the centre to a notch
  uint32_t count = 0;   // 2 to 1000
  float core_m = 0;     // 1e-6 up
  float limit_N = 0;    // 0 to servo::kMaxDriveLimit_N
};

/// Bounds: about 390 instructions. Error: 1e-6 of the limit, and 2e-7 count of it. The force is at
/// most 1.16 limit.
EffectForce detents_at(const DetentRing& ring, math::Vec3 position_m);

/// A damper in all directions, of limited force.
struct Viscosity {
  float damping_N_s_per_m = 0;  // 0 to servo::kMaxDamping_N_s_per_m
  float limit_N = 0;            // 0 to servo::kMaxDriveLimit_N
};

/// Force against the velocity: min(damping x speed, limit). It gives no energy on any way.
/// Bounds: about 100 instructions.
math::Vec3 viscous_N(const Viscosity& viscosity, math::Vec3 velocity_mps);

/// A wall in speed: free up to `free_mps`, and a damper of what the speed exceeds it by.
struct SpeedWall {
  float free_mps = 0;  // 0 to servo::kMaxVelocity_mps
  Viscosity beyond;
};

/// Force against the velocity: min(damping x (speed - free), limit). It gives no energy on any way.
/// Bounds: about 90 instructions.
math::Vec3 speed_wall_N(const SpeedWall& wall, math::Vec3 velocity_mps);

}  // namespace firmtouch::scene
