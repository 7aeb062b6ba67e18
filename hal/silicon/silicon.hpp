#pragma once
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"

// What boards with encoders, motors and UARTs of their own share. A family's header (stm32.hpp)
// defines `Pin` and the functions on UARTs below; a board's registers.hpp the addresses kLink,
// kLinkInterrupt and kConsole, kCore_MHz, the pins that wiring.cpp names, and of each joint
// kFull_N_or_Nm: the force that its motor makes there at full width (torque, where it turns). Of a
// UART:
//   uart_begin      starts it, 8 bits, no parity; one that receives raises its interrupt
//   uart_is_on      false before uart_begin(), also where the UART has no clock yet
//   uart_may_send, uart_send, uart_has_byte, uart_byte    one byte, never waits
namespace firmtouch::hal {

constexpr uint32_t kPulse_Hz = 20000;  // pulse widths: above hearing

struct PinName {  // as printed beside the pin
  char port[5];
  uint32_t number;
};

/// Ticks of `period` for which a motor's pulse is high that makes `full` at full width: 0 for NaN,
/// all of them from `full` on.
inline uint32_t pulse_width(float force, float full, uint32_t period) {
  const float share = (force < 0 ? -force : force) / full;
  if (!(share > 0)) return 0;
  return share < 1.0f ? static_cast<uint32_t>(share * static_cast<float>(period)) : period;
}

void power_begin();  // core clock and caches
void clock_begin();
void cycles_begin();
void console_begin();
void link_begin();
void encoders_begin();
void motors_begin();

/// All of it, once clocks and pins are set.
inline void peripherals_begin() {
  console_begin();
  motors_begin();
  encoders_begin();
  clock_begin();
  link_begin();
}

}  // namespace firmtouch::hal
