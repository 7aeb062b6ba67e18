#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Microseconds since board_begin(); wraps after 71 minutes. The servo calls it in each tick, so a
/// definition may extend a counter that wraps after a longer time.
/// Context: servo interrupt and main loop; the definition protects its own state.
uint32_t clock_us();

/// Counter that measures work: processor cycles if the core counts them, instructions under
/// -icount. Wraps.
/// Context: any, after board_begin().
uint32_t clock_work();

/// Ticks of clock_work() per 1,000 cycles or instructions; 0 if the board cannot measure work.
/// Context: any, after board_begin().
uint32_t clock_work_per_1000();

/// Starts the servo interrupt: it calls `tick` every `period_us`. Later calls, with the same
/// `tick`, change the period.
/// Pre: period_us >= 50.
/// Context: main loop, the first time; then servo interrupt.
void clock_start_servo(uint32_t period_us, void (*tick)());

}  // namespace firmtouch::hal
