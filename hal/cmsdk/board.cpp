#include "firmtouch/hal/board.hpp"

#include "cmsdk/cmsdk.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "parts/stack.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kConsoleDivider = kUart_MHz * 1000000 / 115200;

}  // namespace

void board_begin() {
  motors_off();
  reg(kUart0 + kUartDivider) = kConsoleDivider;
  reg(kUart0 + kUartControl) = kTransmitOn;
  clock_begin();
  link_begin();
}

const char* board_name() { return FIRMTOUCH_BOARD_NAME; }

core::Bytes board_asset() { return linked_or_loaded_asset(); }

void board_print(const char* text) {
  if ((reg(kUart0 + kUartControl) & kTransmitOn) == 0) return;  // a fault before board_begin()
  for (; *text != 0; ++text) {
    while ((reg(kUart0 + kUartState) & kTransmitFull) != 0) {
    }
    reg(kUart0 + kUartData) = static_cast<uint8_t>(*text);
  }
}

uint32_t board_stack_high_bytes() { return stack_used_bytes(); }

// At the first time-out the watchdog raises the NMI (fault.cpp switches the motors off and stops);
// at the second it resets the chip.
void watchdog_begin(uint32_t timeout_us) {
  reg(kWatchdog + 0x0) = watchdog_ticks(timeout_us);
  reg(kWatchdog + 0xC) = 1;  // clears a time-out from before the servo ran
  reg(kWatchdog + 0x8) = 3;
}

void watchdog_feed() { reg(kWatchdog + 0xC) = 1; }

}  // namespace firmtouch::hal
