#include "servo.hpp"

#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "firmtouch/link/protocol.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/record/tick.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {
namespace {

// Periods without a fed watchdog before it cuts the motors' power. A tick that takes up to four
// passes: the controller latches a fault by itself, and its program goes on. A hand moves
// millimetres in that time.
constexpr uint32_t kWatchdogTicks = 6;

// Longest turn of the main loop: beyond a local model at two rates and the text of a refusal.
constexpr uint32_t kMaxTurn_us = 100000;

// The lines of the motors are flags of a tick.
static_assert(hal::kMotorsEnable == record::kFlagEnable &&
              hal::kMotorsEmergencyStop == record::kFlagEmergencyStop &&
              hal::kMotorsDriveFault == record::kFlagDriveFault);

bool g_running = false;
bool g_saw_enable_low = false;  // main loop; once the servo runs, interrupt
bool g_is_first_tick = true;
bool g_may_push = false;
volatile bool g_panel_disables = false;  // main loop -> interrupt
volatile bool g_is_held_off = false;     // main loop -> interrupt
volatile bool g_panel_stops = false;     // cleared by the interrupt
uint32_t g_period_us = static_cast<uint32_t>(params::kInitialTickPeriod_s * 1e6f + 0.5f);

// The watchdog before the timer where the period grows, and behind it where it falls: never short.
void set_period(uint32_t period_us) {
  const bool grows = period_us >= g_period_us;
  g_period_us = period_us;
  if (grows) hal::watchdog_begin(kWatchdogTicks * period_us);
  hal::clock_start_servo(period_us, servo_interrupt);
  if (!grows) hal::watchdog_begin(kWatchdogTicks * period_us);
}

}  // namespace

uint32_t servo_period_us() {
  return static_cast<uint32_t>(controller.values()[params::kTickPeriod] * 1e6f + 0.5f);
}

uint32_t max_ticks_of_a_turn() { return kMaxTurn_us / g_period_us; }

void start_servo() {
  if (g_running) return;
  g_running = true;
  controller.reset();  // forgets a lock-step
  saved_commands.begin();
  set_period(servo_period_us());
}

void set_panel(uint32_t flags) {
  g_panel_disables = (flags & link::kPanelDisable) != 0;
  if ((flags & link::kPanelStop) != 0) g_panel_stops = true;
}

void hold_motors_off(bool is_held) { g_is_held_off = is_held; }

uint32_t servo_flags(bool sets_saved) {
  uint32_t flags = hal::motors_lines();
  if ((flags & record::kFlagEnable) == 0) g_saw_enable_low = true;
  if (kHasSlots && g_is_held_off) g_saw_enable_low = false;
  const bool must_wait = g_is_first_tick || sets_saved || !g_saw_enable_low;
  g_is_first_tick = false;
  if (must_wait || g_panel_disables) flags &= ~record::kFlagEnable;
  if (g_panel_stops) {
    g_panel_stops = false;
    flags |= record::kFlagEmergencyStop;
  }
  return flags;
}

void after_tick(const record::TickOutput& output) {
  __atomic_store_n(&g_may_push, record::may_push(output), __ATOMIC_RELAXED);
  const bool may_have_changed = (output.state & record::kStateCommandTaken) != 0;
  if (may_have_changed && servo_period_us() != g_period_us) set_period(servo_period_us());
}

bool servo_is_running() { return g_running; }

bool motors_may_push() { return __atomic_load_n(&g_may_push, __ATOMIC_RELAXED); }

void start_servo_when_enabled() {
  if (g_running) return;
  if ((hal::motors_lines() & hal::kMotorsEnable) == 0) {
    g_saw_enable_low = true;
  } else if (g_saw_enable_low) {
    start_servo();
  }
}

}  // namespace firmtouch::app
