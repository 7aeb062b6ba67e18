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

uint32_t mantissa_of(uint32_t word) { return (word & 0x7FFFFFu) | 0x800000u; }

// The torque in a unit in which the continuous one is from 2^11 to 2^12; 2^21 if it is that or
// more, and for NaN. Pre: `continuous` is a float of 2^-126 to 2^10.
uint32_t load_of(float motor_Nm, uint32_t continuous) {
  const uint32_t word = word_of(motor_Nm) & 0x7FFFFFFFu;
  const int32_t larger =  // by a power of 2
      static_cast<int32_t>(word >> 23) - static_cast<int32_t>(continuous >> 23);
  if (larger > 9) return 1u << 21;
  if (larger < -11 || (word >> 23) == 0) return 0;
  return mantissa_of(word) >> (12 - larger);
}

// 1 / time in units of 2^-28 / s; 0 if it is not of 1/16 to 2^14 s. Time = mantissa *
// 2^(exponent - 142), and inverse = 2^32 / mantissa is below 2^17.
uint32_t rate_of(float time_s) {
  const uint32_t word = word_of(time_s), exponent = word >> 23;
  if (exponent < 123 || exponent > 140) return 0;
  const uint32_t inverse = UINT32_MAX / (mantissa_of(word) >> 8);
  return exponent <= 138 ? inverse << (138 - exponent) : inverse >> (exponent - 138);
}

bool remembers(const HeatGuard& heat, uint32_t k) {
  return heat.value.continuous[k] == ~heat.complement.continuous[k] &&
         heat.value.rate[k] == ~heat.complement.rate[k] &&
         heat.value.heat[k] == ~heat.complement.heat[k];
}

// Heat is in units of 2^-28 squares of torque, shares in units of 2^-40. No product overflows:
// torque < 2^21, share <= 2^38, rise < 2^41; heat < 2^53, since it is at most what may be.
bool may_heat(HeatGuard& heat, uint32_t k, float motor_Nm, uint32_t period) {
  if (!remembers(heat, k)) return false;
  const uint32_t continuous = heat.value.continuous[k], rate = heat.value.rate[k];
  if (continuous == 0) return true;
  if ((continuous >> 23) == 0 || continuous > word_of(kGuardMaxTorque_Nm) || rate == 0)
    return false;
  const uint32_t torque = load_of(motor_Nm, continuous), unit = mantissa_of(continuous) >> 12;
  if (torque >= (1u << 21)) return false;
  constexpr uint64_t kMaxShare = uint64_t{1} << 38;
  const uint64_t even = (uint64_t{period} * rate) >> 16;
  const uint64_t early = even < kMaxShare ? even : kMaxShare;
  // Not above that of a backward step, early / (1 + early), by which the device counts.
  const uint32_t root = static_cast<uint32_t>(early >> 20);
  const uint64_t share = early - uint64_t{root} * root;
  const uint64_t rise = (torque * share) >> 12;
  if (rise >= (uint64_t{1} << 41)) return false;
  const uint64_t before = heat.value.heat[k];
  const uint64_t after = before + rise * torque - (((before >> 28) * share) >> 12);
  if (torque != 0 && after > uint64_t{unit * unit * 17} << 24) return false;
  heat.value.heat[k] = after;
  heat.complement.heat[k] = ~after;
  return true;
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

[[gnu::cold]] void set_heat(HeatGuard& heat, const float (&continuous_Nm)[kGuardedMotors],
                            const float (&time_s)[kGuardedMotors]) {
  for (uint32_t k = 0; k < kGuardedMotors; ++k) {
    HeatGuard::Copy& value = heat.value;
    value.continuous[k] = word_of(continuous_Nm[k]);
    value.rate[k] = rate_of(time_s[k]);
    const uint32_t unit = mantissa_of(value.continuous[k]) >> 12;
    value.heat[k] = uint64_t{unit * unit} << 28;
    heat.complement.continuous[k] = ~value.continuous[k];
    heat.complement.rate[k] = ~value.rate[k];
    heat.complement.heat[k] = ~value.heat[k];
  }
}

[[gnu::cold]] bool guard_heat(GuardState& state, HeatGuard& heat,
                              float (&motor_Nm)[kGuardedMotors]) {
  const float period_s = guard_limits(state).tick_period_s;
  bool is_good = is_up_to(period_s, kGuardMaxPeriod_s);
  const uint32_t period = is_good ? static_cast<uint32_t>(fixed_point(period_s, 28)) : 0;
  for (uint32_t k = 0; k < kGuardedMotors; ++k)
    is_good = may_heat(heat, k, motor_Nm[k], period) && is_good;
  return is_good || end_guard(state, {}, false, motor_Nm);
}

[[gnu::cold]] void guard_clear(GuardState& state) {
  if (remembers(state)) return;  // torques may still fall
  GuardState armed;
  for (uint32_t k = 0; k < kGuardLimitCount; ++k) {
    armed.limit[k] = state.limit[k];
    armed.limit_complement[k] = state.limit_complement[k];
  }
  state = armed;
}

}  // namespace firmtouch::servo
