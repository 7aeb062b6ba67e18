#include "firmtouch/hal/clock.hpp"

#include "registers.hpp"

// Timer 5 counts microseconds.
namespace firmtouch::hal {

void clock_begin() {
  reg(kTimer5 + kTimerPrescaler) = kTimer_MHz - 1;
  reg(kTimer5 + kTimerReload) = UINT32_MAX;
  reg(kTimer5 + kTimerEvent) = 1;  // load the prescaler now
  reg(kTimer5 + kTimerControl) = kTimerOn;
  cycles_begin();
}

uint32_t clock_us() { return reg(kTimer5 + kTimerCount); }

}  // namespace firmtouch::hal
