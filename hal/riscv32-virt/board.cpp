#include "firmtouch/hal/board.hpp"

#include "emulator/file_link.hpp"
#include "firmtouch/hal/link.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "parts/asset_region.hpp"
#include "parts/byte_ring.hpp"
#include "parts/stack.hpp"
#include "registers.hpp"

// Its one UART is the console, so the link is over files only. It has no watchdog.

namespace firmtouch::hal {
namespace {

ByteRing g_received;

}  // namespace

void board_begin() {
  motors_off();
  file_link_begin();
}

const char* board_name() { return FIRMTOUCH_BOARD_NAME; }

core::Bytes board_asset() { return linked_or_loaded_asset(); }

void board_print(const char* text) {
  for (; *text != 0; ++text) {
    while ((byte_reg(kUartState) & kTransmitEmpty) == 0) {
    }
    byte_reg(kUart) = static_cast<uint8_t>(*text);
  }
}

uint32_t board_stack_high_bytes() { return stack_used_bytes(); }

void watchdog_begin(uint32_t) {}
void watchdog_feed() {}

uint32_t link_read(uint8_t* to, uint32_t capacity) { return g_received.pop(to, capacity); }
uint32_t link_write(const uint8_t* from, uint32_t count) {
  return file_link_is_open() ? file_link_write(from, count) : count;
}
void link_wait() {
  if (file_link_is_open()) file_link_wait(g_received);
}

}  // namespace firmtouch::hal
