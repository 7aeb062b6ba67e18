// The controller program while its motors push, built as for hardware. The cause whose number lies
// in the asset's slot must switch the power stage off and engage the brake; tests/target/run_stop
// checks what is printed.
#include <stdint.h>

#include "emulator/exit.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "host_session.hpp"
#include "pressed_app.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

using namespace firmtouch;  // NOLINT: a test program
using target::print;

namespace {

enum Cause : uint8_t { kNone, kEmergencyStop, kDriveFault, kFault, kExit, kWatchdog };

constexpr uint32_t kEnable_ticks = 20;
constexpr uint32_t kCause_ticks = 400;  // the ramp in is over
constexpr uint32_t kEnd_ticks = 600;

[[gnu::section(".noinit")]] uint32_t g_off_calls;  // counted from reset; QEMU's RAM is 0
Cause g_cause = kNone;
volatile uint32_t g_tick = 0;
volatile bool g_has_power = false;
bool g_had_power = false;  // right before the cause
bool g_is_reported = false;
uint32_t g_power_tick = 0;    // of the first with power
uint32_t g_written_tick = 0;  // of the last torque
volatile bool g_is_released = false;
bool g_was_released = false;  // right before the cause

void set_brake(bool is_released) {
  if (is_released && !g_is_released) {
    print("brake released with power: ", g_has_power ? 1 : 0);
    print(", torque: ", g_written_tick == g_tick ? 1 : 0);
    print(", after ticks: ", g_tick - g_power_tick);
    hal::board_print("\n");
  }
  g_is_released = is_released;
  if (g_tick + 1 == kCause_ticks) g_was_released = is_released;
}

void set_power(bool has_power) {
  if (has_power && !g_has_power) g_power_tick = g_tick;
  g_has_power = has_power;
  if (g_tick + 1 == kCause_ticks) g_had_power = has_power;
  if (has_power || g_is_reported || g_tick < kCause_ticks) return;
  g_is_reported = true;
  print("power before: ", g_had_power ? 1 : 0);
  print(", off after ticks: ", g_tick - kCause_ticks);
  hal::board_print("\n");
  print("brake released before: ", g_was_released ? 1 : 0);
  print(", now: ", g_is_released ? 1 : 0);
  hal::board_print("\n");
}

bool is_due(Cause cause) { return g_cause == cause && g_tick >= kCause_ticks; }

[[noreturn]] void end(int status) {
  print("end ", static_cast<uint32_t>(status));
  print(", power: ", g_has_power ? 1 : 0);
  hal::board_print("\n");
  for (;;) asm volatile("nop");
}

}  // namespace

namespace firmtouch {

void target::BusySurface::touch(const ModelRequest& request, const params::Values& values,
                                ModelResult& result) {
  press_wall(request, values, result);
  if (!is_due(kFault)) return;
#ifdef __riscv
  asm volatile("unimp");
#else
  asm volatile("udf #1");
#endif
}

void app::AppController::tick(const record::TickInput& input, record::TickOutput& output) {
  g_tick = input.tick;
  Controller::tick(input, output);
}

void hal::motors_state(bool may_push) { set_power(may_push); }
void hal::motors_write_N(const float (&)[3]) { g_written_tick = g_tick; }
void hal::motors_brake(bool release) { set_brake(release); }
void hal::motors_off() {
  ++g_off_calls;
  set_brake(false);
  set_power(false);
}
uint32_t hal::motors_lines() {
  return (g_tick >= kEnable_ticks ? kMotorsEnable : 0) |
         (is_due(kEmergencyStop) ? kMotorsEmergencyStop : 0) |
         (is_due(kDriveFault) ? kMotorsDriveFault : 0);
}

/// What board_exit() ends with.
void hal::emulator_exit(int status) { end(status); }

}  // namespace firmtouch

int main() {
  const uint32_t calls_at_reset = g_off_calls;
  hal::board_begin();
  print("running, motors off before main: ", calls_at_reset);
  hal::board_print("\n");
  g_cause = static_cast<Cause>(hal::board_asset().data()[0]);
  if (!target::open_nothing()) return 3;
  static app::HostSession session;
  app::start_servo();
  while (g_tick < kEnd_ticks) {
    app::main_loop.count();
    session.poll();
    if (is_due(kExit)) hal::board_exit(42);
    while (is_due(kWatchdog)) asm volatile("nop");
  }
  end(0);
}
