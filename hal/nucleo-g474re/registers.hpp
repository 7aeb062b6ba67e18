#pragma once
#include "stm32/stm32.hpp"

// STM32G474RE (RM0440) on a NUCLEO-G474RE (UM2505). Not run.
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 170, kTimer_MHz = 170, kUsart_MHz = 170;

constexpr uint32_t kRcc = 0x40021000;
constexpr uint32_t kRccPorts = kRcc + 0x4C, kPorts = 0x7;                    // A, B, C
constexpr uint32_t kRccTimers = kRcc + 0x58;                                 // TIM2 to TIM5,
constexpr uint32_t kTimersAndUsarts = 0xF | 1u << 17 | 1u << 18 | 1u << 28;  // USART2, 3, PWR
constexpr uint32_t kRccTimer1 = kRcc + 0x60, kTimer1Clock = 1u << 11;
constexpr uint32_t kPortA = 0x48000000, kPortB = 0x48000400, kPortC = 0x48000800;
constexpr uint32_t kTimer1 = 0x40012C00, kTimer5 = 0x40000C00;
constexpr uint32_t kEncoderTimers[3] = {0x40000000, 0x40000400, 0x40000800};
constexpr uint32_t kWatchdog = 0x40003000;
constexpr uint32_t kResetCause = kRcc + 0x94, kByWatchdog = 1u << 29, kForgetCause = 1u << 23;

// The ST-LINK's serial port is USART2; the console is USART3.
constexpr uint32_t kLink = 0x40004400, kLinkInterrupt = 38, kConsole = 0x40004800;
constexpr Pin kLinkPins[2] = {{kPortA, 2, 7}, {kPortA, 3, 7}};
constexpr Pin kConsolePin = {kPortB, 10, 7};

constexpr Pin kEncoderPins[6] = {{kPortA, 0, 1}, {kPortA, 1, 1}, {kPortC, 6, 2},
                                 {kPortC, 7, 2}, {kPortB, 6, 2}, {kPortB, 7, 2}};
constexpr float kFull_N_or_Nm[3] = {10, 10, 10};  // of a motor at full width: yours
constexpr Pin kPulsePins[3] = {{kPortA, 8, 6}, {kPortA, 9, 6}, {kPortA, 10, 6}};
constexpr Pin kDirectionPins[3] = {{kPortB, 13}, {kPortB, 14}, {kPortB, 15}};
constexpr Pin kBreakPin = {kPortB, 12, 6};
constexpr Pin kPowerPin = {kPortC, 8}, kEnablePin = {kPortC, 10}, kStopPin = {kPortC, 11};

}  // namespace firmtouch::hal

#include "stm32/uart.hpp"  // of the constants above
