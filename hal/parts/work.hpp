#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Measures ticks of clock_work() per 1,000 instructions with a loop of known length. On an
/// emulator the virtual clock advances 2^N ns an instruction (-icount shift=N), and the guest
/// cannot read N. On a real core the loop takes one or two cycles a turn; the result is valid for
/// that core only.
uint32_t measure_work_per_1000();

}  // namespace firmtouch::hal
