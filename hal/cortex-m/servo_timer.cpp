#include "cortex-m/servo_timer.hpp"
#include "cortex-m/cortex_m.hpp"
#include "firmtouch/hal/clock.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kMaxTicks = 0x00FFFFFF;  // SysTick has 24 bits

void (*g_tick)() = nullptr;

}  // namespace

void start_servo_timer(uint32_t period_us, uint32_t core_MHz, void (*tick)()) {
  const uint32_t longest_us = kMaxTicks / core_MHz;
  const uint32_t ticks = (period_us < longest_us ? period_us : longest_us) * core_MHz;
  g_tick = tick;
  reg(kSystemPriority3) = (reg(kSystemPriority3) & 0x00FFFFFFu) | (kServoPriority << 24);
  reg(kSysTickReload) = ticks - 1;
  reg(kSysTickValue) = 0;
  reg(kSysTickControl) = 7;
}

extern "C" void servo_timer_handler() {
  if (g_tick != nullptr) g_tick();
}

}  // namespace firmtouch::hal
