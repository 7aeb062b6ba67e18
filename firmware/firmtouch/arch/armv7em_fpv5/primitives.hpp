#pragma once
// Armv7E-M with an FPv5 unit: Cortex-M7. The assembler accepts these instructions for a Cortex-M4
// too, which lacks them. For the library's own translation units.

#include "firmtouch/arch/armv7em_fpv4/common.hpp"

namespace firmtouch::math {

static inline float larger(float value, float limit) {
  float most;
  __asm__("vmaxnm.f32 %0, %1, %2" : "=t"(most) : "t"(value), "t"(limit));
  return most;
}
static inline float smaller(float value, float limit) {
  float least;
  __asm__("vminnm.f32 %0, %1, %2" : "=t"(least) : "t"(value), "t"(limit));
  return least;
}

}  // namespace firmtouch::math
