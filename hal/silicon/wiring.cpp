#include "firmtouch/hal/wiring.hpp"

#include "registers.hpp"

// Where the wires of registers.hpp go, with the pins' names; and what a motor may make in a test.
namespace firmtouch::hal {
namespace {

char g_text[120];
uint32_t g_length = 0;

void add(const char* text) {
  for (; *text != 0 && g_length + 1 < sizeof g_text; ++text) g_text[g_length++] = *text;
  g_text[g_length] = 0;
}

void add(const char* before, const Pin& pin) {
  const PinName name = name_of(pin);
  const char tens = static_cast<char>(name.number >= 10 ? '0' + name.number / 10 : 0);
  const char units = static_cast<char>('0' + name.number % 10);
  const char digits[] = {tens != 0 ? tens : units, tens != 0 ? units : char{0}, 0};
  add(before);
  add(name.port);
  add(digits);
}

}  // namespace

const char* board_wiring(Wire wire, uint32_t joint) {
  g_length = 0;
  switch (wire) {
    case Wire::kLink:
      add("Transmit ", kLinkPins[0]);
      add(", receive ", kLinkPins[1]);
      break;
    case Wire::kEnable:
      add("Switch from 3.3 V to ", kEnablePin);
      break;
    case Wire::kEmergencyStop:
      add("Normally closed contact from ground to ", kStopPin);
      break;
    case Wire::kDriveFault:
      add("The drivers' fault output, low while all is well, to ", kBreakPin);
      break;
    case Wire::kEncoder:
      add("A to ", kEncoderPins[2 * joint]);
      add(", B to ", kEncoderPins[2 * joint + 1]);
      break;
    case Wire::kMotor:
      add("Pulse ", kPulsePins[joint]);
      add(", direction ", kDirectionPins[joint]);
      add(", enable of the drivers ", kPowerPin);
      break;
  }
  add(".");
  return g_text;
}

float board_test_force_N(uint32_t joint) { return 0.2f * kFull_N_or_Nm[joint]; }

}  // namespace firmtouch::hal
