#include "parts/loop.hpp"
#include "target/selftest/selftest.hpp"

// Two clocks check each other: microseconds and the servo's interrupt. A count of instructions
// checks the counter of work.
namespace firmtouch::selftest {
namespace {

constexpr uint32_t kTick_us = 1000;

uint32_t g_began_us = 0, g_began_ticks = 0;  // of the long run
uint32_t g_us_per_100_ticks = 0;

// What would stay silent otherwise: a call that does not return, ticks behind board_exit().
void look_after_main_loop() {
  static uint32_t ticks_of_call = 0, ticks_of_end = 0;
  ticks_of_call = servo.called != nullptr ? ticks_of_call + 1 : 0;
  if (ticks_of_call == 1000) {
    check(servo.called, false, "it does not return");
    servo.called = nullptr;
    end();
  }
  if (servo.has_ended && ++ticks_of_end == 2)
    check("board_exit", false, "the servo still ticks: mask interrupts first");
}

void tick() {
  servo.ticks = servo.ticks + 1;
  servo.us = hal::clock_us();
  int32_t counts[3];
  servo.counts_are_valid = hal::encoders_read(counts);
  for (uint32_t i = 0; i < 3; ++i) servo.counts[i] = counts[i];
  servo.lines = hal::motors_lines();
  const bool may_push = servo.may_push && servo.lines == hal::kMotorsEnable;
  if (servo.calls_state) hal::motors_state(may_push);
  hal::motors_write_N({servo.force_N[0], servo.force_N[1], servo.force_N[2]});
  if (servo.feeds) hal::watchdog_feed();
  note_tick();
  look_after_main_loop();
}

bool check_microseconds() {
  const uint32_t from_us = hal::clock_us();
  uint32_t last_us = from_us;
  bool goes_on = true;
  // 200 ms, beyond a counter of 16 bits; at most about a second of instructions if it stands.
  for (uint32_t reads = 0; reads < 10000000 && last_us - from_us < 200000 && goes_on; ++reads) {
    const uint32_t now_us = hal::clock_us();
    goes_on = now_us - last_us < 1000;
    last_us = now_us;
    if (reads == 100000 && last_us == from_us) break;
  }
  return check("clock_us", goes_on && last_us - from_us >= 200000,
               goes_on ? "it stands still: the timer's clock, its enable bit"
                       : "it jumps: the timer's width, or it is read while it carries");
}

[[gnu::noinline]] uint32_t work_of(uint32_t turns) {
  const uint32_t before = hal::clock_work();
  hal::turn(turns);
  return hal::clock_work() - before;
}

void check_work() {
  const uint32_t per_1000 = hal::clock_work_per_1000();
  if (per_1000 == 0) return skip("clock_work", "this board does not measure work");
  constexpr uint32_t kInstructions = 20000;
  const uint32_t work = work_of(kInstructions / 2 + 1) - work_of(1);
  // A core takes half a cycle to five cycles an instruction; an emulator counts them.
  const uint64_t counted = uint64_t{work} * 1000 / per_1000;
  check("clock_work, clock_work_per_1000",
        counted >= kInstructions / 2 && counted <= kInstructions * 5,
        work == 0 ? "it stands still" : "20,000 instructions give another number");
}

/// Microseconds of 100 ticks; 0 if there are none.
uint32_t us_of_100_ticks() {
  const uint32_t first = servo.ticks, called_us = hal::clock_us();
  while (servo.ticks == first && hal::clock_us() - called_us < 200000) {
  }
  const uint32_t from_us = hal::clock_us();
  while (servo.ticks - first < 101 && hal::clock_us() - from_us < 500000) {
  }
  return servo.ticks - first < 101 ? 0 : hal::clock_us() - from_us;
}

bool is_near(uint32_t value, uint32_t expected) {
  return value >= expected - expected / 50 && value <= expected + expected / 50;
}

}  // namespace

void start_servo() {
  servo.calls_state = true;
  hal::clock_start_servo(kTick_us, tick);
}

bool check_clock() {
  if (!check_microseconds()) return false;
  check_work();
  start_servo();
  g_us_per_100_ticks = us_of_100_ticks();
  if (!check("clock_start_servo", g_us_per_100_ticks != 0,
             "no interrupt in 0.2 s of clock_us(): vector table, timer, priority; or clock_us() is "
             "fast"))
    return false;
  check("clock_start_servo, 1 ms", is_near(g_us_per_100_ticks, 100 * kTick_us),
        "its milliseconds differ from those of clock_us: a clock rate is wrong");
  hal::clock_start_servo(kTick_us / 2, tick);
  check("clock_start_servo, period changed", is_near(us_of_100_ticks(), g_us_per_100_ticks / 2),
        "a second call must change the period");
  hal::clock_start_servo(kTick_us, tick);
  g_began_us = hal::clock_us();
  g_began_ticks = servo.ticks;
  return true;
}

void check_long_run() {
  while (servo.ticks - g_began_ticks < kLongRun_ms) {
  }
  wait_ms(1);
  const uint64_t expected_us = uint64_t{servo.ticks - g_began_ticks} * g_us_per_100_ticks / 100;
  check("clock_us, long run", is_near(servo.us - g_began_us, static_cast<uint32_t>(expected_us)),
        "it must count 32 bits of microseconds: some counter below it ran over");
}

}  // namespace firmtouch::selftest
