#include "parts/fault_text.hpp"

#include "firmtouch/hal/board.hpp"

namespace firmtouch::hal {

void print_hex(const char* name, uint32_t value) {
  char text[] = "0x00000000 ";
  for (uint32_t i = 0; i < 8; ++i, value <<= 4) text[2 + i] = "0123456789abcdef"[value >> 28];
  board_print(name);
  board_print(text);
}

}  // namespace firmtouch::hal
