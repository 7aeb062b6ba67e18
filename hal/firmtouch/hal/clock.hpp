#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Microseconds since board_begin(), wraps after 71 minutes. Interrupt-safe.
uint32_t clock_us();

/// A counter for measuring work: processor cycles where the core counts them, instructions under -icount. Wraps.
uint32_t clock_work();
/// Counter ticks of clock_work() per 1,000 instructions or cycles.
uint32_t clock_work_per_1000();

/// Calls `tick` every `period_us` from the servo interrupt.
/// Pre: called once, period_us >= 50.
void clock_start_servo(uint32_t period_us, void (*tick)());

}  // namespace firmtouch::hal
