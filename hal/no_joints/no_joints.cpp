#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

// A board with nothing moving on it, as every emulated one, or a process. Its counts are never to be trusted and its
// enable line is never on, so that a free-running controller stays in its safe state; a simulator gives and takes whole
// ticks over the link instead.
namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  for (int32_t& count : counts) count = 0;
  return false;
}

void motors_write_N(const float (&)[3]) {}

void motors_off() {}

uint32_t motors_lines() { return 0; }

}  // namespace firmtouch::hal
