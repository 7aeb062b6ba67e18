#pragma once
#include "silicon/silicon.hpp"

// The RP2350 on its Arm cores (datasheet RP-008373). A board's registers.hpp has its pins and
// crystal. Not run.
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 150;

constexpr uint32_t kClocks = 0x40010000, kPower = 0x40018000, kResets = 0x40020000,
                   kFunctions = 0x40028000, kPads = 0x40038000, kCrystal = 0x40048000,
                   kPll = 0x40050000, kUart0 = 0x40070000, kUart1 = 0x40078000, kPwm = 0x400A8000,
                   kTimer = 0x400B0000, kWatchdog = 0x400D8000, kTicks = 0x40108000;
constexpr uint32_t kPio0 = 0x50200000, kPio1 = 0x50300000, kSio = 0xD0000000;

// Most registers have aliases that set and clear bits.
constexpr uint32_t kSet = 0x2000, kClear = 0x3000;

// Resets: offset of the state, bits.
constexpr uint32_t kReleased = 0x8;
constexpr uint32_t kResetPins = 1u << 6 | 1u << 9, kResetPio0 = 1u << 11, kResetPio1 = 1u << 12,
                   kResetPll = 1u << 14, kResetPwm = 1u << 16, kResetTimer = 1u << 23,
                   kResetUart0 = 1u << 26, kResetUart1 = 1u << 27;

/// Ends the reset of blocks; when it returns, they answer.
inline void release(uint32_t blocks) {
  reg(kResets + kClear) = blocks;
  while ((reg(kResets + kReleased) & blocks) != blocks) {
  }
}

struct Pin {
  uint32_t number;
};
inline PinName name_of(const Pin& pin) { return {{'G', 'P'}, pin.number}; }

constexpr uint32_t kUartFunction = 2, kPwmFunction = 4, kSioFunction = 5, kPio0Function = 6,
                   kPio1Function = 7;
constexpr uint32_t kDrivenLow = 2u << 12 | 3u << 14;  // whatever the function says
constexpr uint32_t kPullUp = 1u << 3;

/// Connects a pin, then ends its isolation: input on, Schmitt trigger, 4 mA.
inline void pin_as(const Pin& pin, uint32_t function, uint32_t pull = 0) {
  reg(kFunctions + 8 * pin.number + 4) = function;
  reg(kPads + 4 + 4 * pin.number) = 1u << 6 | 1u << 4 | 1u << 1 | pull;
}
inline bool pin_is_high(const Pin& pin) { return (reg(kSio + 0x04) >> pin.number & 1u) != 0; }
inline void pin_write(const Pin& pin, bool high) {
  reg(kSio + (high ? 0x18 : 0x20)) = 1u << pin.number;
}

// UARTs (PL011).
constexpr uint32_t kUartData = 0x00, kUartState = 0x18, kUartDivider = 0x24, kUartFraction = 0x28,
                   kUartLine = 0x2C, kUartControl = 0x30, kUartLevel = 0x34, kUartInterrupts = 0x38;
void uart_begin(uint32_t uart, uint32_t baud, bool receives);
inline bool uart_is_on(uint32_t uart) {
  const uint32_t block = uart == kUart0 ? kResetUart0 : kResetUart1;
  return (reg(kResets + kReleased) & block) != 0 && (reg(uart + kUartControl) & 1u) != 0;
}
inline bool uart_may_send(uint32_t uart) { return (reg(uart + kUartState) & 1u << 5) == 0; }
inline void uart_send(uint32_t uart, uint8_t byte) { reg(uart + kUartData) = byte; }
inline bool uart_has_byte(uint32_t uart) { return (reg(uart + kUartState) & 1u << 4) == 0; }
inline uint8_t uart_byte(uint32_t uart) { return static_cast<uint8_t>(reg(uart + kUartData)); }

}  // namespace firmtouch::hal
