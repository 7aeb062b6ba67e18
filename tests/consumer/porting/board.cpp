#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

extern "C" void link_handler();

namespace firmtouch::hal {
namespace {

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors<kLinkInterrupt> kBoardVectors = {
    {}, link_handler};

}  // namespace

void board_begin() {
  motors_off();
  reg(kConsole + 0x10) = kCore_MHz * 1000000 / 115200;
  reg(kConsole + 0x8) = 1;
  clock_begin();
  link_begin();
}
const char* board_name() { return FIRMTOUCH_BOARD_NAME; }
core::Bytes board_asset() { return linked_or_loaded_asset(); }
void board_print(const char* text) {
  if ((reg(kConsole + 0x8) & 1u) == 0) return;  // a fault before board_begin()
  for (; *text != 0; ++text) {
    while ((reg(kConsole + 0x4) & 1u) != 0) {
    }
    reg(kConsole) = static_cast<uint8_t>(*text);
  }
}
uint32_t board_stack_high_bytes() { return stack_used_bytes(); }
// Its first time-out is an NMI, its second a reset.
void watchdog_begin(uint32_t timeout_us) {
  reg(kWatchdog + 0x0) = timeout_us * kCore_MHz;
  reg(kWatchdog + 0xC) = 1;
  reg(kWatchdog + 0x8) = 3;
}
void watchdog_feed() { reg(kWatchdog + 0xC) = 1; }

}  // namespace firmtouch::hal
