#pragma once
#include <stdint.h>

namespace firmtouch::app {

/// Nominal time between two ticks, as the parameter table has it.
uint32_t servo_period_us();

/// Starts the timer that calls servo_interrupt(), and the watchdog over it. Later calls do nothing.
/// Main loop only.
void start_servo();
bool servo_is_running();

/// hal::motors_lines() as a tick is to see them: in the first tick after start_servo_when_enabled()
/// the enable line is low, as the main loop saw it, else the switch whose closing starts the servo
/// would have to be closed twice. Servo interrupt only.
uint32_t servo_lines();

/// Starts the servo when the operator closes the enable switch for the first time. One that is
/// closed since the reset must be opened first: nobody may be holding the device now. Until then
/// nothing needs a tick, and a host may take the controller into lock-step without the timer in
/// between.
void start_servo_when_enabled();

}  // namespace firmtouch::app
