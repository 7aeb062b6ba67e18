#pragma once
#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "target/text.hpp"

// For the programs that count instructions on a board, and print a row a case.
namespace firmtouch::target {

/// Work of the board's clock in instructions, to the nearest.
inline uint32_t instructions(uint64_t work) {
  const uint32_t per_1000 = hal::clock_work_per_1000();
  return static_cast<uint32_t>((work * 1000 + per_1000 / 2) / per_1000);
}

/// What two reads of the clock take by themselves.
inline uint32_t empty_work() {
  const uint32_t before = hal::clock_work();
  return hal::clock_work() - before;
}

inline void print(uint32_t value, const char* behind = "") {
  hal::board_print(decimal(value).text);
  hal::board_print(behind);
}
inline void print(const char* before, uint32_t value) {
  hal::board_print(before);
  print(value);
}

}  // namespace firmtouch::target
