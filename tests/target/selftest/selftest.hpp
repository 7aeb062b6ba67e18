#pragma once
#include <stdint.h>

#include "firmtouch/hal/asset_slots.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/link.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/parameters.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "firmtouch/hal/wiring.hpp"

// The self-test of a new board: every function of the HAL in turn. It prints a line a check and
// what a person must do meanwhile. hal/PORTING.md says how to run it.

#ifdef FIRMTOUCH_PLANTED
#include "target/selftest/planted.hpp"
#endif

namespace firmtouch::selftest {

#ifdef FIRMTOUCH_PLANTED
namespace hal = planted;                 // the same functions, one of them broken
constexpr uint32_t kPatience_ms = 1000;  // the simulated person is quick
constexpr uint32_t kEcho_ms = 10000, kLongRun_ms = 4000;
#else
constexpr uint32_t kPatience_ms = 30000, kEcho_ms = 30000;
constexpr uint32_t kLongRun_ms = 12000;  // a counter of 32 bits at 400 MHz runs over
#endif

struct Totals {
  uint32_t passed, failed;
};
extern Totals totals;

/// Prints a line of the report. Result: `good`.
bool check(const char* function, bool good, const char* remedy, const char* more = "");
void skip(const char* function, const char* reason);
void print(uint32_t value);
/// Prints the totals and ends the program.
[[noreturn]] void end();

enum class Prompt : uint8_t {
  kEchoLink,
  kOpenEnable,
  kCloseEnable,
  kPressStop,
  kReleaseStop,
  kBreakDrive,
  kMendDrive,
  kTurnJoint1,
  kTurnJoint2,
  kTurnJoint3,
  kLetGo,
  kCount
};
extern const char* const kPrompts[static_cast<uint32_t>(Prompt::kCount)];
void show(Prompt what);

// The servo's interrupt reads and writes these; the functions below wait for it.
struct Servo {
  volatile uint32_t ticks, us, lines;
  volatile int32_t counts[3];
  volatile bool counts_are_valid;
  volatile bool may_push;     // motors_state(), as long as only the enable line is set
  volatile bool calls_state;  // whether motors_state() is called
  volatile bool feeds;        // the watchdog
  volatile float force_N[3];
  volatile bool has_ended;
  const char* volatile called;  // what the main loop calls and must return from
};
extern Servo servo;
void wait_ms(uint32_t ms);
/// Waits until `is_so()`, for a person's patience at most. Result: is_so().
template <class Condition>
bool comes(Condition is_so, uint32_t patience_ms = kPatience_ms) {
  const uint32_t from = servo.ticks;
  while (!is_so() && servo.ticks - from < patience_ms) {
  }
  return is_so();
}

void check_board();
void check_flash();
void start_servo();
/// Starts the servo at one tick a millisecond. Result: whether it ticks.
bool check_clock();
void check_long_run();
void check_link();
void check_lines();
void check_encoders();
void check_motors();
/// If a reset of the last run's watchdog began this run: reports it and ends.
void after_reset();
/// Counts a tick for it.
void note_tick();
void check_feeding();
void check_starving();

}  // namespace firmtouch::selftest
