#pragma once
#include <stdint.h>

namespace firmtouch::hal {

enum class Wire : uint8_t { kLink, kEnable, kEmergencyStop, kDriveFault, kEncoder, kMotor };

/// Where a wire goes, for a person: its pins and what they expect. Optional: only the self-test
/// (tests/target/selftest) calls it, which has a general text if the board has none.
/// Pre: `joint` is 0 to 2 for encoder and motor, else 0.
/// Context: main loop.
const char* board_wiring(Wire wire, uint32_t joint);

/// Number of joints that have an encoder and a motor, the first ones: 1 to 3. Optional: only the
/// self-test calls it, and checks three if the board does not say.
/// Context: main loop.
uint32_t board_joints();

/// Largest force (torque, in N m) with which the self-test pushes `joint`: enough to overcome
/// its friction, safe for a hand. Optional: only the self-test calls it; 2 if the board does not
/// say, which is much for a motor that takes a torque.
/// Pre: `joint` < board_joints().
/// Context: main loop.
float board_test_force_N(uint32_t joint);

}  // namespace firmtouch::hal
