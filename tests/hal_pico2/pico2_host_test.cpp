#include <limits>
#include <string>

#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/wiring.hpp"
#include "state_machine.hpp"

// Motors and encoders of the Pico 2, against registers in memory and a model of its state machines.

using namespace firmtouch;
using namespace firmtouch::hal;

namespace {

constexpr uint32_t kPeriod = 7500;  // 150 MHz / 20 kHz
constexpr uint32_t kGuardAddress = 0x50300000 + 0xD4, kGuardInstruction = 0x50300000 + 0xD8;

void fresh() {
  registers.clear();
  registers[0x40020008] = ~0u;  // every block is out of reset
  motors_off();
  motors_begin();
  motors_state(false);
}
uint32_t function(uint32_t pin) { return registers[0x40028004 + 8 * pin]; }
bool is_driven_low(uint32_t pin) { return (function(pin) & 0xF000u) == 0xE000u; }
bool is_off() {
  bool off = is_driven_low(kPowerPin.number);
  for (const Pin& pin : kPulsePins) off &= is_driven_low(pin.number);
  return off;
}
void set_input(const Pin& pin, bool high) {
  uint32_t& input = registers[0xD0000004];
  input = high ? input | 1u << pin.number : input & ~(1u << pin.number);
}
uint32_t compare(uint32_t motor) { return registers[0x400A800C + 0x14 * motor]; }

}  // namespace

TEST(Pico2_MotorsOff_WorksAtReset) {
  registers.clear();
  registers[0x40020008] = ~0u;
  motors_off();
  CHECK(is_off());
  CHECK_EQ(registers[0x40023000] & 0x240u, 0x240u);       // pins out of reset
  CHECK_EQ(registers[0x40038004 + 4 * 22] & 0x180u, 0u);  // not isolated, output on
  CHECK_EQ(registers[kGuardInstruction], 0u);             // jump to 0: power off
}

TEST(Pico2_MotorsState_AloneSwitchesThePowerOn) {
  fresh();
  motors_write_N({1, 2, 3});
  CHECK(is_off());
  registers[kGuardAddress] = 1;
  motors_state(true);
  CHECK_EQ(function(kPowerPin.number), 7u);  // PIO1
  for (const Pin& pin : kPulsePins) CHECK_EQ(function(pin.number), 4u);
  CHECK_EQ(registers[0x50300010], 1u);  // the word that the guard waits for
  registers[kGuardAddress] = 2;
  motors_state(true);
  CHECK(!is_off());
  motors_state(false);
  CHECK(is_off());
}

TEST(Pico2_Break_KeepsTheOutputsOffUntilTheControllerHasSeenIt) {
  fresh();
  motors_state(true);
  registers[kGuardAddress] = 3;
  motors_state(true);
  CHECK_EQ(motors_lines(), 0u);
  registers[kGuardAddress] = 1;  // a short pulse, behind which it waits
  CHECK_EQ(motors_lines(), kMotorsDriveFault);
  motors_state(true);
  CHECK(is_off());
  motors_state(true);
  CHECK(is_off());
  motors_state(false);
  CHECK_EQ(motors_lines() & kMotorsDriveFault, 0u);
  motors_state(true);
  CHECK(!is_off());
}

TEST(Pico2_Guard_EndsThePowerInThreeCyclesOfAFault) {
  fresh();
  StateMachine machine(0x50300000, 0);
  const uint32_t fault = 1u << kBreakPin.number;
  CHECK_EQ(machine.set_base(), kPowerPin.number);
  for (int i = 0; i < 20; ++i) machine.step(0);
  CHECK_EQ(machine.level, 0u);
  CHECK_EQ(machine.pc, 1u);
  machine.words.push_back(1);
  for (int i = 0; i < 7; ++i) machine.step(0);
  CHECK_EQ(machine.level, 1u);
  for (int phase = 0; phase < 2; ++phase) {
    StateMachine hit = machine;
    for (int i = 0; i < phase; ++i) hit.step(0);
    for (int i = 0; i < 3; ++i) hit.step(fault);
    CHECK_EQ(hit.level, 0u);
    for (int i = 0; i < 20; ++i) hit.step(0);  // the fault is gone: off until the next word
    CHECK_EQ(hit.level, 0u);
    CHECK_EQ(hit.pc, 1u);
  }
}

TEST(Pico2_Count_FollowsEveryEdgeInTenCycles) {
  fresh();
  encoders_begin();
  uint32_t seed = 1;
  for (uint32_t joint = 0; joint < 3; ++joint) {
    StateMachine machine(0x50200000, joint);
    machine.pc = registers[0x502000D8 + 0x18 * joint] & 31u;  // the last jump
    const uint32_t base = kEncoderPins[2 * joint].number;
    CHECK_EQ(machine.in_base(), base);
    const uint32_t pins[4] = {0, 1, 3, 2};  // A leads
    int32_t position = 0;
    for (int edge = 0; edge < 20000; ++edge) {
      seed = seed * 1664525u + 1013904223u;
      position += (seed >> 30) == 0 ? -1 : (edge / 5000) % 2 == 0 ? 1 : -1;  // far below zero, too
      for (int cycle = 0; cycle < 10; ++cycle)
        machine.step(pins[static_cast<uint32_t>(position) % 4] << base);
      if (edge % 100 != 0) continue;
      StateMachine settled = machine;
      for (int cycle = 0; cycle < 20; ++cycle)
        settled.step(pins[static_cast<uint32_t>(position) % 4] << base);
      CHECK_EQ(static_cast<int32_t>(settled.shown), position);
    }
    CHECK(position < -1000);
  }
}

TEST(Pico2_Count_IgnoresAChangeOfBothChannels) {
  fresh();
  encoders_begin();
  StateMachine machine(0x50200000, 0);
  machine.pc = registers[0x502000D8] & 31u;  // the last jump
  const uint32_t base = kEncoderPins[0].number;
  for (int i = 0; i < 100; ++i)
    for (int cycle = 0; cycle < 10; ++cycle) machine.step((i % 2 == 0 ? 3u : 0u) << base);
  CHECK_EQ(machine.shown, 0u);
}

TEST(Pico2_Counts_AreInvalidIfAMachineStands) {
  fresh();
  encoders_begin();
  int32_t counts[3];
  CHECK(!encoders_read(counts));  // the set register of this memory does not set
  registers[0x50200000] = 7;
  registers[0x50200128 + 16] = static_cast<uint32_t>(-5);
  CHECK(encoders_read(counts));
  CHECK_EQ(counts[1], -5);
  registers[0x50200000] = 5;
  CHECK(!encoders_read(counts));
}

TEST(Pico2_Width_FollowsTheForceAndIsZeroForNaN) {
  fresh();
  motors_write_N({5.0f, -5.0f, 0.125f});
  CHECK_EQ(compare(0), kPeriod / 2);
  CHECK_EQ(compare(1), kPeriod / 4);
  CHECK_EQ(compare(2), kPeriod / 4);
  motors_write_N({0.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()});
  CHECK_EQ(compare(2), 0u);
  motors_write_N({1e30f, 1, -1});
  CHECK_EQ(compare(0), kPeriod);  // above the top: always high
  CHECK_EQ(registers[0xD0000018], 1u << kDirectionPins[2].number);
}

TEST(Pico2_Lines_OfATornWireAreFaults) {
  fresh();
  for (const Pin& pin : {kStopPin, kBreakPin})
    CHECK_EQ(registers[0x40038004 + 4 * pin.number] & 0xCu, 0x8u);  // up
  CHECK_EQ(registers[0x40038004 + 4 * kEnablePin.number] & 0xCu, 0u);
  CHECK_EQ(motors_lines(), 0u);
  set_input(kEnablePin, true);
  CHECK_EQ(motors_lines(), kMotorsEnable);
  set_input(kStopPin, true);
  set_input(kBreakPin, true);
  CHECK_EQ(motors_lines(), kMotorsEnable | kMotorsEmergencyStop | kMotorsDriveFault);
}

TEST(Pico2_TestForce_IsAFifthOfFullWidth) {
  CHECK_EQ(board_test_force_N(0), 0.2f * 10.0f);
  CHECK_EQ(board_test_force_N(2), 0.2f * 0.5f);
}

TEST(Pico2_Wiring_NamesThePins) {
  CHECK(board_wiring(Wire::kEncoder, 2) == std::string("A to GP10, B to GP11."));
  CHECK(board_wiring(Wire::kMotor, 0) ==
        std::string("Pulse GP16, direction GP17, enable of the drivers GP22."));
}
