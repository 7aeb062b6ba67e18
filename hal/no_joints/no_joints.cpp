#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

// Encoders and motors of a board without joints (emulated boards, processes). Counts are always
// invalid and the enable line is always off, so a free-running controller stays in its safe state.
// A simulator exchanges whole ticks over the link instead.
namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  for (int32_t& count : counts) count = 0;
  return false;
}

void encoders_second(uint8_t (&counts)[3]) {
  for (uint8_t& count : counts) count = 0;
}

uint32_t encoders_index(uint8_t (&counts)[3]) {
  for (uint8_t& count : counts) count = 0;
  return 0;
}

void motors_state(bool) {}

void motors_write_N(const float (&)[3]) {}

void motors_off() {}

uint32_t motors_lines() { return 0; }

}  // namespace firmtouch::hal
