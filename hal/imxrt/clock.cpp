#include "firmtouch/hal/clock.hpp"

#include "firmtouch/hal/watchdog.hpp"
#include "registers.hpp"

namespace firmtouch::hal {

// The crystal's 24 MHz / 12 / 2.
void clock_begin() {
  switch_on(kGateTimer);
  switch_on(kGateTimerInput);
  reg(kTimer + 0x0) = 0;
  reg(kTimer + 0x4) = 11u << 12 | 1u;
  reg(kTimer + 0x0) = 1u << 10 | 1u << 9 | 5u << 6 | 1u << 3 | 1u;  // free-running
  cycles_begin();
}

uint32_t clock_us() { return reg(kTimer + 0x24); }

// Watchdog 3 counts 16 bits of its own 32 kHz oscillator, also in a debug halt that stops the core.
// It is set up in a few of its ticks behind the key, and resets the chip, and with it every pin.
void watchdog_begin(uint32_t timeout_us) {
  constexpr uint32_t kState = kWatchdog + 0x0, kCount = kWatchdog + 0x4, kLimit = kWatchdog + 0x8;
  constexpr uint32_t kWords = 1u << 13, kUnlocked = 1u << 11, kDone = 1u << 10, kOn = 1u << 7,
                     kOwnClock = 1u << 8, kMayChange = 1u << 5, kAlways = 3u << 1;
  constexpr uint32_t kTick_us = 31, kMaxTicks = 0xFFFF;
  const uint32_t ticks = timeout_us / kTick_us + 1;
  const CriticalSection alone;  // the key is valid for a moment
  switch_on(kGateWatchdog);
  if ((reg(kState) & kWords) != 0) {
    reg(kCount) = 0xD928C520;
  } else {
    reg(kCount) = 0xC520;
    reg(kCount) = 0xD928;
  }
  while ((reg(kState) & kUnlocked) == 0) {
  }
  reg(kLimit) = ticks < kMaxTicks ? ticks : kMaxTicks;
  reg(kState) = kWords | kOwnClock | kOn | kMayChange | kAlways;
  while ((reg(kState) & kDone) == 0) {
  }
}

void watchdog_feed() { reg(kWatchdog + 0x4) = 0xB480A602; }

bool watchdog_has_reset() {
  constexpr uint32_t kResetCause = 0x400F8008, kByWatchdog3 = 1u << 7;
  const bool has = (reg(kResetCause) & kByWatchdog3) != 0;
  reg(kResetCause) = kByWatchdog3;  // written ones clear
  return has;
}

}  // namespace firmtouch::hal
