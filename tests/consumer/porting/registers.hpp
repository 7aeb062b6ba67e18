#pragma once
#include "cortex-m/cortex_m.hpp"

namespace firmtouch::hal {

// Arm MPS2 with AN505 (DAI 0505), in secure state, as after reset.
constexpr uint32_t kCore_MHz = 20;          // core, SysTick, timers, UARTs, watchdog
constexpr uint32_t kTimer0 = 0x50000000;    // +0 control, +4 value (counts down), +8 reload
constexpr uint32_t kWatchdog = 0x50081000;  // +0 load, +8 control, +C interrupt clear
// +0 data, +4 state (b0 transmit full, b1 received), +8 control, +C interrupt, +10 divider.
constexpr uint32_t kConsole = 0x50200000, kLink = 0x50201000;
constexpr uint32_t kLinkInterrupt = 34;

void clock_begin();
void link_begin();

}  // namespace firmtouch::hal
