#pragma once
#include "silicon/silicon.hpp"

// UARTs of the STM32, for the end of a board's registers.hpp: kUsart_MHz, and the registers'
// offsets and bits, which older families have elsewhere, are defined before.
namespace firmtouch::hal {

inline void uart_begin(uint32_t uart, uint32_t baud, bool receives) {
  reg(uart + kUsartDivider) = kUsart_MHz * 1000000 / baud;
  reg(uart + kUsartControl) =
      kUsartOn | kTransmitOn | (receives ? kReceiveOn | kReceiveInterrupt : 0);
}
inline bool uart_is_on(uint32_t uart) { return (reg(uart + kUsartControl) & kTransmitOn) != 0; }
inline bool uart_may_send(uint32_t uart) { return (reg(uart + kUsartState) & kTransmitEmpty) != 0; }
inline void uart_send(uint32_t uart, uint8_t byte) { reg(uart + kUsartSent) = byte; }
inline bool uart_has_byte(uint32_t uart) { return (reg(uart + kUsartState) & kReceived) != 0; }
inline uint8_t uart_byte(uint32_t uart) { return static_cast<uint8_t>(reg(uart + kUsartReceived)); }

}  // namespace firmtouch::hal
