#pragma once
#include <stdint.h>

// The last stage before the motors. It shares no code with what it guards: it includes nothing of
// Firmtouch, knows no Vec3, no mode and no fault, does no arithmetic on floats, and keeps its own
// memory of what it let through, twice.
namespace firmtouch::servo {

constexpr uint32_t kGuardedMotors = 3;
constexpr uint32_t kGuardArmed =
    0x6A09E667u;  // a pattern that no cleared or flipped word is likely to be

constexpr uint32_t kGuardLimitCount = 3;

// In flash, so that no flipped bit reaches them: limits beyond these let nothing pass, whoever set
// them.
constexpr float kGuardMaxForce_N = 100.0f;
constexpr float kGuardMaxSlew_N_per_s = 1e6f;
constexpr float kGuardMaxPeriod_s = 0.1f;

struct GuardLimits {
  float force_limit_N = 0;
  float slew_limit_N_per_s = 0;
  float tick_period_s = 0;
};

/// Everything that matters is kept twice: a flipped bit of either is noticed. A default one lets no
/// force pass before guard_set_limits().
struct GuardState {
  uint32_t armed = kGuardArmed;                       // any other word: tripped
  uint32_t quiet_ticks = 0;                           // since the motors ought to be dying down
  int32_t passed[kGuardedMotors] = {};                // in units of 2^-16 N
  int32_t complement[kGuardedMotors] = {-1, -1, -1};  // ~passed
  uint32_t limit[kGuardLimitCount] = {};              // bits of GuardLimits' floats, in its order
  uint32_t limit_complement[kGuardLimitCount] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
};

/// Takes limits that somebody set on purpose: at the beginning, and with an accepted command. Not
/// every tick from where servo reads its own: what was hit there must not come here.
/// Result: false, tripped and nothing set, where the guard's memory does not agree with itself.
bool guard_set_limits(GuardState& state, const GuardLimits& limits);
/// The limits that hold.
GuardLimits guard_limits(const GuardState& state);

/// Lets `motor_N` pass as it is, or sets it to zero and trips. Trips where, in this tick,
///   a motor's force is NaN, infinite or 2^14 N and more;
///   it is not zero, and a limit is NaN, negative or beyond its ceiling above;
///   the forces together are more than force_limit_N (and 2^-16 N);
///   an axis grows away from zero by more than slew_limit_N_per_s * tick_period_s (and 0.1 %);
///   `may_push` has been false for more than 10 ms and the force is not yet zero;
///   `cut` is true and the force is not zero;
///   the guard's own memory does not agree with itself.
/// Bounds: integer arithmetic only, a few hundred instructions; re-entrant.
/// Result: true where it passed; once tripped, zero and false until guard_clear().
bool guard(GuardState& state, bool may_push, bool cut, float (&motor_N)[kGuardedMotors]);

/// Arms it again, with the limits that it had. Where those were hit it trips again at once: only a
/// new GuardState, with its limits set, mends that.
void guard_clear(GuardState& state);

}  // namespace firmtouch::servo
