#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"

using namespace firmtouch;

Controller<Surfaces<MeshSurface>> controller;  // what the type does not name is not linked

void servo_interrupt() {
  static uint32_t next_tick = 0, last_work_us = 0;
  record::TickInput input{};
  record::TickOutput output;
  input.tick = next_tick++;
  input.clock_us = hal::clock_us();
  input.last_work_us = last_work_us;  // an overload is a fault
  input.flags = hal::motors_lines();
  if (!hal::encoders_read(input.encoder_counts)) input.flags |= record::kFlagEncoderFault;
  controller.tick(input, output);
  hal::motors_state(record::may_push(output));
  hal::motors_write_N(output.motor_N);
  last_work_us = hal::clock_us() - input.clock_us;
}

int main() {
  hal::board_begin();
  hal::motors_off();
  if (!controller.open(hal::board_asset()).ok()) hal::board_exit(controller.verdict().rule);
  hal::clock_start_servo(1000, servo_interrupt);  // 1 ms, as tick_period says
  for (;;) asm volatile("wfi");
}
