#include "demo/joints.hpp"

#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/pace.hpp"

namespace firmtouch::demo {

Joints joints;

}  // namespace firmtouch::demo

namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  pace_tick();
  for (uint32_t k = 0; k < 3; ++k) counts[k] = demo::joints.counts[k];
  return demo::joints.are_valid;
}

void motors_write_N(const float (&motor_N)[3]) {
  for (uint32_t k = 0; k < 3; ++k) {
    demo::joints.motor_N[k] = motor_N[k];
    if (motor_N[k] > 0 || motor_N[k] < 0) demo::joints.pushed_us = clock_us();
  }
}

void motors_state(bool) {}

void motors_off() {}

uint32_t motors_lines() { return demo::joints.lines; }

}  // namespace firmtouch::hal
