#include "parts/work.hpp"

#include "firmtouch/hal/clock.hpp"

namespace firmtouch::hal {
namespace {

// Two instructions a turn. Aligned: fetch effects do not depend on the rest of the image.
[[gnu::noinline, gnu::aligned(16)]] uint32_t ticks_of(uint32_t turns) {
  const uint32_t before = clock_work();
#ifdef __riscv
  asm volatile("1: addi %0, %0, -1\n bnez %0, 1b" : "+r"(turns));
#else
  asm volatile("1: subs %0, #1\n bne 1b" : "+r"(turns)::"cc");
#endif
  return clock_work() - before;
}

}  // namespace

uint32_t measure_work_per_1000() {
  // Thousands of instructions in the loop: one tick of error is 1 in 300,000.
  constexpr uint32_t kThousands = 200;
  const uint32_t ticks = ticks_of(kThousands * 500 + 1) - ticks_of(1);
  return (ticks + kThousands / 2) / kThousands;
}

}  // namespace firmtouch::hal
