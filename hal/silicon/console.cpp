#include "firmtouch/hal/board.hpp"

#include "parts/asset_region.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

// What of board.hpp every such board has: the console's UART sends, and is never read.
namespace firmtouch::hal {

void console_begin() { uart_begin(kConsole, 115200, false); }

const char* board_name() { return FIRMTOUCH_BOARD_NAME; }

core::Bytes board_asset() { return linked_or_loaded_asset(); }

void board_print(const char* text) {
  if (!uart_is_on(kConsole)) return;  // a fault before board_begin()
  for (; *text != 0; ++text) {
    while (!uart_may_send(kConsole)) {
    }
    uart_send(kConsole, static_cast<uint8_t>(*text));
  }
}

uint32_t board_stack_high_bytes() { return stack_used_bytes(); }

}  // namespace firmtouch::hal
