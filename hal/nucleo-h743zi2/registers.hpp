#pragma once
#include "stm32/stm32.hpp"

// STM32H743ZI (RM0433) on a NUCLEO-H743ZI2 (UM2407). Not run. The QSPI pins are free (qspi.cpp).
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 400, kTimer_MHz = 200, kUsart_MHz = 100;

constexpr uint32_t kRcc = 0x58024400;
constexpr uint32_t kRccPorts = kRcc + 0xE0, kPorts = 0x1F;        // A to E
constexpr uint32_t kRccTimers = kRcc + 0xE8;                      // TIM2 to TIM5,
constexpr uint32_t kTimersAndUsarts = 0xF | 1u << 17 | 1u << 18;  // USART2, 3
constexpr uint32_t kRccTimer1 = kRcc + 0xF0, kTimer1Clock = 1u << 0;
constexpr uint32_t kPortA = 0x58020000, kPortB = 0x58020400, kPortC = 0x58020800,
                   kPortD = 0x58020C00, kPortE = 0x58021000;
constexpr uint32_t kTimer1 = 0x40010000, kTimer5 = 0x40000C00;
constexpr uint32_t kEncoderTimers[3] = {0x40000000, 0x40000400, 0x40000800};
constexpr uint32_t kWatchdog = 0x58004800;
constexpr uint32_t kResetCause = kRcc + 0xD0, kByWatchdog = 1u << 26, kForgetCause = 1u << 16;

// The ST-LINK's serial port is USART3; the console is USART2.
constexpr uint32_t kLink = 0x40004800, kLinkInterrupt = 39, kConsole = 0x40004400;
constexpr Pin kLinkPins[2] = {{kPortD, 8, 7}, {kPortD, 9, 7}};
constexpr Pin kConsolePin = {kPortD, 5, 7};

constexpr Pin kEncoderPins[6] = {{kPortA, 5, 1}, {kPortB, 3, 1}, {kPortC, 6, 2},
                                 {kPortC, 7, 2}, {kPortB, 6, 2}, {kPortB, 7, 2}};
constexpr float kFull_N_or_Nm[3] = {10, 10, 10};  // of a motor at full width: yours
constexpr Pin kPulsePins[3] = {{kPortE, 9, 1}, {kPortE, 11, 1}, {kPortE, 13, 1}};
constexpr Pin kDirectionPins[3] = {{kPortE, 10}, {kPortE, 12}, {kPortE, 14}};
constexpr Pin kBreakPin = {kPortE, 15, 1};
constexpr Pin kPowerPin = {kPortE, 4}, kEnablePin = {kPortE, 5}, kStopPin = {kPortE, 3};

}  // namespace firmtouch::hal

#include "stm32/uart.hpp"  // of the constants above
