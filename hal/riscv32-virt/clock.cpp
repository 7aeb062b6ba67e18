#include "firmtouch/hal/clock.hpp"

#include "registers.hpp"
#include "riscv/trap.hpp"

// The CLINT's timer counts at 10 MHz. Work is the core's own count of instructions, exact under
// -icount.

namespace firmtouch::hal {
namespace {

void (*g_tick)() = nullptr;
uint32_t g_period = 0;  // timer ticks
uint64_t g_next = 0;

uint64_t now() {
  uint32_t high, low;
  do {
    high = reg(kTimer + 4);
    low = reg(kTimer);
  } while (reg(kTimer + 4) != high);
  return uint64_t{high} << 32 | low;
}

void set_next(uint64_t time) {
  g_next = time;
  reg(kTimerCompare + 4) = UINT32_MAX;  // no interrupt between the two halves
  reg(kTimerCompare) = static_cast<uint32_t>(time);
  reg(kTimerCompare + 4) = static_cast<uint32_t>(time >> 32);
}

}  // namespace

uint32_t clock_us() {
  // (2^32 / 10) does not wrap with the low word, so all 64 bits are divided.
  return static_cast<uint32_t>(now() / kTimer_MHz);
}

uint32_t clock_work() {
  uint32_t count;
  asm volatile("rdinstret %0" : "=r"(count));
  return count;
}

uint32_t clock_work_per_1000() { return 1000; }

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  g_tick = tick;
  g_period = period_us * kTimer_MHz;
  set_next(now() + g_period);
  asm volatile("csrs mie, %0\n csrsi mstatus, 8" ::"r"(1u << 7) : "memory");
}

extern "C" void machine_timer_handler() {
  set_next(g_next + g_period);
  g_tick();
}

}  // namespace firmtouch::hal
