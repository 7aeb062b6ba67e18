#pragma once
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"

// Arm MPS2 with AN500 (DAI 0500) and the CMSDK peripherals on it (DDI 0479).
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 25;  // core and peripherals alike

constexpr uint32_t kTimer0 = 0x40000000;  // +0 control, +4 value (counts down), +8 reload
// +0 load, +4 value, +8 control, +C interrupt clear, +C00 lock.
constexpr uint32_t kWatchdog = 0x40008000;
constexpr uint32_t kUart0 = 0x40004000;
constexpr uint32_t kUart1 = 0x40005000;

constexpr uint32_t kUartData = 0x0, kUartState = 0x4, kUartControl = 0x8, kUartInterrupt = 0xC,
                   kUartDivider = 0x10;
constexpr uint32_t kTransmitFull = 1u << 0, kReceiveFull = 1u << 1;  // of state
constexpr uint32_t kTransmitOn = 1u << 0, kReceiveOn = 1u << 1,
                   kReceiveInterrupt = 1u << 3;  // of control

constexpr uint32_t kUart1Receive = 2;  // interrupt number

void clock_begin();
void link_begin();

}  // namespace firmtouch::hal
