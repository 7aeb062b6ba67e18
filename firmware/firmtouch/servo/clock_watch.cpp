#include "firmtouch/servo/clock_watch.hpp"

#include "firmtouch/servo/fault.hpp"

namespace firmtouch::servo {
namespace {

constexpr uint32_t kJump_us = 1000000;
constexpr float kStall = 4.0f;  // periods: the force of one tick was held for too long
constexpr float kEarly = 0.5f;  // periods
constexpr uint32_t kWindowMask = (1u << kTimingWindow) - 1;

bool too_many(uint32_t history) {
  uint32_t misses = 0;
  for (uint32_t word = history & kWindowMask; word != 0; word &= word - 1) ++misses;
  return misses >= kTimingMisses;
}

}  // namespace

ClockReading watch_clock(ClockState& state, uint32_t clock_us, uint32_t last_work_us,
                         float period_s, float late_ratio) {
  ClockReading reading;
  reading.dt_s = period_s;
  const uint32_t elapsed_us = clock_us - state.last_us;  // modulo 2^32, so a wrap is no event
  state.last_us = clock_us;
  if (!state.started) {
    state.started = true;
    return reading;
  }
  const bool overloaded = !(static_cast<float>(last_work_us) * 1e-6f < kMaxLoad * period_s);
  state.overload_history = state.overload_history << 1 | (overloaded ? 1u : 0u);
  if (too_many(state.overload_history)) reading.faults = kFaultOverload;
  if (elapsed_us >= kJump_us) {
    reading.faults |= kFaultClock;
    return reading;
  }
  const float elapsed_s = static_cast<float>(elapsed_us) * 1e-6f;
  const bool early = !(elapsed_s >= kEarly * period_s);
  const bool stalled = !(elapsed_s <= kStall * period_s);
  reading.late = !(elapsed_s <= late_ratio * period_s);
  state.late_history = state.late_history << 1 | (reading.late ? 1u : 0u);
  state.early_history = state.early_history << 1 | (early ? 1u : 0u);
  if (stalled || too_many(state.late_history)) reading.faults |= kFaultDeadline;
  if (too_many(state.early_history)) reading.faults |= kFaultClock;
  reading.dt_s = early ? kEarly * period_s : stalled ? kStall * period_s : elapsed_s;
  return reading;
}

void clear(ClockState& state) {
  state.late_history = 0;
  state.early_history = 0;
  state.overload_history = 0;
}

}  // namespace firmtouch::servo
