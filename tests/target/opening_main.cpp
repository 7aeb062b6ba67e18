// Instructions of opening the board's asset with every part linked, in slices as the controller
// program takes them. A row a slice: INSTRUCTIONS. tools/bench/cortex-m7-opening runs it and adds
// up.
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "target/text.hpp"

namespace hal = firmtouch::hal;
namespace target = firmtouch::target;

namespace {

firmtouch::FullController g_controller;

void print_row(uint32_t work) {
  const uint64_t scaled = uint64_t{work} * 1000, per_1000 = hal::clock_work_per_1000();
  hal::board_print(target::decimal(static_cast<uint32_t>((scaled + per_1000 / 2) / per_1000)).text);
  hal::board_print("\n");
}

}  // namespace

int main() {
  hal::board_begin();
  const firmtouch::core::Bytes slot = hal::board_asset();
  g_controller.begin({slot.data(), firmtouch::asset::stated_bytes(slot)});
  bool is_done = false;
  while (!is_done) {
    const uint32_t before = hal::clock_work();
    is_done = g_controller.work(firmtouch::kSliceUnits);
    print_row(hal::clock_work() - before);
  }
  if (g_controller.is_ready()) return 0;
  hal::board_print("rejected by rule ");
  hal::board_print(target::decimal(g_controller.verdict().rule).text);
  hal::board_print("\n");
  return 1;
}
