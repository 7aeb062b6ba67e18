#include "firmtouch/hal/clock.hpp"

#include "firmtouch/hal/watchdog.hpp"
#include "registers.hpp"

// Timer 0 and the watchdog count microseconds: ticks of the crystal, divided.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kTimerTicks = kTicks + 0x18, kWatchdogTicks = kTicks + 0x30;
constexpr uint32_t kMaxLoad = 0xFFFFFF;

uint32_t g_timeout_us = 0;

void ticks_begin(uint32_t generator) {
  reg(generator + 4) = kCrystal_MHz;
  reg(generator) = 1;
}

}  // namespace

void clock_begin() {
  release(kResetTimer);
  ticks_begin(kTimerTicks);
  cycles_begin();
}

uint32_t clock_us() { return reg(kTimer + 0x28); }

// It resets all but the oscillators, and with the pins the power stage. It runs on in a debug halt.
void watchdog_begin(uint32_t timeout_us) {
  constexpr uint32_t kWhatIsReset = kPower + 0x8, kOscillators = 3u << 2, kOn = 1u << 30;
  g_timeout_us = timeout_us < kMaxLoad ? timeout_us : kMaxLoad;
  ticks_begin(kWatchdogTicks);
  watchdog_feed();
  reg(kWhatIsReset) = 0x01FFFFFF & ~kOscillators;
  reg(kWatchdog) = kOn;
}

void watchdog_feed() { reg(kWatchdog + 0x4) = g_timeout_us; }

bool watchdog_has_reset() { return (reg(kWatchdog + 0x8) & 1u) != 0; }  // the next reset clears it

}  // namespace firmtouch::hal
