#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Switches the motors off in hardware unless watchdog_feed() comes at least every `timeout_us`.
void watchdog_begin(uint32_t timeout_us);
/// Called at the end of a good tick, from the servo interrupt.
void watchdog_feed();

}  // namespace firmtouch::hal
