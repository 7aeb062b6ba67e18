#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Starts the servo interrupt on SysTick, clocked by the core. A period beyond SysTick's 24 bits is
/// shortened to the longest possible one.
void start_servo_timer(uint32_t period_us, uint32_t core_MHz, void (*tick)());

}  // namespace firmtouch::hal
