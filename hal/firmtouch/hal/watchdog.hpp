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

/// Whether the watchdog ended the last run; clears what the chip keeps of it. Optional: the crash
/// record, which has a definition that returns false, calls it for watchdogs that do not warn.
/// Context: start-up, once.
bool watchdog_has_reset();

}  // namespace firmtouch::hal
