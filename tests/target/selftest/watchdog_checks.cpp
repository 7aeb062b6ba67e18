#include "target/selftest/selftest.hpp"

// The watchdog must not come while it is fed, and must come when it is not. Then it resets the
// board, and the report goes on from memory that start-up does not touch.
namespace firmtouch::selftest {
namespace {

constexpr uint32_t kTimeout_us = 50000;
constexpr uint32_t kMaxReset_ms = 1000;  // an RC oscillator may be wrong by half

enum Phase : uint32_t { kFed = 0x0FED0FED, kStarved = 0x57A47ED0 };

struct Kept {
  uint32_t phase, ticks;
  Totals totals;
};
[[gnu::section(".noinit")]] volatile Kept g_kept;

void enter(uint32_t phase) {
  g_kept.ticks = 0;
  g_kept.totals.passed = totals.passed;
  g_kept.totals.failed = totals.failed;
  g_kept.phase = phase;
}

}  // namespace

void note_tick() { g_kept.ticks = g_kept.ticks + 1; }

void after_reset() {
  const uint32_t phase = g_kept.phase;
  g_kept.phase = 0;
  if (phase != kFed && phase != kStarved) return;
  totals = {g_kept.totals.passed, g_kept.totals.failed};
  if (phase == kFed) {
    check("watchdog_feed", false, "it reset the board though it was fed each millisecond");
  } else {
    check("watchdog_begin", g_kept.ticks >= kTimeout_us / 4000 && g_kept.ticks <= kMaxReset_ms,
          "50 ms without a feed, and its reset came much sooner or later");
  }
  start_servo();  // for what board_exit() must stop
  wait_ms(10);
  end();
}

void check_feeding() {
  enter(kFed);
  servo.feeds = true;
  hal::watchdog_begin(kTimeout_us);
  wait_ms(500);
  check("watchdog_feed", true, "");
}

void check_starving() {
  hal::board_print("-> The watchdog resets the board now. It may say that a fault came.\n");
  enter(kStarved);
  servo.feeds = false;
  wait_ms(kMaxReset_ms);
  g_kept.phase = 0;
  check("watchdog_begin", false, "no reset came: its clock, its start");
}

}  // namespace firmtouch::selftest
