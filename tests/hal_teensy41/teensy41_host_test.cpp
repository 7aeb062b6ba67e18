#include <limits>
#include <string>

#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/wiring.hpp"
#include "harness/test.hpp"
#include "registers.hpp"

// Motors and encoders of the Teensy 4.1, against registers in memory. Addresses are of the manual
// (IMXRT1060RM) and the board's schematic, not of the HAL.

using namespace firmtouch;
using namespace firmtouch::hal;

namespace {

constexpr uint32_t kPeriod = 6600;  // 132 MHz / 20 kHz
constexpr uint32_t kModule = 0x403E0000, kState = kModule + 0x18E;
constexpr uint32_t kPadB0_10 = 0x401F8164, kPadB0_11 = 0x401F8168, kPadB1_02 = 0x401F8184,
                   kPadB0_12 = 0x401F816C;
constexpr uint32_t kPort2Set = 0x401BC084, kPort2Clear = 0x401BC088, kPort2Output = 0x401BC004;

void fresh() {
  registers.clear();
  registers16.clear();
  motors_off();
  motors_begin();
  registers16[kState] = 0;  // written ones clear, of which this memory knows nothing
}
uint32_t function(uint32_t pad) { return registers[pad]; }
bool pulses_are_on() {
  return function(kPadB0_10) == 2 && function(kPadB0_11) == 2 && function(kPadB1_02) == 6;
}
bool pulses_are_off() {  // the port's outputs
  for (const uint32_t pad : {kPadB0_10, kPadB0_11, kPadB1_02})
    if (function(pad) != 5) return false;
  return (registers[kPort2Output] & 0x41C00u) == 0x41C00u;
}

}  // namespace

TEST(Teensy41_MotorsOff_WorksAtReset) {
  registers.clear();
  motors_off();
  CHECK(pulses_are_off());
  CHECK_EQ(function(kPadB0_12), 5u);
  CHECK_EQ(registers[kPort2Output] & 0x1000u, 0x1000u);
  CHECK_EQ(registers[kPort2Clear], 1u << 18);                  // the last of the four, B1_02
  CHECK_EQ(registers[0x400FC068] & 0xC0000000u, 0xC0000000u);  // the clock of port 2
  CHECK_EQ(registers[0x400FC078] & 0xCu, 0xCu);                // and of the pads
}

TEST(Teensy41_MotorsState_AloneSwitchesThePowerOn) {
  fresh();
  motors_write_N({1, 2, 3});
  CHECK(pulses_are_off());
  motors_state(true);
  CHECK(pulses_are_on());
  CHECK_EQ(registers[kPort2Set], 1u << 12);
  motors_state(false);
  CHECK(pulses_are_off());
  motors_state(true);
  motors_off();
  CHECK(pulses_are_off());
}

TEST(Teensy41_Fault_EndsThePulsesWithoutTheProgram) {
  fresh();
  for (uint32_t submodule = 2; submodule < 4; ++submodule) {
    const uint32_t base = kModule + 0x60 * submodule;
    CHECK_EQ(registers16[base + 0x2C] & 0xFFF, 0x111);  // fault 0 alone ends A, B and X
    CHECK_EQ(registers16[base + 0x22] & 0x3Fu, 0u);     // in a fault the outputs are low
  }
  CHECK_EQ(registers16[kModule + 0x18C], 0xF010u);  // high; cleared by hand, when it has ended
  CHECK_EQ(registers16[0x403BC000 + 48] >> 8, 17);  // crossbar: output 49 from input 17
  CHECK_EQ(registers[0x401F862C], 3u);              // which is pad B1_03
  CHECK_EQ(function(0x401F8188), 1u);
}

TEST(Teensy41_Break_KeepsTheOutputsOffUntilTheControllerHasSeenIt) {
  fresh();
  motors_state(true);
  registers16[kState] = 1;  // of a short pulse
  motors_state(true);
  CHECK(pulses_are_off());
  CHECK_EQ(motors_lines(), kMotorsDriveFault);
  motors_state(false);
  CHECK_EQ(registers16[kState], 0x11u);  // clears the flag; resumes at a period's end
  registers16[kState] = 0x10;
  CHECK_EQ(motors_lines(), 0u);
  motors_state(true);
  CHECK(pulses_are_on());
}

TEST(Teensy41_Width_FollowsTheForceAndIsZeroForNaN) {
  fresh();
  const uint32_t compares[3] = {kModule + 0xC0 + 0x16, kModule + 0xC0 + 0x1E,
                                kModule + 0x120 + 0x16};
  for (uint32_t submodule = 2; submodule < 4; ++submodule)
    CHECK_EQ(registers16[kModule + 0x60 * submodule + 0x0E], kPeriod - 1);
  motors_write_N({5.0f, -5.0f, 0.125f});
  CHECK_EQ(registers16[compares[0]], kPeriod / 2);
  CHECK_EQ(registers16[compares[1]], kPeriod / 4);
  CHECK_EQ(registers16[compares[2]], kPeriod / 4);
  motors_write_N({0.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()});
  CHECK_EQ(registers16[compares[2]], 0u);
  CHECK_EQ(registers16[kModule + 0x188] & 0xF0Fu, 0xC0Cu);  // runs; the values are taken
  motors_write_N({1, 1, -1e30f});
  CHECK_EQ(registers16[compares[2]], kPeriod);  // beyond the period: always high
  CHECK_EQ(registers[kPort2Set], 1u << 1);      // direction: pin 12, B0_01
}

TEST(Teensy41_Lines_OfATornWireAreFaults) {
  fresh();
  CHECK_EQ(registers[0x401F82E0] >> 12 & 0xFu, 7u);  // stop, AD_B0_13: pulled up
  CHECK_EQ(registers[0x401F82DC] >> 12 & 0xFu, 3u);  // enable, AD_B0_12: down
  CHECK_EQ(registers[0x401F8378] >> 12 & 0xFu, 7u);  // break, B1_03: up
  registers[0x401B8008] = 1u << 12;
  CHECK_EQ(motors_lines(), kMotorsEnable);
  registers[0x401B8008] = 1u << 12 | 1u << 13;
  registers16[kState] = 1u << 8;
  CHECK_EQ(motors_lines(), kMotorsEnable | kMotorsEmergencyStop | kMotorsDriveFault);
}

TEST(Teensy41_Counts_ComeFromTheCrossbarAndHave32Bits) {
  fresh();
  encoders_begin();
  const uint32_t outputs[6] = {66, 67, 71, 72, 76, 77}, inputs[6] = {6, 7, 8, 9, 22, 23};
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t pair = registers16[0x403BC000 + outputs[i] / 2 * 2];
    CHECK_EQ(pair >> outputs[i] % 2 * 8 & 0xFFu, inputs[i]);
  }
  registers16[0x403CC00E] = 0xFFFF;
  registers16[0x403CC014] = 0xFF38;
  int32_t counts[3];
  CHECK(encoders_read(counts));
  CHECK_EQ(counts[1], -200);
  registers[0x400FC078] &= ~(3u << 28);  // the third's clock was lost
  CHECK(!encoders_read(counts));
}

TEST(Teensy41_TestForce_IsAFifthOfFullWidth) {
  CHECK_EQ(board_test_force_N(0), 0.2f * 10.0f);
  CHECK_EQ(board_test_force_N(2), 0.2f * 0.5f);
}

TEST(Teensy41_Wiring_NamesThePins) {
  CHECK(board_wiring(Wire::kEncoder, 1) == std::string("A to pin 4, B to pin 33."));
  CHECK(board_wiring(Wire::kMotor, 2) ==
        std::string("Pulse pin 36, direction pin 12, enable of the drivers pin 32."));
}
