#pragma once
#include <stdint.h>

namespace firmtouch::hal {

enum class Wire : uint8_t { kLink, kEnable, kEmergencyStop, kDriveFault, kEncoder, kMotor };

/// Where a wire goes, for a person: its pins and what they expect. Optional: only the self-test
/// (tests/target/selftest) calls it, which has a general text if the board has none.
/// Pre: `joint` is 0 to 2 for encoder and motor, else 0.
/// Context: main loop.
const char* board_wiring(Wire wire, uint32_t joint);

}  // namespace firmtouch::hal
