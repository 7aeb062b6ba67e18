#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/motors.hpp"
#include "registers.hpp"

extern "C" {
void link_handler();
}

namespace firmtouch::hal {
namespace {

struct BoardVectors {
  Handler unused[kLinkInterrupt];  // not enabled
  Handler link;
};

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors kBoardVectors = {{}, link_handler};

}  // namespace

void board_begin() {
  motors_off();
  power_begin();
  switch_on(kRccPorts, kPorts);
  switch_on(kRccTimers, kTimersAndUsarts);
  switch_on(kRccTimer1, kTimer1Clock);
  pin_alternate(kConsolePin);
  for (const Pin& pin : kLinkPins) pin_alternate(pin, Pull::kUp);
  reg(kLink + kUsartErrors) = kNoOverrun;  // a lost byte breaks a frame, no more
  console_begin();
  motors_begin();
  encoders_begin();
  clock_begin();
  link_begin();
}

}  // namespace firmtouch::hal
