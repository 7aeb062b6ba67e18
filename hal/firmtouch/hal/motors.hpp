#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Force (torque) of each joint's motor, already limited. Called from the servo interrupt.
void motors_write_N(const float (&motor_N)[3]);

/// Power stage off, at once, from any context, before anything else was set up.
void motors_off();

/// The enable switch, the emergency stop and the drivers' fault lines, as record::kLine... bits.
uint32_t motors_lines();

}  // namespace firmtouch::hal
