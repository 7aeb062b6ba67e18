#pragma once
#include <stdint.h>

// QEMU's riscv32 `virt`: CLINT and one 16550 UART.
namespace firmtouch::hal {

inline volatile uint32_t& reg(uint32_t address) {
  return *reinterpret_cast<volatile uint32_t*>(static_cast<uintptr_t>(address));
}
inline volatile uint8_t& byte_reg(uint32_t address) {
  return *reinterpret_cast<volatile uint8_t*>(static_cast<uintptr_t>(address));
}

constexpr uint32_t kTimer = 0x0200BFF8, kTimerCompare = 0x02004000;
constexpr uint32_t kTimer_MHz = 10;
constexpr uint32_t kUart = 0x10000000, kUartState = kUart + 5;
constexpr uint8_t kTransmitEmpty = 1u << 5;

}  // namespace firmtouch::hal
