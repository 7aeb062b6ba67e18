#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Arms the hardware that switches the motors off if watchdog_feed() does not come within
/// `timeout_us`. It cannot be disarmed. Later calls change the time-out.
/// Context: main loop, the first time, before clock_start_servo(); then servo interrupt.
void watchdog_begin(uint32_t timeout_us);

/// Restarts the watchdog's time-out.
/// Context: servo interrupt, at the end of a tick, after the motors were written.
void watchdog_feed();

}  // namespace firmtouch::hal
