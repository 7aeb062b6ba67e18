#pragma once
#include <stdint.h>

// Arm MPS2 with AN500 (DAI 0500).
namespace firmtouch::hal {

constexpr uint32_t kCore_MHz = 25;
constexpr uint32_t kUart_MHz = kCore_MHz;

constexpr uint32_t kTimer0 = 0x40000000;  // +0 control, +4 value (counts down), +8 reload
// +0 load, +4 value, +8 control, +C interrupt clear, +C00 lock.
constexpr uint32_t kWatchdog = 0x40008000;
constexpr uint32_t kConsole = 0x40004000, kLink = 0x40005000;

constexpr uint32_t kLinkInterrupt = 2;

}  // namespace firmtouch::hal

#include "cmsdk/cmsdk.hpp"  // of the constants above
