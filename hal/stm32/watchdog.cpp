#include "firmtouch/hal/watchdog.hpp"

#include "registers.hpp"

// The independent watchdog resets the chip, and with it every pin of the power stage. It counts 12
// bits at 125 us a tick (its own 32 kHz oscillator, divided by 4). A new reload is taken five of
// its cycles after the last. QEMU ignores it.
namespace firmtouch::hal {

void watchdog_begin(uint32_t timeout_us) {
  constexpr uint32_t kTick_us = 125, kMaxTicks = 4095;
  const uint32_t ticks = timeout_us / kTick_us + 1;
  reg(kWatchdog + 0x0) = 0xCCCC;  // start
  reg(kWatchdog + 0x0) = 0x5555;  // unlock
  reg(kWatchdog + 0x4) = 0;
  reg(kWatchdog + 0x8) = ticks < kMaxTicks ? ticks : kMaxTicks;
  watchdog_feed();
}

void watchdog_feed() { reg(kWatchdog + 0x0) = 0xAAAA; }

bool watchdog_has_reset() {
  const bool has = (reg(kResetCause) & kByWatchdog) != 0;
  reg(kResetCause) = reg(kResetCause) | kForgetCause;
  return has;
}

}  // namespace firmtouch::hal
