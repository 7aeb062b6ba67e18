#pragma once
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"

// What boards with encoders, motors and UARTs of their own share. A family's header (stm32.hpp)
// defines `Pin` and the functions on UARTs below; a board's registers.hpp the addresses kLink,
// kLinkInterrupt and kConsole, kCore_MHz, and the pins that wiring.cpp names. Of a UART:
//   uart_begin      starts it, 8 bits, no parity; one that receives raises its interrupt
//   uart_is_on      false before uart_begin(), also where the UART has no clock yet
//   uart_may_send, uart_send, uart_has_byte, uart_byte    one byte, never waits
namespace firmtouch::hal {

constexpr uint32_t kPulse_Hz = 20000;  // pulse widths: above hearing
constexpr float kFull_N = 10.0f;       // what a motor makes at full width: yours

struct PinName {  // as printed beside the pin
  char port[5];
  uint32_t number;
};

/// Ticks of `period` for which a motor's pulse is high: 0 for NaN, all of them from kFull_N on.
inline uint32_t pulse_width(float force_N, uint32_t period) {
  const float share = (force_N < 0 ? -force_N : force_N) / kFull_N;
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
