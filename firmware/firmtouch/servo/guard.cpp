#include "firmtouch/servo/guard.hpp"

namespace firmtouch::servo {
namespace {

constexpr uint32_t kTripped = 0;
constexpr uint64_t kNaN = UINT64_MAX;

uint32_t word_of(float value) {
  uint32_t word;
  __builtin_memcpy(&word, &value, sizeof word);
  return word;
}

float float_of(uint32_t word) {
  float value;
  __builtin_memcpy(&value, &word, sizeof value);
  return value;
}

// |value| in units of 2^-fraction, digits below cut off; kNaN from 2^(62 - fraction) on, and
// for NaN.
uint64_t fixed_point(float value, uint32_t fraction) {
  const uint32_t word = word_of(value) & 0x7FFFFFFFu;
  const uint32_t exponent = word >> 23;
  if (exponent == 0) return 0;  // denormals: less than 2^-126
  const uint64_t mantissa = (word & 0x7FFFFFu) | 0x800000u;
  // value = mantissa * 2^(exponent - 150)
  const int32_t shift = static_cast<int32_t>(exponent + fraction) - 150;
  if (shift >= 39) return kNaN;
  if (shift >= 0) return mantissa << shift;
  return shift > -24 ? mantissa >> -shift : 0;
}

bool is_negative(float value) { return (word_of(value) >> 31) != 0; }

// Of 0 to `most`: the bits of floats that are not negative are in the order of their values.
bool is_up_to(float value, float most) { return word_of(value) <= word_of(most); }

bool are_sane(const GuardLimits& limits) {
  return is_up_to(limits.force_limit_N, kGuardMaxForce_N) &&
         is_up_to(limits.slew_limit_N_per_s, kGuardMaxSlew_N_per_s) &&
         is_up_to(limits.tick_period_s, kGuardMaxPeriod_s);
}

// Units of 2^-16 N that a force may grow by in a tick. Sane limits keep the product within 64 bits.
uint64_t largest_growth(const GuardLimits& limits) {
  const uint64_t slew = fixed_point(limits.slew_limit_N_per_s, 16);
  const uint64_t period = fixed_point(limits.tick_period_s, 28);
  const uint64_t growth = (slew * period) >> 28;
  return growth + (growth >> 10) + 2;
}

bool remembers_limits(const GuardState& state) {
  for (uint32_t k = 0; k < kGuardLimitCount; ++k) {
    if (state.limit[k] != ~state.limit_complement[k]) return false;
  }
  return true;
}

bool remembers(const GuardState& state) {
  if (state.armed != kGuardArmed || !remembers_limits(state)) return false;
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    if (state.passed[k] != ~state.complement[k]) return false;
  }
  return true;
}

uint64_t size_of(int32_t force) {
  const int64_t wide = force;
  return static_cast<uint64_t>(wide < 0 ? -wide : wide);
}

// Away from 0.
uint64_t growth_of(int32_t before, int32_t now) {
  const uint64_t from = (now < 0) == (before < 0) ? size_of(before) : 0;
  return size_of(now) > from ? size_of(now) - from : 0;
}

bool is_in_limits(const GuardState& state, const GuardLimits& limits,
                  const int32_t (&force)[kGuardedMotors]) {
  if (!are_sane(limits)) return false;
  const uint64_t limit = fixed_point(limits.force_limit_N, 16) + 1;
  const uint64_t growth = largest_growth(limits);
  uint64_t squares = 0;
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    const int64_t now = force[k];
    squares += static_cast<uint64_t>(now * now);
    if (growth_of(state.passed[k], force[k]) > growth) return false;
  }
  return squares <= limit * limit;
}

bool is_in_ceilings(const GuardState& state, const GuardLimits& limits,
                    const TorqueCeilings& ceilings, const int32_t (&torque)[kGuardedMotors]) {
  if (!are_sane(limits)) return false;
  for (uint32_t k = 0; k <= kGuardedMotors; ++k)
    if (ceilings.word[k] != ~ceilings.complement[k]) return false;
  const uint64_t rise = fixed_point(float_of(ceilings.word[kGuardedMotors]), 28);
  if (rise == 0 || rise > fixed_point(1, 28)) return false;
  const uint64_t period = fixed_point(limits.tick_period_s, 28);
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    const float largest = float_of(ceilings.word[k]);
    if (!is_up_to(largest, kGuardMaxTorque_Nm)) return false;
    const uint64_t ceiling = fixed_point(largest, 16);
    if (size_of(torque[k]) > ceiling + 1) return false;
    // Growth / (ceiling with 0.1 % and 2 units) <= period / rise, without a division.
    const uint64_t most = (ceiling + (ceiling >> 10)) * period + 2 * rise;
    if (growth_of(state.passed[k], torque[k]) * rise > most) return false;
  }
  return true;
}

bool is_quiet_in_time(GuardState& state, const GuardLimits& limits, bool may_push, bool cut,
                      bool is_zero) {
  if (may_push) {
    state.quiet_ticks = 0;
  } else if (state.quiet_ticks < UINT32_MAX) {
    ++state.quiet_ticks;
  }
  if (is_zero) return true;
  if (cut) return false;
  // 10 ms in units of 2^-28 s; the first tick always may die down.
  if (state.quiet_ticks <= 1) return true;
  return are_sane(limits) &&
         fixed_point(limits.tick_period_s, 28) * (state.quiet_ticks - 1u) <= 2684354u;
}

// What the guards have in common: a tick's forces in fixed point, and whether the guard's memory,
// numbers and time allow them.
struct Forces {
  int32_t force[kGuardedMotors] = {};
  bool is_good, is_zero = true;
};

Forces begin_guard(GuardState& state, const GuardLimits& limits, bool may_push, bool cut,
                   const float (&motor_N)[kGuardedMotors]) {
  Forces now;
  now.is_good = remembers(state);
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    const uint64_t size = fixed_point(motor_N[k], 16);
    if (size >= (1u << 30)) {
      now.is_good = false;
    } else {
      now.force[k] = static_cast<int32_t>(size);
      if (is_negative(motor_N[k])) now.force[k] = -now.force[k];
    }
    now.is_zero = now.is_zero && (word_of(motor_N[k]) & 0x7FFFFFFFu) == 0;
  }
  now.is_good = is_quiet_in_time(state, limits, may_push, cut, now.is_zero) && now.is_good;
  return now;
}

// noinline: it stands in both guards.
[[gnu::noinline]] bool end_guard(GuardState& state, const Forces& now, bool is_good,
                                 float (&motor_N)[kGuardedMotors]) {
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    if (!is_good) motor_N[k] = 0;
    state.passed[k] = is_good ? now.force[k] : 0;
    state.complement[k] = ~state.passed[k];
  }
  if (!is_good) state.armed = kTripped;
  return is_good;
}

}  // namespace

[[gnu::cold]] bool guard_set_limits(GuardState& state, const GuardLimits& limits) {
  if (!remembers_limits(state)) {
    state.armed = kTripped;
    return false;
  }
  const float value[kGuardLimitCount] = {limits.force_limit_N, limits.slew_limit_N_per_s,
                                         limits.tick_period_s};
  for (uint32_t k = 0; k < kGuardLimitCount; ++k) {
    state.limit[k] = word_of(value[k]);
    state.limit_complement[k] = ~state.limit[k];
  }
  return true;
}

GuardLimits guard_limits(const GuardState& state) {
  return {float_of(state.limit[0]), float_of(state.limit[1]), float_of(state.limit[2])};
}

bool guard(GuardState& state, bool may_push, bool cut, float (&motor_N)[kGuardedMotors]) {
  const GuardLimits limits = guard_limits(state);
  const Forces now = begin_guard(state, limits, may_push, cut, motor_N);
  const bool is_good = now.is_good && (now.is_zero || is_in_limits(state, limits, now.force));
  return end_guard(state, now, is_good, motor_N);
}

void set_ceilings(TorqueCeilings& ceilings, const float (&max_torque_Nm)[kGuardedMotors],
                  float rise_s) {
  for (uint32_t k = 0; k <= kGuardedMotors; ++k) {
    ceilings.word[k] = word_of(k < kGuardedMotors ? max_torque_Nm[k] : rise_s);
    ceilings.complement[k] = ~ceilings.word[k];
  }
}

[[gnu::cold]] bool guard_torques(GuardState& state, const TorqueCeilings& ceilings, bool may_push,
                                 bool cut, float (&motor_Nm)[kGuardedMotors]) {
  const GuardLimits limits = guard_limits(state);
  const Forces now = begin_guard(state, limits, may_push, cut, motor_Nm);
  const bool is_good =
      now.is_good && (now.is_zero || is_in_ceilings(state, limits, ceilings, now.force));
  return end_guard(state, now, is_good, motor_Nm);
}

[[gnu::cold]] void guard_clear(GuardState& state) {
  GuardState armed;
  for (uint32_t k = 0; k < kGuardLimitCount; ++k) {
    armed.limit[k] = state.limit[k];
    armed.limit_complement[k] = state.limit_complement[k];
  }
  state = armed;
}

}  // namespace firmtouch::servo
