#pragma once
#include <stdint.h>

#include "firmtouch/hal/clock.hpp"
#include "target/count.hpp"

namespace firmtouch::target {

/// Ticks of the board's clock that `work` takes. It reads and writes memory, so it stays in
/// between.
template <class Work>
[[gnu::noinline]] uint32_t ticks_of(Work& work) {
  const uint32_t before = hal::clock_work();
  asm volatile("" ::: "memory");
  work();
  asm volatile("" ::: "memory");
  return hal::clock_work() - before;
}

inline uint32_t instructions_of_nothing() {
  auto nothing = [] {};
  return instructions(ticks_of(nothing));
}

/// Instructions that `work` takes, without those of its measurement.
template <class Work>
uint32_t instructions_of(Work&& work) {
  const uint32_t own = instructions_of_nothing(), all = instructions(ticks_of(work));
  return all > own ? all - own : 0;
}

struct Worst {
  uint32_t taken = 0;
  void take(uint32_t instructions) { taken = instructions > taken ? instructions : taken; }
  template <class Work>
  void of(Work&& work) {
    take(instructions_of(work));
  }
};

/// A row: the next figure of a header of firmware/firmtouch.
inline void print_figure(const char* header, const Worst& worst) {
  hal::board_print(header);
  print(" ", worst.taken);
  hal::board_print("\n");
}

void measure_effects();
void measure_math();
void measure_mesh();
void measure_scene();
void measure_touch();

}  // namespace firmtouch::target
