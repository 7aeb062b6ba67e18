#pragma once
#include <stdint.h>

namespace firmtouch::servo {

// So many late (or early, or overloaded) ticks of the last 10 are a fault. After a single late tick
// the measured time is used, without a fault.
constexpr uint32_t kTimingWindow = 10;
constexpr uint32_t kTimingMisses = 3;
constexpr uint32_t kMaxShorts = 32;  // of another rate than the parameter's
// Periods. From here on the main loop has next to no time: a tick is entered and left in the rest.
constexpr float kMaxLoad = 0.9f;

struct ClockState {
  bool started = false;
  uint32_t last_us = 0;
  uint32_t misses = 0;  // kTimingWindow bits each: late, early, overloaded; bit k: the tick k ago
  uint32_t shorts = 0;  // short ticks in succession
};

struct ClockReading {
  float dt_s = 0;  // measured, within half a period and four
  bool late = false;
  uint32_t faults = 0;  // kFaultDeadline, kFaultClock, kFaultOverload
};

/// Measures the time since the last tick, on a clock that wraps at 32 bits, and checks that the
/// loop keeps its period and that the tick before, which took `last_work_us`, left time to the rest
/// of the program.
///   late:  more than late_ratio periods. 3 of 10: kFaultDeadline. Four periods or more: at once.
///   early: less than half a period (a tick that came twice, a clock that stands).
///          3 of 10: kFaultClock.
///   short: less than 0.8 periods, as where the timer's rate is not that of the parameter.
///          kMaxShorts in succession: kFaultClock.
///   overloaded: the tick before took kMaxLoad periods or more. 3 of 10: kFaultOverload.
///   a second or more, which a clock set back also looks like: kFaultClock at once.
/// Pre: period_s and late_ratio within their ranges of params; others give finite results too.
/// Bounds: constant; re-entrant.
/// Result: the first tick, and one with a broken clock, gets the nominal period.
ClockReading watch_clock(ClockState& state, uint32_t clock_us, uint32_t last_work_us,
                         float period_s, float late_ratio);

/// Forgets past misses, so that a cleared fault does not come back by itself.
void clear(ClockState& state);

}  // namespace firmtouch::servo
