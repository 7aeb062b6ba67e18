#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Applies force (torque) to each joint's motor. All limits are applied already.
/// Context: servo interrupt.
void motors_write_N(const float (&motor_N)[3]);

/// Switches the power stage off at once. Must work before board_begin().
/// Context: any, the fault handler included.
void motors_off();

// Bits of motors_lines(). The controller program checks that they are the record's.
constexpr uint32_t kMotorsEnable = 1u << 0;         // the operator's enable switch is closed
constexpr uint32_t kMotorsEmergencyStop = 1u << 1;  // the emergency stop is pressed
constexpr uint32_t kMotorsDriveFault = 1u << 2;     // a motor driver reports a fault

/// Reads the input lines of the power stage. Result: the bits above.
/// Context: main loop until the servo runs, then servo interrupt.
uint32_t motors_lines();

}  // namespace firmtouch::hal
