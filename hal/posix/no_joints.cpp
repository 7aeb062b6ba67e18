#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"

// A process moves nothing: its counts are never to be trusted and its enable line is never on, so
// that a free-running controller stays in its safe state.
namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  for (int32_t& count : counts) count = 0;
  return false;
}

void motors_write_N(const float (&)[3]) {}
void motors_off() {}
uint32_t motors_lines() { return 0; }

void watchdog_begin(uint32_t) {}
void watchdog_feed() {}

}  // namespace firmtouch::hal
