#include "registers.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kRccControl = kRcc + 0x00, kPllOn = 1u << 24, kPllReady = 1u << 25;
constexpr uint32_t kRccClock = kRcc + 0x08;  // b0-1 switch, b2-3 its state, b4-7 divider
constexpr uint32_t kRccPll = kRcc + 0x0C;
constexpr uint32_t kPowerRange = 0x40007080, kNoBoost = 1u << 8;
constexpr uint32_t kPowerPulls = 0x40007008, kNoUsbPulls = 1u << 14;
constexpr uint32_t kFlash = 0x40022000;  // b0-3 wait states, b8 prefetch, b9 and b10 caches

}  // namespace

// 16 MHz / 4 * 85 / 2 = 170 MHz, at half speed for a moment while the regulator is in boost mode
// (RM0440, 6.1.5). PB6 and PB4 have USB's pull-downs of 5 kOhm after reset: an encoder may not beat
// them. Without the flash's other bits no debugger can read it.
void power_begin() {
  switch_on(kRccTimers, 1u << 28);
  reg(kPowerRange) = reg(kPowerRange) & ~kNoBoost;
  reg(kPowerPulls) = reg(kPowerPulls) | kNoUsbPulls;
  reg(kFlash) = (reg(kFlash) & ~0xFu) | 4u | 1u << 8 | 1u << 9 | 1u << 10;
  while ((reg(kFlash) & 0xFu) != 4u) {
  }
  if ((reg(kRccClock) & 0xCu) == 0xCu) return;  // a boot loader did it
  reg(kRccPll) = 2u | 3u << 4 | 85u << 8 | 1u << 24;
  reg(kRccControl) = reg(kRccControl) | kPllOn;
  while ((reg(kRccControl) & kPllReady) == 0) {
  }
  reg(kRccClock) = 3u | 8u << 4;
  while ((reg(kRccClock) & 0xCu) != 0xCu) {
  }
  for (volatile uint32_t wait = 0; wait < 100; wait = wait + 1) {  // over 1 us
  }
  reg(kRccClock) = 3u;
}

}  // namespace firmtouch::hal
