#include "firmtouch/servo/clock_watch.hpp"

#include "firmtouch/servo/fault.hpp"

namespace firmtouch::servo {
namespace {

constexpr uint32_t kJump_us = 1000000;
constexpr float kStall = 4.0f;  // periods: the force of one tick was held for too long
constexpr float kEarly = 0.5f;  // periods
constexpr float kShort = 0.8f;  // periods
constexpr uint32_t kWindowMask = (1u << kTimingWindow) - 1;

// Takes a tick into a history. Result: whether it has too many misses.
bool too_many(uint16_t& history, bool is_missed) {
  history = static_cast<uint16_t>(history << 1 | (is_missed ? 1 : 0));
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
  if (too_many(state.overload_history, overloaded)) reading.faults = kFaultOverload;
  if (elapsed_us >= kJump_us) {
    reading.faults |= kFaultClock;
    return reading;
  }
  const float elapsed_s = static_cast<float>(elapsed_us) * 1e-6f;
  const bool early = !(elapsed_s >= kEarly * period_s);
  const bool stalled = !(elapsed_s <= kStall * period_s);
  reading.late = !(elapsed_s <= late_ratio * period_s);
  const bool is_lost = too_many(state.late_history, reading.late);
  if (stalled || is_lost) reading.faults |= kFaultDeadline;
  state.short_history = state.short_history << 1 | (elapsed_s < kShort * period_s ? 1u : 0u);
  const bool is_broken = too_many(state.early_history, early);
  if (is_broken || state.short_history == UINT32_MAX) reading.faults |= kFaultClock;
  reading.dt_s = early ? kEarly * period_s : stalled ? kStall * period_s : elapsed_s;
  return reading;
}

void clear(ClockState& state) {
  state.late_history = 0;
  state.early_history = 0;
  state.short_history = 0;
  state.overload_history = 0;
}

}  // namespace firmtouch::servo
