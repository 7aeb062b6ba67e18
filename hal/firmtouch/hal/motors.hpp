#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Force (torque) of each joint's motor, already limited. Called from the servo interrupt.
void motors_write_N(const float (&motor_N)[3]);

/// Power stage off, at once, from any context, before anything else was set up.
void motors_off();

// Bits of motors_lines(). The controller program checks that they are the record's.
constexpr uint32_t kMotorsEnable = 1u << 0;         // the operator's enable switch is closed
constexpr uint32_t kMotorsEmergencyStop = 1u << 1;  // the emergency stop is pressed
constexpr uint32_t kMotorsDriveFault = 1u << 2;     // a motor driver reports a fault

/// The lines of the power stage. Called from the servo interrupt, and before it runs from the main
/// loop.
uint32_t motors_lines();

}  // namespace firmtouch::hal
