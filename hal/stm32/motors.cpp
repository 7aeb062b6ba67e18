#include "firmtouch/hal/motors.hpp"

#include "registers.hpp"

// Timer 1: a pulse width for each motor, its direction on a pin, and the drivers' fault line on the
// break input, which switches the outputs off without the program. Off, they are driven low.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kWidth = kTimer_MHz * 1000000 / kPulse_Hz;

constexpr uint32_t kPulse = 6u << 4 | 1u << 3;  // of a channel: high below compare, buffered
constexpr uint32_t kOutputs = 1u << 0 | 1u << 4 | 1u << 8;  // channels 1 to 3
constexpr uint32_t kLowWhenOff = 1u << 10 | 1u << 11, kBreakOn = 1u << 12, kBreakHigh = 1u << 13,
                   kMainOutput = 1u << 15, kBreakFilter = 2u << 16;
constexpr uint32_t kBuffered = 1u << 7, kBroken = 1u << 7;  // of control, of state

}  // namespace

void motors_begin() {
  for (const Pin& pin : kDirectionPins) pin_output(pin);
  pin_input(kEnablePin, Pull::kDown);  // closed: high
  pin_input(kStopPin, Pull::kUp);      // a closed contact to ground; pressed or torn off: high
  reg(kTimer1 + kTimerReload) = kWidth - 1;
  reg(kTimer1 + kTimerChannels) = kPulse | kPulse << 8;
  reg(kTimer1 + kTimerChannels + 4) = kPulse;
  reg(kTimer1 + kTimerOutputs) = kOutputs;
  reg(kTimer1 + kTimerBreak) = kLowWhenOff | kBreakOn | kBreakHigh | kBreakFilter;
  reg(kTimer1 + kTimerEvent) = 1;
  reg(kTimer1 + kTimerControl) = kTimerOn | kBuffered;
  pin_alternate(kBreakPin, Pull::kUp);  // fault or torn off: high
  for (const Pin& pin : kPulsePins) pin_alternate(pin);
}

// A break in this tick keeps the outputs off and its flag until the controller has seen it.
void motors_state(bool may_push) {
  const bool is_on = may_push && (reg(kTimer1 + kTimerState) & kBroken) == 0;
  const uint32_t address = kTimer1 + kTimerBreak;
  reg(address) = is_on ? reg(address) | kMainOutput : reg(address) & ~kMainOutput;
  if (!may_push) reg(kTimer1 + kTimerState) = ~kBroken;
  pin_write(kPowerPin, is_on);
}

void motors_write_N(const float (&motor_N)[3]) {
  for (uint32_t i = 0; i < 3; ++i) {
    pin_write(kDirectionPins[i], motor_N[i] < 0);
    reg(kTimer1 + kTimerCompare + 4 * i) = pulse_width(motor_N[i], kFull_N_or_Nm[i], kWidth);
  }
}

// Before board_begin() the port's clock is off, and the pin an input that a resistor pulls down.
void motors_off() {
  switch_on(kRccPorts, kPorts);
  switch_on(kRccTimer1, kTimer1Clock);
  pin_write(kPowerPin, false);
  pin_output(kPowerPin);
  reg(kTimer1 + kTimerBreak) = reg(kTimer1 + kTimerBreak) & ~kMainOutput;
}

uint32_t motors_lines() {
  uint32_t lines = pin_is_high(kEnablePin) ? kMotorsEnable : 0;
  if (pin_is_high(kStopPin)) lines |= kMotorsEmergencyStop;
  if (pin_is_high(kBreakPin) || (reg(kTimer1 + kTimerState) & kBroken) != 0)
    lines |= kMotorsDriveFault;
  return lines;
}

}  // namespace firmtouch::hal
