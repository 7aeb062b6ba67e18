#pragma once
#include <stdint.h>

// Arm MPS3 with AN547 (DAI 0547): SSE-300, in secure state, as after reset.
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 32;  // core, SysTick, system counter

constexpr uint32_t kCounter = 0x58100000;  // system counter: +0 control, +8 value
// +0 load, +4 value, +8 control, +C interrupt clear. Clocked by 32,768 Hz.
constexpr uint32_t kWatchdog = 0x5802E000;
constexpr uint32_t kConsole = 0x59303000, kLink = 0x59304000;
constexpr uint32_t kUart_MHz = 25;

constexpr uint32_t kLinkInterrupt = 35;

}  // namespace firmtouch::hal

#include "cmsdk/cmsdk.hpp"  // of the constants above
