#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

extern "C" {
void usart2_handler();
void hard_fault_handler();
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kConsoleBaud = 115200;

struct BoardVectors {
  Handler unused[kUsart2Interrupt];  // not enabled
  Handler usart2;
};

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors kBoardVectors = {{},
                                                                                  usart2_handler};

void pins_begin() {
  reg(kRccAhb1Enable) = reg(kRccAhb1Enable) | 1u;
  reg(kRccApb1Enable) = reg(kRccApb1Enable) | 1u | 1u << 3 | 1u << 17;
  reg(kRccApb2Enable) = reg(kRccApb2Enable) | 1u << 4;
  // PA2, PA3: USART2; PA9, PA10: USART1; all alternate function 7.
  reg(kPortA + 0x00) = (reg(kPortA + 0x00) & ~0x003C00F0u) | 0x002800A0u;
  reg(kPortA + 0x20) = (reg(kPortA + 0x20) & ~0x0000FF00u) | 0x00007700u;
  reg(kPortA + 0x24) = (reg(kPortA + 0x24) & ~0x00000FF0u) | 0x00000770u;
}

}  // namespace

void board_begin() {
  motors_off();
  pins_begin();
  reg(kUsart1 + kUsartDivider) = kUsart_MHz * 1000000 / kConsoleBaud;
  reg(kUsart1 + kUsartControl) = kUsartOn | kTransmitOn;
  clock_begin();
  link_begin();
}

const char* board_name() { return "netduinoplus2"; }

core::Bytes board_asset() { return linked_or_loaded_asset(); }

void board_print(const char* text) {
  if ((reg(kUsart1 + kUsartControl) & kTransmitOn) == 0) return;  // a fault before board_begin()
  for (; *text != 0; ++text) {
    while ((reg(kUsart1 + kUsartState) & kTransmitEmpty) == 0) {
    }
    reg(kUsart1 + kUsartData) = static_cast<uint8_t>(*text);
  }
}

uint32_t board_stack_high_bytes() { return stack_used_bytes(); }

// The independent watchdog resets the chip, and with it every pin of the power stage. It counts 12
// bits at 125 us a tick (its own 32 kHz oscillator, divided by 4). QEMU ignores it.
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
