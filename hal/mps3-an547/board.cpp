#include "firmtouch/hal/board.hpp"

#include "cortex-m/stack.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "registers.hpp"

extern "C" {
void uart1_receive_handler();
void reset_handler();
extern uint32_t __stack_top[];
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kConsoleDivider = kUart_MHz * 1000000 / 115200;

struct BoardVectors {
  Handler unused[kUart1Receive];  // not enabled
  Handler uart1_receive;
};

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors kBoardVectors = {
    {}, uart1_receive_handler};

// What the core reads at reset; start-up then sets the vector table.
struct Boot {
  const void* stack;
  Handler reset;
};
[[gnu::section(".boot"), gnu::used]] const Boot kBoot = {__stack_top, reset_handler};

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

// As on the MPS2: the first time-out raises the NMI, the second resets the chip.
void watchdog_begin(uint32_t timeout_us) {
  const uint32_t ticks = timeout_us / 31 + 1;  // a tick is 30.5 us
  reg(kWatchdog + 0x0) = ticks;
  reg(kWatchdog + 0xC) = 1;  // clears a time-out from before the servo ran
  reg(kWatchdog + 0x8) = 3;
}

void watchdog_feed() { reg(kWatchdog + 0xC) = 1; }

}  // namespace firmtouch::hal
