#pragma once
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"

// Arm MPS3 with AN547 (DAI 0547): SSE-300, in secure state, as after reset. CMSDK peripherals (DDI
// 0479).
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 32;  // core, SysTick, system counter

constexpr uint32_t kCounter = 0x58100000;  // system counter: +0 control, +8 value
// +0 load, +4 value, +8 control, +C interrupt clear. Clocked by 32,768 Hz.
constexpr uint32_t kWatchdog = 0x5802E000;
constexpr uint32_t kUart0 = 0x59303000;
constexpr uint32_t kUart1 = 0x59304000;
constexpr uint32_t kUart_MHz = 25;

constexpr uint32_t kUartData = 0x0, kUartState = 0x4, kUartControl = 0x8, kUartInterrupt = 0xC,
                   kUartDivider = 0x10;
constexpr uint32_t kTransmitFull = 1u << 0, kReceiveFull = 1u << 1;  // of state
constexpr uint32_t kTransmitOn = 1u << 0, kReceiveOn = 1u << 1,
                   kReceiveInterrupt = 1u << 3;  // of control

constexpr uint32_t kUart1Receive = 35;  // interrupt number

void clock_begin();
void link_begin();

}  // namespace firmtouch::hal
