#include "firmtouch/hal/motors.hpp"

#include "registers.hpp"
#include "rp2350/pio.hpp"

// A slice for each motor's pulse, its direction on a pin. The slices have no break input: a state
// machine of PIO1 drives the drivers' enable, and ends it two cycles behind a fault.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kWidth = kCore_MHz * 1000000 / kPulse_Hz;
constexpr uint32_t kSlice_bytes = 0x14, kSliceOn = 0x00, kCompare = 0x0C, kTop = 0x10;

constexpr PioMachine kGuard = {kPio1, 0};
constexpr uint32_t kGuardOff = 0, kGuardWaits = 1, kGuardWatches = 2, kGuardLast = 3;
constexpr uint16_t kGuardProgram[] = {pio_set(PioTo::kPins, 0),
                                      pio_wait_for_word(),               // from motors_state()
                                      pio_jump(kGuardOff, PioIf::kPin),  // a fault
                                      pio_set(PioTo::kPins, 1)};

bool g_may_push = false;

bool is_broken() { return g_may_push && (reg(kGuard.at(kPioAddress)) & 31u) <= kGuardWaits; }

}  // namespace

void motors_begin() {
  release(kResetPwm);
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t slice = kPwm + kSlice_bytes * i;
    reg(slice + kTop) = kWidth - 1;
    reg(slice + kCompare) = 0;
    reg(slice + kSliceOn) = 1;
    reg(kSio + 0x38) = 1u << kDirectionPins[i].number;  // output
    pin_as(kDirectionPins[i], kSioFunction);
  }
  pin_as(kBreakPin, kSioFunction, kPullUp);  // fault or torn off: high
  pin_as(kStopPin, kSioFunction, kPullUp);   // a closed contact to ground
  pin_as(kEnablePin, kSioFunction);          // yours: 4.7 kOhm to ground (erratum RP2350-E9)
  pio_load(kPio1, kGuardProgram);
  reg(kGuard.at(kPioPins)) = 1u << 26 | kPowerPin.number << 5;
  pio_execute(kGuard, pio_set(PioTo::kPinDirections, 1));
  pio_start(kGuard, kGuardLast, kGuardWatches, kGuardOff, kBreakPin.number << 24);
}

// A break in this tick keeps the outputs off and its flag until the controller has seen it.
void motors_state(bool may_push) {
  const bool begins = may_push && !g_may_push;
  if (!may_push || is_broken()) {
    motors_off();
  } else if (begins) {
    reg(kPio1 + kPioSend) = 1;
    for (const Pin& pin : kPulsePins) pin_as(pin, kPwmFunction);
    pin_as(kPowerPin, kPio1Function);
  }
  g_may_push = may_push;
}

void motors_write_N(const float (&motor_N)[3]) {
  for (uint32_t i = 0; i < 3; ++i) {
    pin_write(kDirectionPins[i], motor_N[i] < 0);
    reg(kPwm + kSlice_bytes * i + kCompare) = pulse_width(motor_N[i], kFull_N_or_Nm[i], kWidth);
  }
}

// At reset the pins are isolated, and pulled down weakly.
void motors_off() {
  release(kResetPins | kResetPio1);
  pin_as(kPowerPin, kSioFunction | kDrivenLow);
  for (const Pin& pin : kPulsePins) pin_as(pin, kSioFunction | kDrivenLow);
  pio_execute(kGuard, pio_jump(kGuardOff));
}

uint32_t motors_lines() {
  uint32_t lines = pin_is_high(kEnablePin) ? kMotorsEnable : 0;
  if (pin_is_high(kStopPin)) lines |= kMotorsEmergencyStop;
  if (pin_is_high(kBreakPin) || is_broken()) lines |= kMotorsDriveFault;
  return lines;
}

}  // namespace firmtouch::hal
