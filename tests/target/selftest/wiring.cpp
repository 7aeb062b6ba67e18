#include "firmtouch/hal/wiring.hpp"

namespace firmtouch::hal {

/// For a board without a text of its own.
[[gnu::weak]] const char* board_wiring(Wire wire, uint32_t) {
  switch (wire) {
    case Wire::kLink:
      return "Receive and transmit as link.cpp sets them.";
    case Wire::kEnable:
      return "The enable switch: closed sets its line, open or torn off clears it.";
    case Wire::kEmergencyStop:
      return "The emergency stop: a closed contact; pressed or torn off sets its line.";
    case Wire::kDriveFault:
      return "The drivers' fault output: torn off sets its line.";
    case Wire::kEncoder:
      return "Its channels A and B, ground, power.";
    case Wire::kMotor:
      return "Its driver's inputs and power.";
  }
  return "";
}

[[gnu::weak]] uint32_t board_joints() { return 3; }

[[gnu::weak]] float board_test_force_N(uint32_t) { return 2.0f; }

}  // namespace firmtouch::hal
