#pragma once
#include <stdint.h>

#include "silicon/silicon.hpp"

// STM32F405 (RM0090). The chip runs on its 16 MHz internal oscillator, as after reset. A product
// starts the PLL in board_begin() and changes core_MHz() and timer_MHz().
namespace firmtouch::hal {

constexpr uint32_t kRccControl = 0x40023800;     // b0 internal oscillator on: reads 1 on the chip
constexpr uint32_t kRccAhb1Enable = 0x40023830;  // b0 port A, b2 port C
constexpr uint32_t kRccApb1Enable = 0x40023840;  // b0 TIM2, b3 TIM5, b17 USART2
constexpr uint32_t kRccApb2Enable = 0x40023844;  // b4 USART1
constexpr uint32_t kPortA = 0x40020000;          // +00 mode, +20 and +24 alternate functions
// +00 control, +14 event, +24 counter, +28 prescaler, +2C reload.
constexpr uint32_t kTimer2 = 0x40000000;
constexpr uint32_t kTimer5 = 0x40000C00;
constexpr uint32_t kWatchdog = 0x40003000;  // +00 key, +04 prescaler, +08 reload
constexpr uint32_t kResetCause = 0x40023874, kByWatchdog = 1u << 29, kForgetCause = 1u << 24;
constexpr uint32_t kConsole = 0x40011000;                    // USART1
constexpr uint32_t kLink = 0x40004400, kLinkInterrupt = 38;  // USART2

constexpr uint32_t kUsartState = 0x0, kUsartReceived = 0x4, kUsartSent = 0x4, kUsartDivider = 0x8,
                   kUsartControl = 0xC;
constexpr uint32_t kReceived = 1u << 5, kTransmitEmpty = 1u << 7;  // of state
constexpr uint32_t kReceiveOn = 1u << 2, kTransmitOn = 1u << 3, kReceiveInterrupt = 1u << 5,
                   kUsartOn = 1u << 13;

/// QEMU has no RCC (it reads zeros), runs the core's SysTick at 168 MHz and the timers at 1 GHz.
inline bool is_emulated() { return (reg(kRccControl) & 1u) == 0; }
inline uint32_t core_MHz() { return is_emulated() ? 168 : 16; }
inline uint32_t timer_MHz() { return is_emulated() ? 1000 : 16; }
constexpr uint32_t kUsart_MHz = 16;

}  // namespace firmtouch::hal

#include "stm32/uart.hpp"  // of the constants above
