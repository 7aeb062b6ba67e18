#include "firmtouch/hal/clock.hpp"

#include "cortex-m/servo_timer.hpp"
#include "registers.hpp"

// Timer 5 counts microseconds, the core's cycle counter counts work.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kTraceControl = 0xE000EDFC, kTraceOn = 1u << 24;
constexpr uint32_t kCyclesControl = 0xE0001000, kCycles = 0xE0001004;
constexpr uint32_t kCyclesLock = 0xE0001FB0, kUnlock = 0xC5ACCE55;  // of a Cortex-M7

}  // namespace

void clock_begin() {
  reg(kTimer5 + kTimerPrescaler) = kTimer_MHz - 1;
  reg(kTimer5 + kTimerReload) = UINT32_MAX;
  reg(kTimer5 + kTimerEvent) = 1;  // load the prescaler now
  reg(kTimer5 + kTimerControl) = kTimerOn;
  reg(kTraceControl) = reg(kTraceControl) | kTraceOn;
  reg(kCyclesLock) = kUnlock;
  reg(kCycles) = 0;
  reg(kCyclesControl) = reg(kCyclesControl) | 1u;
}

uint32_t clock_us() { return reg(kTimer5 + kTimerCount); }

uint32_t clock_work() { return reg(kCycles); }

uint32_t clock_work_per_1000() { return 1000; }  // cycles

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  start_servo_timer(period_us, kCore_MHz, tick);
}

}  // namespace firmtouch::hal
