#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Switches the power stage on, or off if the motors must not push. Called in each tick, before
/// motors_write_N(); off until the first call.
/// Context: servo interrupt.
void motors_state(bool may_push);

/// Applies force (torque) to each joint's motor. All limits are applied already.
/// Context: servo interrupt.
void motors_write_N(const float (&motor_N)[3]);

/// Releases the brake of all joints, or engages it. Only a program with part `brake` calls it, in
/// each tick: to engage it before motors_state(), to release it after motors_write_N().
/// Context: servo interrupt.
void motors_brake(bool release);

/// Switches the power stage off at once, and engages the brake if there is one. Must work at reset,
/// when no variable has its value yet.
/// Context: any, the fault handler included.
void motors_off();

// Bits of motors_lines(). The controller program checks that they are the record's.
constexpr uint32_t kMotorsEnable = 1u << 0;         // the operator's enable switch is closed
constexpr uint32_t kMotorsEmergencyStop = 1u << 1;  // the emergency stop is pressed
constexpr uint32_t kMotorsDriveFault = 1u << 2;     // a motor driver reports a fault

/// Reads the input lines of the power stage. Result: the bits above.
/// Context: main loop until the servo runs, then servo interrupt; never both at once.
uint32_t motors_lines();

}  // namespace firmtouch::hal
