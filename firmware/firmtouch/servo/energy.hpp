#pragma once
#include <float.h>
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::servo {

// Beyond an empty reservoir, before it counts as overdrawn.
constexpr float kOverdraft_J = 0.001f;

// Charge for the work W that encoders hide. A joint is anywhere in its count, so a change of torque
// errs by up to half of h = change x count, of either sign: W is a random walk. For even,
// independent errors exp(s W - sum of s^2 h^2 / 24) is a supermartingale (Ville 1939): with s h^2 /
// 24 charged, contact gives 0.2 mJ more than is counted with a chance of exp(-9) at s = 45,000 / J.
constexpr float kHiddenWork_per_J = 45000.0f / 24.0f;

struct EnergySettings {
  float reservoir_J = 0;
  float friction_N_per_m = 0;  // the device's own viscous friction over the tick's period
};

/// Passivity observer of a spring, of the proxy or of a guide. It may still give to the hand what
/// the hand put into it, less what it gave back, and what is left of the reservoir of all springs.
struct Energy {
  float saved_J = FLT_MAX;       // limited to what the spring stores; below 0: owed
  float stretch_m = 0;           // of the spring in the last tick
  float entered_m = 0;           // growth of the stretch in the last tick
  float payable_m = 0;           // result of the last tick
  math::Vec3 force_N;            // applied since then; the caller sets it
  uint16_t overdrawn_ticks = 0;  // without a break, by more than kOverdraft_J
  bool is_unpaid = false;        // another tick of the last force is not paid for
};

/// Counts the work of the last tick and limits the spring to the energy that is left.
/// The work is exact: between two samples the motors hold the force. `move_m`: of the tool since
/// the last tick. `before_m`: that of the tick before. The device's friction takes the product of
/// both: a square would count an encoder's steps to and fro as motion. `object_J`: the part of the
/// work that a moving object does.
/// `left_J`: of the reservoir. A spring gives from there what it has not saved; energy that it
/// dissipates fills it up, and is not saved beyond it.
/// Result: the largest stretch of the spring. At least `stretch_m` while the reservoir is not
///         empty. From then on
///           no more than holds the available energy;
///           of a tool that leaves, no more than is paid for until the next tick;
///           of a tool that enters, at least the last result and its step, so that contact resists
///             and fills up; not while contact gives energy, as where a tool is turned into it.
///         For NaN, a full reservoir.
/// Bounds: constant; re-entrant for different states.
/// Source: Hannaford and Ryu 2002 (observer); Lee and Huang 2010 (the spring is shortened to its
///         energy: no velocity is used, so that an encoder's steps make no force).
float payable_stretch_m(Energy& energy, float& left_J, const EnergySettings& settings,
                        float stiffness_N_per_m, float stretch_m, math::Vec3 move_m,
                        math::Vec3 before_m, float object_J = 0);

}  // namespace firmtouch::servo
