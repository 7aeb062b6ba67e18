#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

extern "C" {
void link_handler();
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kConsoleBaud = 115200;

struct BoardVectors {
  Handler unused[kLinkInterrupt];  // not enabled
  Handler link;
};

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors kBoardVectors = {{}, link_handler};

}  // namespace

void board_begin() {
  motors_off();
  power_begin();
  switch_on(kRccPorts, kPorts);
  switch_on(kRccTimers, kTimersAndUsarts);
  switch_on(kRccTimer1, kTimer1Clock);
  pin_alternate(kConsolePin);
  reg(kConsole + kUsartDivider) = kUsart_MHz * 1000000 / kConsoleBaud;
  reg(kConsole + kUsartControl) = kUsartOn | kTransmitOn;
  motors_begin();
  encoders_begin();
  clock_begin();
  link_begin();
}

const char* board_name() { return FIRMTOUCH_BOARD_NAME; }

core::Bytes board_asset() { return linked_or_loaded_asset(); }

void board_print(const char* text) {
  if ((reg(kConsole + kUsartControl) & kTransmitOn) == 0) return;  // a fault before board_begin()
  for (; *text != 0; ++text) {
    while ((reg(kConsole + kUsartState) & kTransmitEmpty) == 0) {
    }
    reg(kConsole + kUsartSent) = static_cast<uint8_t>(*text);
  }
}

uint32_t board_stack_high_bytes() { return stack_used_bytes(); }

// The independent watchdog: 12 bits at 125 us a tick (its own 32 kHz oscillator, divided by 4). It
// resets the chip, and with it every pin. A new reload is taken five of its cycles after the last.
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

}  // namespace firmtouch::hal
