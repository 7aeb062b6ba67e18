#include "firmtouch/hal/clock.hpp"

#include "cortex-m/servo_timer.hpp"
#include "parts/work.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

uint32_t g_last_ticks = 0;
uint32_t g_rest_ticks = 0;  // below one microsecond
uint32_t g_us = 0;
uint32_t g_work_per_1000 = 0;

}  // namespace

void clock_begin() {
  work_counter_begin();
  g_last_ticks = clock_work();
  g_work_per_1000 = measure_work_per_1000();
}

// The counter of 32 bits wraps after two minutes and more, long before the microseconds do, so each
// call accumulates them. The servo calls this every tick, often enough.
uint32_t clock_us() {
  const CriticalSection critical;
  const uint32_t now_ticks = clock_work();
  const uint32_t passed_ticks = now_ticks - g_last_ticks;
  g_last_ticks = now_ticks;
  g_us += passed_ticks / kCore_MHz;
  g_rest_ticks += passed_ticks % kCore_MHz;
  if (g_rest_ticks >= kCore_MHz) g_rest_ticks -= kCore_MHz, ++g_us;
  return g_us;
}

uint32_t clock_work_per_1000() { return g_work_per_1000; }

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  start_servo_timer(period_us, kCore_MHz, tick);
}

}  // namespace firmtouch::hal
