#include "firmtouch/hal/motors.hpp"

#include "registers.hpp"

// Pulse module 2: a width for each motor, its direction on a pin, and the drivers' fault line on
// fault input 0, which drives the pulses low without the program, even without a clock.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kWidth = kBus_MHz * 1000000 / kPulse_Hz;
constexpr uint32_t kSubmodule_bytes = 0x60;
constexpr uint32_t kOptions = 0x04, kMode = 0x06, kPeriod = 0x0E, kEndA = 0x16, kEndB = 0x1E,
                   kFaultMap = 0x2C;
constexpr uint32_t kOutputs = kPulse2 + 0x180, kControl = kPulse2 + 0x188,
                   kFaultControl = kPulse2 + 0x18C, kFaultState = kPulse2 + 0x18E,
                   kFaultFilter = kPulse2 + 0x190;
constexpr uint16_t kUsed = 0xC;  // submodules 2 and 3
constexpr uint16_t kBroken = 1u << 0, kResumeAtPeriod = 1u << 4, kIsFault = 1u << 8;
constexpr uint32_t kFaultOutput = 49;  // of the crossbar

bool is_broken() { return (reg16(kFaultState) & kBroken) != 0; }

}  // namespace

void motors_begin() {
  switch_on(kGatePulse2);
  reg16(kFaultControl) = 0xF << 12 | 1u << 4;  // high is a fault; it must end before it is cleared
  reg16(kFaultFilter) = 1u << 8 | 4u;
  reg16(kFaultState) = kResumeAtPeriod | kBroken;
  for (uint32_t submodule = 2; submodule < 4; ++submodule) {
    const uint32_t base = kPulse2 + kSubmodule_bytes * submodule;
    reg16(base + kOptions) = 3u << 13;  // two channels of their own; a debug halt stops them
    reg16(base + kMode) = 1u << 10;     // reload at the period's end
    reg16(base + kPeriod) = kWidth - 1;
    reg16(base + kFaultMap) = 0xF111;  // fault 0 ends every channel
  }
  reg16(kOutputs) = kUsed << 8 | kUsed << 4;
  reg16(kControl) = kUsed << 8 | kUsed;
  crossbar(kBreakPin, kBreakInput, kFaultOutput);  // pulled up: fault or torn off
  pin_as(kStopPin, kPortFunction, Pull::kUp);      // a closed contact to ground
  pin_as(kEnablePin, kPortFunction, Pull::kDown);  // closed: high
  for (const Pin& pin : kDirectionPins) pin_output(pin);
}

// A break in this tick keeps the outputs off and its flag until the controller has seen it.
void motors_state(bool may_push) {
  if (!may_push) reg16(kFaultState) = kResumeAtPeriod | kBroken;
  if (!may_push || is_broken()) return motors_off();
  for (uint32_t i = 0; i < 3; ++i) pin_as(kPulsePins[i], kPulses[i].function);
  pin_write(kPowerPin, true);
}

void motors_write_N(const float (&motor_N)[3]) {
  reg16(kControl) = kUsed << 8 | kUsed << 4;  // taken together
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t base = kPulse2 + kSubmodule_bytes * kPulses[i].submodule;
    pin_write(kDirectionPins[i], motor_N[i] < 0);
    reg16(base + (kPulses[i].is_channel_b ? kEndB : kEndA)) =
        static_cast<uint16_t>(pulse_width(motor_N[i], kFull_N_or_Nm[i], kWidth));
  }
  reg16(kControl) = kUsed << 8 | kUsed;
}

// Before board_begin() the pins are inputs, and resistors pull the power stage off.
void motors_off() {
  constexpr Gate kGates[] = {kGatePort1, kGatePort2, kGatePads, kGateSettings};
  for (const Gate& gate : kGates) switch_on(gate);
  reg(kSettings + 0x68) = 0;  // the slow ports, as after reset
  reg(kSettings + 0x6C) = 0;
  pin_write(kPowerPin, false);
  pin_output(kPowerPin);
  for (const Pin& pin : kPulsePins) {
    pin_write(pin, false);
    pin_output(pin);
  }
}

uint32_t motors_lines() {
  uint32_t lines = pin_is_high(kEnablePin) ? kMotorsEnable : 0;
  if (pin_is_high(kStopPin)) lines |= kMotorsEmergencyStop;
  if ((reg16(kFaultState) & (kIsFault | kBroken)) != 0) lines |= kMotorsDriveFault;
  return lines;
}

}  // namespace firmtouch::hal
