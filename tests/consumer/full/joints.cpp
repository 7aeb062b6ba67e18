// Joints of a CoreXY gantry that the scripted hand moves: belts by x + y and x - y.
#include "../hand.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

namespace firmtouch::hal {

bool encoders_read(int32_t (&counts)[3]) {
  int32_t hand[3];
  hand_counts(clock_us() / 1000, hand);
  counts[0] = hand[0] + hand[1];
  counts[1] = hand[0] - hand[1];
  counts[2] = hand[2];
  return true;
}

void motors_write_N(const float (&)[3]) {}

void motors_state(bool) {}
void motors_off() {}

uint32_t motors_lines() { return kMotorsEnable; }

}  // namespace firmtouch::hal
