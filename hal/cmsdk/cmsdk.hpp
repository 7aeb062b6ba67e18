#pragma once
#include "silicon/silicon.hpp"

// Arm's CMSDK peripherals (DDI 0479), as on the boards MPS2 and MPS3, for the end of a board's
// registers.hpp, which has the addresses. A board defines the last two functions.
namespace firmtouch::hal {

constexpr uint32_t kUartData = 0x0, kUartState = 0x4, kUartControl = 0x8, kUartInterrupt = 0xC,
                   kUartDivider = 0x10;
constexpr uint32_t kTransmitFull = 1u << 0, kReceiveFull = 1u << 1;  // of state
constexpr uint32_t kTransmitOn = 1u << 0, kReceiveOn = 1u << 1,
                   kReceiveInterrupt = 1u << 3;  // of control

/// 1 Mbaud needs a divider of 16 at least (DDI 0479, 4.3).
inline void uart_begin(uint32_t uart, uint32_t baud, bool receives) {
  reg(uart + kUartDivider) = kUart_MHz * 1000000 / baud;
  reg(uart + kUartControl) = kTransmitOn | (receives ? kReceiveOn | kReceiveInterrupt : 0);
}
inline bool uart_is_on(uint32_t uart) { return (reg(uart + kUartControl) & kTransmitOn) != 0; }
inline bool uart_may_send(uint32_t uart) { return (reg(uart + kUartState) & kTransmitFull) == 0; }
inline void uart_send(uint32_t uart, uint8_t byte) { reg(uart + kUartData) = byte; }
inline bool uart_has_byte(uint32_t uart) { return (reg(uart + kUartState) & kReceiveFull) != 0; }
inline uint8_t uart_byte(uint32_t uart) {
  reg(uart + kUartInterrupt) = 2;
  return static_cast<uint8_t>(reg(uart + kUartData));
}

/// Starts the counter behind clock_work(), which counts kCore_MHz. Defined by the board.
void work_counter_begin();
/// Ticks of the watchdog in `timeout_us`. Defined by the board.
uint32_t watchdog_ticks(uint32_t timeout_us);

}  // namespace firmtouch::hal
