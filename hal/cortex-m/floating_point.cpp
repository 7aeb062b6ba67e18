#include "cortex-m/floating_point.hpp"

#include "cortex-m/cortex_m.hpp"

namespace firmtouch::hal {

// Alternative half precision, default NaN, flush to zero and rounding mode are bits 26 to 22 of
// FPSCR, and of FPDSCR, which interrupts start with (ARM DDI 0403, B3.2.23). The other bits stay.
void floating_point_begin() {
  constexpr uint32_t kModes = 0x07C00000;
  reg(kFloatDefaultStatus) = reg(kFloatDefaultStatus) & ~kModes;
  uint32_t status;
  asm volatile("vmrs %0, fpscr" : "=r"(status));
  asm volatile("vmsr fpscr, %0" ::"r"(status & ~kModes));
}

}  // namespace firmtouch::hal
