#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Ticks of clock_work() per 1,000 instructions, measured with a loop of known length: an emulator's virtual clock
/// advances by 2^shift ns an instruction (-icount shift=N), and nobody tells the guest what N is. On a real core the
/// loop runs from cache at one or two cycles a turn, and the figure is that core's own.
uint32_t measure_work_per_1000();

}  // namespace firmtouch::hal
