#include "parts/work.hpp"

#include "firmtouch/hal/clock.hpp"
#include "parts/loop.hpp"

namespace firmtouch::hal {
namespace {

// Aligned: fetch effects do not depend on the rest of the image.
[[gnu::noinline, gnu::aligned(16)]] uint32_t ticks_of(uint32_t turns) {
  const uint32_t before = clock_work();
  turn(turns);
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
