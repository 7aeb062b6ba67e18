#include "firmtouch/hal/clock.hpp"

#include "cortex-m/servo_timer.hpp"
#include "parts/work.hpp"
#include "registers.hpp"

// TIM5 counts microseconds, TIM2 counts work. In QEMU TIM2 runs at 1 GHz: under -icount shift=3 it
// counts eight ticks an instruction.

namespace firmtouch::hal {
namespace {

uint32_t g_work_per_1000 = 0;

void start_timer(uint32_t timer, uint32_t divider) {
  reg(timer + 0x28) = divider - 1;
  reg(timer + 0x2C) = UINT32_MAX;
  reg(timer + 0x14) = 1;  // load the prescaler now
  reg(timer + 0x00) = 1;
}

}  // namespace

void clock_begin() {
  start_timer(kTimer2, 1);
  start_timer(kTimer5, timer_MHz());
  g_work_per_1000 = measure_work_per_1000();
}

uint32_t clock_us() { return reg(kTimer5 + 0x24); }

uint32_t clock_work() { return reg(kTimer2 + 0x24); }

uint32_t clock_work_per_1000() { return g_work_per_1000; }

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  start_servo_timer(period_us, core_MHz(), tick);
}

}  // namespace firmtouch::hal
