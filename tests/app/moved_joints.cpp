#include "app/moved_joints.hpp"

#include <cstring>

#include "app/tick_source.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"

namespace firmtouch {

app_test::MovedJoints app_test::joints;

namespace hal {

using app_test::input_of;
using app_test::joints;

uint32_t clock_us() { return input_of(joints.tick).clock_us; }
uint32_t clock_work() { return 0; }
uint32_t clock_work_per_1000() { return 0; }
void clock_start_servo(uint32_t, void (*)()) {}
bool encoders_read(int32_t (&counts)[3]) {
  for (uint32_t k = 0; k < 3; ++k) counts[k] = input_of(joints.tick).encoder_counts[k];
  return true;
}
void motors_write_N(const float (&motor_N)[3]) {
  if (joints.motors != nullptr)
    std::memcpy(joints.motors + size_t{3} * joints.tick, motor_N, sizeof motor_N);
}
void motors_state(bool) {}
void motors_off() {}
uint32_t motors_lines() { return input_of(joints.tick).flags & joints.lines; }
void board_print(const char*) {}
void watchdog_begin(uint32_t) {}
void watchdog_feed() {}

}  // namespace hal
}  // namespace firmtouch
