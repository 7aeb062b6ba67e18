#include <limits>
#include <string>

#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/wiring.hpp"
#include "harness/test.hpp"
#include "registers.hpp"

// Motors and encoders of the STM32 boards, against registers in memory (NUCLEO-G474RE).

using namespace firmtouch;
using namespace firmtouch::hal;

namespace {

constexpr uint32_t kMainOutput = 1u << 15, kBroken = 1u << 7, kPeriod = 8500;  // 170 MHz / 20 kHz

uint32_t compare(uint32_t motor) { return registers[kTimer1 + kTimerCompare + 4 * motor]; }
bool outputs_are_on() { return (registers[kTimer1 + kTimerBreak] & kMainOutput) != 0; }
// The last write to the port's set and reset bits.
uint32_t written(const Pin& pin) { return registers[pin.port + kPortSet]; }
uint32_t mode_of(const Pin& pin) { return registers[pin.port + kPortMode] >> 2 * pin.number & 3u; }
void set_input(const Pin& pin, bool high) {
  uint32_t& input = registers[pin.port + kPortInput];
  input = high ? input | 1u << pin.number : input & ~(1u << pin.number);
}

}  // namespace

TEST(Stm32_MotorsOff_WorksAtReset) {
  registers.clear();
  motors_off();
  CHECK_EQ(registers[kRccPorts] & kPorts, kPorts);
  CHECK_EQ(written(kPowerPin), 1u << (kPowerPin.number + 16));
  CHECK_EQ(mode_of(kPowerPin), 1u);
  CHECK(!outputs_are_on());
}

TEST(Stm32_MotorsState_AloneSwitchesThePowerOn) {
  registers.clear();
  motors_off();
  motors_begin();
  motors_write_N({1, 2, 3});
  CHECK(!outputs_are_on());
  CHECK_EQ(registers[kTimer1 + kTimerBreak] & 0x3C00u, 0x3C00u);  // low when off; break on, high
  motors_state(true);
  CHECK(outputs_are_on());
  CHECK_EQ(written(kPowerPin), 1u << kPowerPin.number);
  motors_state(false);
  CHECK(!outputs_are_on());
  CHECK_EQ(written(kPowerPin), 1u << (kPowerPin.number + 16));
  motors_state(true);
  motors_off();
  CHECK(!outputs_are_on());
}

TEST(Stm32_Width_FollowsTheForceAndIsZeroForNaN) {
  registers.clear();
  motors_begin();
  motors_write_N({5.0f, -5.0f, 0.125f});
  CHECK_EQ(compare(0), kPeriod / 2);
  CHECK_EQ(compare(1), kPeriod / 4);
  CHECK_EQ(compare(2), kPeriod / 4);
  motors_write_N({0.0f, 0.0f, 0.0f});
  CHECK_EQ(compare(2), 0u);
  const float infinity = std::numeric_limits<float>::infinity();
  motors_write_N({std::numeric_limits<float>::quiet_NaN(), -infinity, 1e30f});
  CHECK_EQ(compare(0), 0u);
  CHECK_EQ(compare(1), kPeriod);  // always high
  CHECK_EQ(compare(2), kPeriod);
  motors_write_N({1, 1, -1});
  CHECK_EQ(written(kDirectionPins[2]), 1u << kDirectionPins[2].number);
  motors_write_N({1, 1, 1});
  CHECK_EQ(written(kDirectionPins[2]), 1u << (kDirectionPins[2].number + 16));
}

TEST(Stm32_Lines_OfATornWireAreFaults) {
  registers.clear();
  motors_begin();
  CHECK_EQ(registers[kStopPin.port + kPortPull] >> 2 * kStopPin.number & 3u, 1u);  // up
  CHECK_EQ(registers[kBreakPin.port + kPortPull] >> 2 * kBreakPin.number & 3u, 1u);
  CHECK_EQ(registers[kEnablePin.port + kPortPull] >> 2 * kEnablePin.number & 3u, 2u);  // down
  CHECK_EQ(motors_lines(), 0u);
  set_input(kEnablePin, true);
  CHECK_EQ(motors_lines(), kMotorsEnable);
  set_input(kStopPin, true);
  CHECK_EQ(motors_lines(), kMotorsEnable | kMotorsEmergencyStop);
  set_input(kBreakPin, true);
  CHECK_EQ(motors_lines(), kMotorsEnable | kMotorsEmergencyStop | kMotorsDriveFault);
  set_input(kBreakPin, false);
  registers[kTimer1 + kTimerState] = kBroken;  // a short pulse, which switched the outputs off
  CHECK_EQ(motors_lines(), kMotorsEnable | kMotorsEmergencyStop | kMotorsDriveFault);
}

TEST(Stm32_Break_KeepsTheOutputsOffUntilTheControllerHasSeenIt) {
  registers.clear();
  motors_begin();
  motors_state(true);
  registers[kTimer1 + kTimerState] = kBroken;
  motors_state(true);  // of the tick in which it came
  CHECK(!outputs_are_on());
  CHECK_EQ(written(kPowerPin), 1u << (kPowerPin.number + 16));
  CHECK_EQ(motors_lines(), kMotorsDriveFault);
  motors_state(false);  // of the next: the fault is latched
  CHECK_EQ(motors_lines() & kMotorsDriveFault, 0u);
  motors_state(true);  // after the operator has cleared it
  CHECK(outputs_are_on());
}

TEST(Stm32_Counts_GoOnBeyondSixteenBits) {
  registers.clear();
  encoders_begin();
  int32_t counts[3];
  CHECK(encoders_read(counts));
  const int32_t first = counts[1];
  int32_t expected = first;
  for (int32_t step : {30000, 30000, 30000, -32768, -30000, -30000, -30000, 1}) {
    expected += step;
    registers[kEncoderTimers[1] + kTimerCount] =
        (registers[kEncoderTimers[1] + kTimerCount] + static_cast<uint32_t>(step)) & 0xFFFF;
    CHECK(encoders_read(counts));
    CHECK_EQ(counts[1], expected);
  }
  registers[kEncoderTimers[2] + kTimerControl] = 0;  // its clock was lost
  CHECK(!encoders_read(counts));
}

TEST(Stm32_TestForce_IsAFifthOfFullWidth) {
  CHECK_EQ(board_test_force_N(0), 0.2f * 10.0f);
  CHECK_EQ(board_test_force_N(2), 0.2f * 0.5f);
}

TEST(Stm32_Wiring_NamesThePins) {
  const auto text = [](Wire wire, uint32_t joint) {
    return std::string(board_wiring(wire, joint));
  };
  CHECK(text(Wire::kEncoder, 0) == "A to PA0, B to PA1.");
  CHECK(text(Wire::kMotor, 2) == "Pulse PA10, direction PB15, enable of the drivers PC8.");
  CHECK(text(Wire::kDriveFault, 0) == "The drivers' fault output, low while all is well, to PB12.");
}
