#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

// What the boot ROM looks for in the first 4 KB of flash (datasheet, 5.9): an image that runs in
// secure state on the Arm cores of an RP2350, from the vectors first in flash.
[[gnu::section(".boot_block"), gnu::used]] const uint32_t kImageDefinition[] = {
    0xFFFFDED3,   // begin
    0x10210142,   // image type: executable, secure, Arm, RP2350
    0x000001FF,   // last item: one word before it
    0,            // no further block
    0xAB123579};  // end

constexpr uint32_t kReferenceClock = kClocks + 0x30, kCoreClock = kClocks + 0x3C,
                   kUartClock = kClocks + 0x48;
constexpr uint32_t kSelected = 0x8;  // one bit a source

void select(uint32_t clock, uint32_t source) {
  reg(clock) = source;
  while ((reg(clock + kSelected) & 1u << source) == 0) {
  }
}

}  // namespace

// 12 MHz * 125 / 5 / 2 = 150 MHz for core, pulses and UARTs; flash as the boot ROM left it.
void power_begin() {
  reg(kCrystal + 0xC) = 47;  // start-up: 1 ms
  reg(kCrystal) = 0xAA0 | 0xFABu << 12;
  while ((reg(kCrystal + 0x4) & 1u << 31) == 0) {
  }
  select(kCoreClock, 0);  // the reference, which is the crystal then
  select(kReferenceClock, 2);
  reg(kResets + kSet) = kResetPll;
  release(kResetPll);
  reg(kPll + 0x0) = 1;
  reg(kPll + 0x8) = 125;
  reg(kPll + 0x4 + kClear) = 1u << 0 | 1u << 5;  // power down: all, oscillator
  while ((reg(kPll + 0x0) & 1u << 31) == 0) {
  }
  reg(kPll + 0xC) = 5u << 16 | 2u << 12;
  reg(kPll + 0x4 + kClear) = 1u << 3;  // divider
  select(kCoreClock, 1);
  reg(kUartClock) = 1u << 11;
}

void board_begin() {
  motors_off();
  power_begin();
  pin_as(kConsolePin, kUartFunction);
  for (const Pin& pin : kLinkPins) pin_as(pin, kUartFunction, kPullUp);
  peripherals_begin();
}

// With its FIFO: an interrupt from four bytes on, or 32 bits behind the last.
void uart_begin(uint32_t uart, uint32_t baud, bool receives) {
  const uint32_t divider = kCore_MHz * 4000000 / baud;  // 16 samples a bit, in 64ths
  release(uart == kUart0 ? kResetUart0 : kResetUart1);
  reg(uart + kUartDivider) = divider >> 6;
  reg(uart + kUartFraction) = divider & 63u;
  reg(uart + kUartLine) = 3u << 5 | 1u << 4;
  reg(uart + kUartLevel) = 0;
  reg(uart + kUartInterrupts) = receives ? 1u << 4 | 1u << 6 : 0;
  reg(uart + kUartControl) = 1u << 0 | 1u << 8 | (receives ? 1u << 9 : 0);
}

}  // namespace firmtouch::hal
