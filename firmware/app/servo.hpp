#pragma once
#include <stdint.h>

namespace firmtouch::app {

/// Nominal time between two ticks, as the parameter table has it.
uint32_t servo_period_us();

/// Starts the timer that calls servo_interrupt(), and the watchdog over it. Later calls do nothing.
/// Main loop only.
void start_servo();
bool servo_is_running();

/// Starts the servo when the operator closes the enable switch for the first time: until then
/// nothing needs a tick, and a host may take the controller into lock-step without the timer in
/// between.
void start_servo_when_enabled();

}  // namespace firmtouch::app
