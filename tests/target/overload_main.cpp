// The controller program under a load that the emulator's command line names, in per cent of a
// period: a query of that length, while the motors push. `hang` stops the main loop instead. Prints
// what became of it; tests/target/run_overload checks it.
#include <stdint.h>

#include "emulator/semihosting.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/servo/fault.hpp"
#include "host_session.hpp"
#include "pressed_app.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

using namespace firmtouch;  // NOLINT: a test program
using target::print;

namespace {

constexpr uint32_t kEnable_ticks = 20;
constexpr uint32_t kOverload_ticks = 400;  // the ramp in is over
constexpr uint32_t kEnd_ticks = 500;

// Written by the interrupt; the main loop reads it once the servo's part is over.
struct Seen {
  uint32_t load_us = 0;   // longest tick
  uint32_t faults = 0;    // all
  uint32_t fault_at = 0;  // ticks from the first overloaded one to the fault; 0: none
  uint32_t still_at = 0;  // to the first without a force, after which none came back
  uint32_t turns = 0;     // of the main loop in the last 50 ticks
  float pushed_N = 0;     // before the overload
};
Seen g_seen;
uint32_t g_percent = 0;
uint32_t g_tick = 0;
uint32_t g_tick_began_us = 0;
volatile bool g_is_over = false;

float size_of(const float (&force_N)[3]) {
  float sum = 0;
  for (const float f : force_N) sum += f < 0 ? -f : f;
  return sum;
}

bool is_overloaded() { return g_percent != 0 && g_tick >= kOverload_ticks; }

void look_at(const record::TickInput& input, const record::TickOutput& output) {
  static uint32_t turns_before = 0;
  const float force_N = size_of(output.motor_N);
  const uint32_t since = g_tick - kOverload_ticks;
  if (g_tick > kEnable_ticks && input.last_work_us > g_seen.load_us)
    g_seen.load_us = input.last_work_us;
  g_seen.faults |= output.faults;
  if (g_tick < kOverload_ticks) {
    g_seen.pushed_N = force_N;
  } else {
    if (output.faults != 0 && g_seen.fault_at == 0) g_seen.fault_at = since;
    if (force_N > 0) g_seen.still_at = since + 1;
  }
  if (g_tick == kEnd_ticks - 50) turns_before = app::main_loop.turns();
  if (g_tick == kEnd_ticks) {
    g_seen.turns = app::main_loop.turns() - turns_before;
    g_is_over = true;
  }
}

uint32_t number_of(const char* text) {
  uint32_t value = 0;
  for (; *text >= '0' && *text <= '9'; ++text)
    value = value * 10 + static_cast<uint32_t>(*text - '0');
  return value;
}

}  // namespace

namespace firmtouch {

void target::BusySurface::touch(const ModelRequest& request, const params::Values& values,
                                ModelResult& result) {
  press_wall(request, values, result);
  const uint32_t busy_us = is_overloaded() ? app::servo_period_us() / 100 * g_percent : 0;
  while (hal::clock_us() - g_tick_began_us < busy_us) {
  }
}

void app::AppController::tick(const record::TickInput& input, record::TickOutput& output) {
  g_tick = input.tick;
  g_tick_began_us = input.clock_us;
  Controller::tick(input, output);
  look_at(input, output);
}

void hal::motors_state(bool) {}
void hal::motors_write_N(const float (&)[3]) {}
void hal::motors_off() {}
uint32_t hal::motors_lines() { return g_tick >= kEnable_ticks ? kMotorsEnable : 0; }

}  // namespace firmtouch

int main() {
  hal::board_begin();
  char line[64];
  if (!hal::semihosting_command_line(line, sizeof line)) return 2;
  const bool hangs = line[0] == 'h';
  g_percent = number_of(line);
  if (!target::open_nothing()) return 3;
  static app::HostSession session;
  app::start_servo();
  while (!g_is_over) {
    app::main_loop.count();
    session.poll();
    while (hangs && app::records.waiting() > 0) asm volatile("nop" ::: "memory");
  }
  print("load ", g_percent);
  print(" %: longest tick ", g_seen.load_us);
  print(" us, faults ", g_seen.faults);
  print(", after ", g_seen.fault_at);
  print(" ticks, no force after ", g_seen.still_at);
  print(" ticks, turns of the main loop in 50 ticks: ", g_seen.turns);
  hal::board_print("\n");
  const bool is_fault_wanted = g_percent >= 90;
  const bool is_good = g_seen.pushed_N > 1 && (g_seen.faults != 0) == is_fault_wanted &&
                       (!is_fault_wanted || (g_seen.fault_at <= 10 && g_seen.still_at <= 20)) &&
                       g_seen.turns >= 50;
  hal::board_exit(is_good ? 0 : 1);
}
