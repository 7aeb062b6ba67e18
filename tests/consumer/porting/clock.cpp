#include "firmtouch/hal/clock.hpp"

#include "cortex-m/servo_timer.hpp"
#include "parts/work.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

uint32_t g_last = 0, g_rest = 0, g_us = 0, g_work_per_1000 = 0;

}  // namespace

void clock_begin() {
  reg(kTimer0 + 0x8) = UINT32_MAX;
  reg(kTimer0 + 0x4) = UINT32_MAX;
  reg(kTimer0 + 0x0) = 1;
  g_work_per_1000 = measure_work_per_1000();
}
uint32_t clock_work() { return UINT32_MAX - reg(kTimer0 + 0x4); }
uint32_t clock_us() {
  const CriticalSection critical;
  const uint32_t now = clock_work();
  g_rest += now - g_last;
  g_last = now;
  g_us += g_rest / kCore_MHz;
  g_rest %= kCore_MHz;
  return g_us;
}
uint32_t clock_work_per_1000() { return g_work_per_1000; }
void clock_start_servo(uint32_t period_us, void (*tick)()) {
  start_servo_timer(period_us, kCore_MHz, tick);
}

}  // namespace firmtouch::hal
