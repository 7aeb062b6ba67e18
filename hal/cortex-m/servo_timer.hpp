#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// The servo interrupt on SysTick, which runs at the core's clock. Longer periods than 24 bits hold are shortened.
void start_servo_timer(uint32_t period_us, uint32_t core_MHz, void (*tick)());

}  // namespace firmtouch::hal
