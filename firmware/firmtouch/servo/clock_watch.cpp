#include "firmtouch/servo/clock_watch.hpp"

#include "firmtouch/servo/fault.hpp"

namespace firmtouch::servo {
namespace {

constexpr uint32_t kJump_us = 1000000;
constexpr float kStall = 4.0f;  // periods: the force of one tick was held for too long
constexpr float kEarly = 0.5f;  // periods
constexpr float kShort = 0.8f;  // periods

// ClockState::misses has a field of kTimingWindow bits for each kind of miss. Its lowest bit is of
// this tick.
constexpr uint32_t kLateBit = 1u, kEarlyBit = kLateBit << kTimingWindow,
                   kOverloadBit = kEarlyBit << kTimingWindow;
constexpr uint32_t kFirstBits = kLateBit | kEarlyBit | kOverloadBit;
constexpr uint32_t kFieldMask = kEarlyBit - 1;
constexpr uint32_t kUsedBits = (kOverloadBit << kTimingWindow) - 1;

bool too_many(uint32_t misses) {
  uint32_t count = 0;
  for (uint32_t word = misses & kFieldMask; word != 0; word &= word - 1) ++count;
  return count >= kTimingMisses;
}

uint32_t faults_of(uint32_t misses) {
  uint32_t faults = 0;
  if (too_many(misses)) faults |= kFaultDeadline;
  if (too_many(misses >> kTimingWindow)) faults |= kFaultClock;
  if (too_many(misses >> 2 * kTimingWindow)) faults |= kFaultOverload;
  return faults;
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
  uint32_t missed = overloaded ? kOverloadBit : 0;
  if (elapsed_us < kJump_us) {
    const float elapsed_s = static_cast<float>(elapsed_us) * 1e-6f;
    const bool early = !(elapsed_s >= kEarly * period_s);
    const bool stalled = !(elapsed_s <= kStall * period_s);
    reading.late = !(elapsed_s <= late_ratio * period_s);
    missed |= (reading.late ? kLateBit : 0) | (early ? kEarlyBit : 0);
    state.shorts = elapsed_s < kShort * period_s ? state.shorts + 1 : 0;
    if (state.shorts >= kMaxShorts) reading.faults = kFaultClock;
    if (stalled) reading.faults |= kFaultDeadline;
    reading.dt_s = early ? kEarly * period_s : stalled ? kStall * period_s : elapsed_s;
  } else {
    reading.faults = kFaultClock;
  }
  state.misses = (state.misses << 1 & kUsedBits & ~kFirstBits) | missed;
  if (state.misses != 0) reading.faults |= faults_of(state.misses);
  return reading;
}

void clear(ClockState& state) { state.misses = state.shorts = 0; }

}  // namespace firmtouch::servo
