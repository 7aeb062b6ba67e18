#pragma once
#include <stdint.h>

// The last stage before the motors. It shares no code with what it guards: it includes nothing of
// Firmtouch, has no Vec3, mode or fault, uses integer arithmetic only, and keeps its own copy of
// limits and last forces, twice.
namespace firmtouch::servo {

constexpr uint32_t kGuardedMotors = 3;
constexpr uint32_t kGuardArmed = 0x6A09E667u;  // unlikely in a cleared or corrupted word

constexpr uint32_t kGuardLimitCount = 3;

// In flash, where no flipped bit of RAM reaches them. With limits beyond these no force passes.
constexpr float kGuardMaxForce_N = 100.0f;
constexpr float kGuardMaxSlew_N_per_s = 1e6f;
constexpr float kGuardMaxPeriod_s = 0.1f;
constexpr float kGuardMaxTorque_Nm = 1000.0f;

struct GuardLimits {
  float force_limit_N = 0;
  float slew_limit_N_per_s = 0;
  float tick_period_s = 0;
};

/// Limits and last forces are kept twice, so a flipped bit is detected. By default no force passes
/// before guard_set_limits().
struct GuardState {
  uint32_t armed = kGuardArmed;                       // any other word: tripped
  uint32_t quiet_ticks = 0;                           // since the motors should be off
  int32_t passed[kGuardedMotors] = {};                // in units of 2^-16 N
  int32_t complement[kGuardedMotors] = {-1, -1, -1};  // ~passed
  uint32_t limit[kGuardLimitCount] = {};              // bits of GuardLimits' floats, in its order
  uint32_t limit_complement[kGuardLimitCount] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
};

/// Sets the limits: at the beginning, and with an accepted command. Do not copy them every tick
/// from servo's settings, because a flipped bit there must not reach the guard.
/// Result: false, tripped and nothing set, if the guard's memory is inconsistent.
bool guard_set_limits(GuardState& state, const GuardLimits& limits);
/// The limits that hold.
GuardLimits guard_limits(const GuardState& state);

/// Passes `motor_N` unchanged, or sets it to zero and trips. It trips if, in this tick,
///   a motor's force is NaN, infinite or 2^14 N and more;
///   it is not zero, and a limit is NaN, negative or beyond its ceiling above;
///   the forces together are more than force_limit_N (and 2^-16 N);
///   an axis grows away from zero by more than slew_limit_N_per_s * tick_period_s (and 0.1 %);
///   `may_push` has been false for more than 10 ms and the force is not yet zero;
///   `cut` is true and the force is not zero;
///   the guard's own memory is inconsistent.
/// Bounds: integer arithmetic only, a few hundred instructions; re-entrant.
/// Result: true if it passed; once tripped, zero and false until guard_clear().
bool guard(GuardState& state, bool may_push, bool cut, float (&motor_N)[kGuardedMotors]);

/// The torques of a linkage's joints: of each the largest, and the time in which all rise to it
/// from 0. Kept twice. By default no torque passes.
struct TorqueCeilings {
  uint32_t word[kGuardedMotors + 1] = {};  // bits of the floats; the time is the last
  uint32_t complement[kGuardedMotors + 1] = {};
};

/// When an asset is opened, and not again.
void set_ceilings(TorqueCeilings& ceilings, const float (&max_torque_Nm)[kGuardedMotors],
                  float rise_s);

/// As guard(), for torques: it trips where a joint exceeds its ceiling (by 2^-16 N m) or grows away
/// from 0 by more than ceiling * tick_period_s / rise_s (and 0.1 %), where a ceiling is beyond
/// kGuardMaxTorque_Nm, and where a copy of a ceiling differs.
bool guard_torques(GuardState& state, const TorqueCeilings& ceilings, bool may_push, bool cut,
                   float (&motor_Nm)[kGuardedMotors]);

/// Heat of the windings of a linkage's joints by I squared t, from what passes the guard. Kept
/// twice. By default no torque passes.
struct HeatGuard {
  struct Copy {
    uint32_t continuous[kGuardedMotors] = {};  // bits of the floats; 0: no thermal limit
    uint32_t rate[kGuardedMotors] = {};        // 1 / thermal time, in units of 2^-28 / s
    uint64_t heat[kGuardedMotors] = {};        // in units of continuous torque^2 / 2^50 to 2^52
  };
  Copy value, complement;
};

/// When an asset is opened, and after a reset: the torque that each motor may have for ever, and
/// its winding's thermal time. The windings are hot.
void set_heat(HeatGuard& heat, const float (&continuous_Nm)[kGuardedMotors],
              const float (&time_s)[kGuardedMotors]);

/// After guard_torques(), in every tick. With x' = (torque^2 - x) / thermal time it trips, and no
/// torque passes, where a torque would end the tick with x above 17/16 of the continuous torque's
/// square. It trips, too, where a limit is not of 0 to kGuardMaxTorque_Nm, a time is not of 1/16 to
/// 2^14 s, and where a copy differs. A tick counts as tick_period_s, at most a quarter of a time.
/// Result: false if it stopped a torque.
/// Error: x within 0.2 % and tick_period_s / (2 time), with torques held during a tick.
bool guard_heat(GuardState& state, HeatGuard& heat, float (&motor_Nm)[kGuardedMotors]);

/// Arms it again with its limits; without effect where it did not trip. If the limits were
/// corrupted it trips again at once; then only a new GuardState with its limits set helps.
void guard_clear(GuardState& state);

}  // namespace firmtouch::servo
