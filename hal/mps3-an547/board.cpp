#include "firmtouch/hal/clock.hpp"

#include "registers.hpp"

extern "C" {
void reset_handler();
extern uint32_t __stack_top[];
}

namespace firmtouch::hal {
namespace {

// What the core reads at reset; start-up then sets the vector table.
struct Boot {
  const void* stack;
  Handler reset;
};
[[gnu::section(".boot"), gnu::used]] const Boot kBoot = {__stack_top, reset_handler};

}  // namespace

// The system counter counts at the core's clock. Under -icount shift=6 an instruction is 2.048 of
// its ticks.
void work_counter_begin() { reg(kCounter) = 1; }

uint32_t clock_work() { return reg(kCounter + 0x8); }

// A tick is 30.5 us.
uint32_t watchdog_ticks(uint32_t timeout_us) { return timeout_us / 31 + 1; }

}  // namespace firmtouch::hal
