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

namespace {

// Index pulses or the counts of second encoders, if the program has them: as the asset says.
template <class OfController>
uint32_t flags_of_joints(const OfController& of) {
  [[maybe_unused]] uint8_t low[record::kAxes];
  if constexpr (OfController::kHasIndexPulses) {
    if (of.device().index_pulses().is_open()) {
      const uint32_t pulses = hal::encoders_index(low);
      return record::flags_of_index(pulses, low);
    }
  }
  if constexpr (OfController::kHasSecondEncoders) {
    hal::encoders_second(low);
    return record::flags_of_second(low);
  }
  return 0;
}

}  // namespace

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
  now.input.flags |= flags_of_joints(controller);
  if (kTwoRates) now.input.flags |= controller.model_flags();

  controller.tick(now.input, now.output);  // calls no HAL: a replay calls it with the same input

  if constexpr (kHasBrake)
    if (!record::may_move(now.output)) hal::motors_brake(false);  // before the power goes
  hal::motors_state(record::may_push(now.output));
  hal::motors_write_N(now.output.motor_N);
  if constexpr (kHasBrake)
    if (record::may_move(now.output)) hal::motors_brake(true);
  if (main_loop.is_alive(max_ticks_of_a_turn())) hal::watchdog_feed();
  after_tick(now.output);
  records.push(now);  // never waits: if the ring is full the record is dropped and counted
  if constexpr (kKeepsCrash)
    hal::crash_keep_tick({now.input.tick, now.input.clock_us, now.output.state, now.output.faults});
  last_work_us = hal::clock_us() - now.input.clock_us;
}

}  // namespace firmtouch::app
