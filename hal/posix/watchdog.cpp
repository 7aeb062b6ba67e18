#include "firmtouch/hal/watchdog.hpp"

// A process has no power stage to switch off.
namespace firmtouch::hal {

void watchdog_begin(uint32_t) {}
void watchdog_feed() {}

}  // namespace firmtouch::hal
