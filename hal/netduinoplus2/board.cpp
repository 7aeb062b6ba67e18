#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

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
  console_begin();
  clock_begin();
  link_begin();
}

}  // namespace firmtouch::hal
