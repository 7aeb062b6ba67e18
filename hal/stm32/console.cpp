#include "firmtouch/hal/board.hpp"

#include "parts/asset_region.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

// What of board.hpp every STM32 has: the console's UART sends, and is never read.
namespace firmtouch::hal {

void console_begin() {
  constexpr uint32_t kConsoleBaud = 115200;
  reg(kConsole + kUsartDivider) = kUsart_MHz * 1000000 / kConsoleBaud;
  reg(kConsole + kUsartControl) = kUsartOn | kTransmitOn;
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

}  // namespace firmtouch::hal
