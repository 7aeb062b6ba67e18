#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "registers.hpp"

namespace firmtouch::hal {

void board_begin() {
  motors_off();
  power_begin();
  switch_on(kRccPorts, kPorts);
  switch_on(kRccTimers, kTimersAndUsarts);
  switch_on(kRccTimer1, kTimer1Clock);
  pin_alternate(kConsolePin);
  for (const Pin& pin : kLinkPins) pin_alternate(pin, Pull::kUp);
  reg(kLink + kUsartErrors) = kNoOverrun;  // a lost byte breaks a frame, no more
  peripherals_begin();
}

}  // namespace firmtouch::hal
