#pragma once
#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::record {

/// Ring of the controller program. 64 ticks: 64 ms at 1 kHz and 6.4 ms at 10 kHz, longer than any
/// turn of the main loop (a slice of opening, a frame).
using TickRing = Ring<TickRecord, 64>;
static_assert(sizeof(TickRing) == 10112);  // on every target: `firmtouch plan` counts it

}  // namespace firmtouch::record
