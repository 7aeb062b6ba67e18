#include "servo.hpp"

#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/record/tick.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {
namespace {

// Ticks that may be missing before the watchdog takes the motors' power: late enough for one that
// is merely late (which the controller sees and latches by itself), early enough that a hand moves
// millimetres.
constexpr uint32_t kWatchdogTicks = 4;

bool g_running = false;
bool g_saw_enable_low = false;
bool g_show_enable_low = false;

}  // namespace

uint32_t servo_period_us() {
  return static_cast<uint32_t>(params::kTable[params::kTickPeriod].initial * 1e6f + 0.5f);
}

void start_servo() {
  if (g_running) return;
  g_running = true;
  controller.reset();  // nothing of a lock-step before is left
  hal::watchdog_begin(kWatchdogTicks * servo_period_us());
  hal::clock_start_servo(servo_period_us(), servo_interrupt);
}

uint32_t servo_lines() {
  const uint32_t lines = hal::motors_lines();
  if (!g_show_enable_low) return lines;
  g_show_enable_low = false;
  return lines & ~record::kFlagEnable;
}

bool servo_is_running() { return g_running; }

void start_servo_when_enabled() {
  if (g_running) return;
  if ((hal::motors_lines() & record::kFlagEnable) == 0) {
    g_saw_enable_low = true;
  } else if (g_saw_enable_low) {
    g_show_enable_low = true;
    start_servo();
  }
}

}  // namespace firmtouch::app
