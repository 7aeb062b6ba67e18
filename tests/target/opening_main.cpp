// Instructions of opening the board's asset with every part linked, in slices as the controller
// program takes them. A row a slice: INSTRUCTIONS. tools/bench/cortex-m7-opening runs it and adds
// up.
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "target/count.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

firmtouch::FullController g_controller;

}  // namespace

int main() {
  hal::board_begin();
  const core::Bytes slot = hal::board_asset();
  g_controller.begin({slot.data(), asset::stated_bytes(slot)});
  bool is_done = false;
  while (!is_done) {
    const uint32_t before = hal::clock_work();
    is_done = g_controller.work(firmtouch::kSliceUnits);
    target::print(target::instructions(hal::clock_work() - before), "\n");
  }
  if (g_controller.is_ready()) return 0;
  target::print("rejected by rule ", g_controller.verdict().rule);
  hal::board_print("\n");
  return 1;
}
