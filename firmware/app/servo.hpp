#pragma once
#include <stdint.h>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::app {

/// Nominal time between two ticks: parameter tick_period_s. The timer follows it.
uint32_t servo_period_us();

/// Ticks that a turn of the main loop may take. After more of them the watchdog is not fed.
uint32_t max_ticks_of_a_turn();

/// Starts the timer that calls servo_interrupt(), and the watchdog over it. Later calls do nothing.
/// Main loop only.
void start_servo();
bool servo_is_running();

/// The power stage was on in the last tick. Main loop.
bool motors_may_push();

/// hal::motors_lines() and the host's panel as flags of a tick. Enable is low in the first tick,
/// while `sets_saved`, and until the switch was seen open once since reset: nobody may be holding
/// the device. Servo interrupt only.
uint32_t servo_flags(bool sets_saved);

/// Servo interrupt, behind each tick: timer and watchdog follow a changed period.
void after_tick(const record::TickOutput& output);

/// link::Panel::flags, for the next ticks. Main loop only.
void set_panel(uint32_t flags);

/// Keeps the motors off, until they are no longer held and the enable switch was seen open. Main
/// loop only.
void hold_motors_off(bool is_held);

/// Starts the servo when the operator closes the enable switch for the first time. A switch that is
/// closed since the reset must be opened first. Until then no tick runs, and a host may take the
/// controller into lock-step.
void start_servo_when_enabled();

}  // namespace firmtouch::app
