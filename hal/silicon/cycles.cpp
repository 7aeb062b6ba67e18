#include "cortex-m/servo_timer.hpp"
#include "firmtouch/hal/clock.hpp"
#include "registers.hpp"

// The core's cycle counter counts work (ARM DDI 0403, C1.8; DDI 0553, B12), SysTick the servo's
// period. The family's clock_us() counts microseconds.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kTraceControl = 0xE000EDFC, kTraceOn = 1u << 24;
constexpr uint32_t kCyclesControl = 0xE0001000, kCycles = 0xE0001004;
constexpr uint32_t kCyclesLock = 0xE0001FB0, kUnlock = 0xC5ACCE55;  // of a Cortex-M7

}  // namespace

void cycles_begin() {
  reg(kTraceControl) = reg(kTraceControl) | kTraceOn;
  reg(kCyclesLock) = kUnlock;
  reg(kCycles) = 0;
  reg(kCyclesControl) = reg(kCyclesControl) | 1u;
}

uint32_t clock_work() { return reg(kCycles); }

uint32_t clock_work_per_1000() { return 1000; }  // cycles

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  start_servo_timer(period_us, kCore_MHz, tick);
}

}  // namespace firmtouch::hal
