#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
void board_begin() {
  motors_off();
  console_begin();
  clock_begin();
  link_begin();
}

// At the first time-out the watchdog raises the NMI (fault.cpp switches the motors off and stops);
// at the second it resets the chip.
void watchdog_begin(uint32_t timeout_us) {
  reg(kWatchdog + 0x0) = watchdog_ticks(timeout_us);
  reg(kWatchdog + 0xC) = 1;  // clears a time-out from before the servo ran
  reg(kWatchdog + 0x8) = 3;
}

void watchdog_feed() { reg(kWatchdog + 0xC) = 1; }

}  // namespace firmtouch::hal
