#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// A loop of two instructions a turn.
inline void turn(uint32_t turns) {
#ifdef __riscv
  asm volatile("1: addi %0, %0, -1\n bnez %0, 1b" : "+r"(turns));
#else
  asm volatile("1: subs %0, #1\n bne 1b" : "+r"(turns)::"cc");
#endif
}

}  // namespace firmtouch::hal
