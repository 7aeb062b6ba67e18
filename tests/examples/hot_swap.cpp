// What you feel: you rest on a solid block, and its top sinks by 2 mm under your hand, without a
// jerk: the force falls over some milliseconds, and the lower top carries you when you follow it.
// Picture: pictures/hot_swap.svg
//
// A hot swap: the next asset is loaded while the servo runs, and a tick's command begins to touch
// it. That tick is in the record like any other, so a log with a swap replays.
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char block_fta[], low_block_fta[];  // the assets
extern "C" const unsigned block_fta_size, low_block_fta_size;

namespace {

constexpr float kStep_N = 0.2f;  // of the force in a tick: slew_limit_N_per_s 200 at 1 kHz

// The last argument makes room for two assets: 1 kB of RAM more.
using Swapping =
    Controller<Surfaces<MeshSurface>, NoGuide, CartesianDevice, asset::Proven, TwoScenes>;
Swapping controller, at_desk;

// Down onto the top, 20 mm high, 2 mm deep, and 1.5 mm more after the swap in tick 1200.
record::TickInput input_of(uint32_t tick) {
  float height_m = 0.031f - 0.00001f * static_cast<float>(tick < 1000 ? tick : 1000);
  if (tick > 1500) height_m -= 0.00001f * static_cast<float>(tick < 1650 ? tick - 1500 : 150);
  record::TickInput input = input_at(tick, {0, 0, height_m});
  if (tick == 0) {
    input.command = 1 + params::row_of(Swapping::kTable, params::kSlewLimit);
    input.command_value = kStep_N * 1000.0f;
  }
  if (tick == 1200) input.command = record::kCommandSwapAsset;
  return input;
}

// The main loop's share: a slice between two ticks, until the next asset is proven.
bool load_next(Swapping& to) { return to.work_next(kSliceUnits) && to.next_verdict().ok(); }

}  // namespace

int main() {
  if (!controller.open({block_fta, block_fta_size}).ok()) return 2;
  if (!at_desk.open({block_fta, block_fta_size}).ok()) return 2;
  controller.begin_next({low_block_fta, low_block_fta_size});
  at_desk.begin_next({low_block_fta, low_block_fta_size});
  while (!load_next(at_desk)) {
  }

  bool is_loaded = false, is_right = true, is_same = true;
  float before_N = 0, resting_N = 0;
  record::TickOutput output, again;
  for (uint32_t tick = 0; tick < 2000; ++tick) {
    const record::TickInput input = input_of(tick);
    if (!is_loaded) is_loaded = load_next(controller);
    controller.tick(input, output);
    show(output);
    at_desk.tick(input, again);
    is_same &= __builtin_memcmp(&output, &again, sizeof output) == 0;
    const float now_N = output.force_N[2];
    is_right &= is_between(now_N - before_N, -1.0001f * kStep_N, 1.0001f * kStep_N);
    if (tick == 1199) resting_N = now_N;
    if (tick == 1200) is_right &= (output.state & record::kStateCommandTaken) != 0;
    if (tick == 1400) is_right &= is_between(now_N, 0, 0);  // the top is 2 mm lower
    before_N = now_N;
  }
  if (!is_loaded || controller.asset_crc() != at_desk.asset_crc()) return 3;
  if (!is_same) return 4;  // the log replays, whenever the asset was loaded
  if (!is_between(resting_N, 1.59f, 1.61f)) return 5;
  if (!is_between(output.force_N[2], 1.19f, 1.21f)) return 6;  // 1.5 mm into the lower top
  return is_right && output.faults == 0 ? 0 : 7;
}
