#include "firmtouch/hal/clock.hpp"

#include "registers.hpp"

namespace firmtouch::hal {
// TIMER0 counts down at the core's clock, 40 ns a tick. Under -icount shift=N an instruction takes
// 2^N ns, so the ticks count instructions: at shift=6 exactly 1.6 ticks each.
void work_counter_begin() {
  reg(kTimer0 + 0x8) = UINT32_MAX;
  reg(kTimer0 + 0x4) = UINT32_MAX;
  reg(kTimer0 + 0x0) = 1;
}

uint32_t clock_work() { return UINT32_MAX - reg(kTimer0 + 0x4); }

uint32_t watchdog_ticks(uint32_t timeout_us) {
  const uint32_t longest_us = UINT32_MAX / kCore_MHz;
  return (timeout_us < longest_us ? timeout_us : longest_us) * kCore_MHz;
}

}  // namespace firmtouch::hal
