#pragma once
#include <stdint.h>

// The last stage before the motors. It shares no code with what it guards: it includes nothing of
// Firmtouch, knows no Vec3, no mode and no fault, does no arithmetic on floats, and keeps its own
// memory of what it let through, twice.
namespace firmtouch::servo {

constexpr uint32_t kGuardedMotors = 3;
constexpr uint32_t kGuardArmed =
    0x6A09E667u;  // a pattern that no cleared or flipped word is likely to be

/// Bits of floats as the parameters hold them.
struct GuardLimits {
  float force_limit_N = 0;
  float slew_limit_N_per_s = 0;
  float tick_period_s = 0;
};

struct GuardState {
  uint32_t armed = kGuardArmed;                       // any other word: tripped
  uint32_t quiet_ticks = 0;                           // since the motors ought to be dying down
  int32_t passed[kGuardedMotors] = {};                // in units of 2^-16 N
  int32_t complement[kGuardedMotors] = {-1, -1, -1};  // ~passed: a flipped bit of either is noticed
};

/// Lets `motor_N` pass as it is, or sets it to zero and trips. Trips where, in this tick,
///   a motor's force is NaN, infinite or 2^14 N and more, or a limit is;
///   the forces together are more than force_limit_N (and 2^-16 N);
///   an axis grows away from zero by more than slew_limit_N_per_s * tick_period_s (and 0.1 %);
///   `may_push` has been false for more than 10 ms and the force is not yet zero;
///   `cut` is true and the force is not zero;
///   the guard's own memory does not agree with itself.
/// Bounds: integer arithmetic only, about 150 instructions; re-entrant.
/// Result: true where it passed; once tripped, zero and false until guard_clear().
bool guard(GuardState& state, const GuardLimits& limits, bool may_push, bool cut,
           float (&motor_N)[kGuardedMotors]);

void guard_clear(GuardState& state);

}  // namespace firmtouch::servo
