#pragma once
#include <stdint.h>

namespace firmtouch::app {

/// Nominal time between two ticks: the initial value of tick_period_s.
uint32_t servo_period_us();

/// Ticks that a turn of the main loop may take. After more of them the watchdog is not fed.
uint32_t max_ticks_of_a_turn();

/// Starts the timer that calls servo_interrupt(), and the watchdog over it. Later calls do nothing.
/// Main loop only.
void start_servo();
bool servo_is_running();

/// hal::motors_lines() and the host's panel as flags of a tick. In the first tick after
/// start_servo_when_enabled() enable is low, as the main loop saw it: else the switch that starts
/// the servo had to be closed twice. Servo interrupt only.
uint32_t servo_flags();

/// link::Panel::flags, for the next ticks. Main loop only.
void set_panel(uint32_t flags);

/// Starts the servo when the operator closes the enable switch for the first time. A switch that is
/// closed since the reset must be opened first: nobody may be holding the device. Until then no
/// tick runs, and a host may take the controller into lock-step.
void start_servo_when_enabled();

}  // namespace firmtouch::app
