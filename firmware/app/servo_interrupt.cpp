#include "servo_interrupt.hpp"

#include "demo/hand.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/crash_record.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "servo.hpp"

namespace firmtouch::app {

AppController controller;
link::CommandMailbox commands;
Records records;
TurnWatch main_loop;
SavedCommands saved_commands;

void servo_interrupt() {
  static uint32_t next_tick = 0;
  static uint32_t last_work_us = 0;
  record::TickRecord now{};

  if constexpr (kDemo) demo::move_hand();
  now.input.tick = next_tick++;
  now.input.clock_us = hal::clock_us();
  now.input.last_work_us = last_work_us;
  const bool sets_saved = saved_commands.take(now.input);
  if (!sets_saved) commands.take(now.input);  // at most one parameter a tick
  now.input.flags = servo_flags(sets_saved);
  if (!hal::encoders_read(now.input.encoder_counts)) now.input.flags |= record::kFlagEncoderFault;
  if constexpr (AppController::kComparesEncoders) {
    uint8_t second[record::kAxes];
    hal::encoders_second(second);
    now.input.flags |= record::flags_of_second(second);
  }
  if (kTwoRates) now.input.flags |= controller.model_flags();

  controller.tick(now.input, now.output);  // calls no HAL: a replay calls it with the same input

  hal::motors_state(record::may_push(now.output));
  hal::motors_write_N(now.output.motor_N);
  if (main_loop.is_alive(max_ticks_of_a_turn())) hal::watchdog_feed();
  after_tick(now.output);
  records.push(now);  // never waits: if the ring is full the record is dropped and counted
  if constexpr (kKeepsCrash)
    hal::crash_keep_tick({now.input.tick, now.input.clock_us, now.output.state, now.output.faults});
  last_work_us = hal::clock_us() - now.input.clock_us;
}

}  // namespace firmtouch::app
