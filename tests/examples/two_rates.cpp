// What you feel: the block of touch_mesh.cpp, but crisper. The motors get a fresh force 4,000 times
// a second, although the geometry is queried only 1,000 times.
// Picture: pictures/two_rates.svg
//
// The servo interrupt calls tick(), the main loop make_model(), however long that takes. Between
// two models each tick evaluates the last one at the fresh position. Which model a tick used is an
// input of it, so that a log replays.
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char block_fta[];  // the asset
extern "C" const unsigned block_fta_size;

namespace {

constexpr uint32_t kPeriod_us = 250;
constexpr uint32_t kTicksOfAModel = 4;  // so long the main loop takes here

Controller<Surfaces<MeshSurface>> controller;

// The servo interrupt.
record::TickOutput tick(uint32_t number, float height_m) {
  record::TickInput input{};
  input.tick = number;
  input.clock_us = number * kPeriod_us;
  input.encoder_counts[2] = static_cast<int32_t>(height_m * 100000.0f);
  input.flags = controller.model_flags();  // two rates; whether a model is taken or requested
  if (number >= 20) input.flags |= record::kFlagEnable;  // the first models are made
  if (number == 0) {  // the motors are off: the period may change
    input.command = 1 + params::row_of(controller.kTable, params::kTickPeriod);
    input.command_value = 1e-6f * kPeriod_us;
  }
  if (number == 1) {  // a model may be as old as the main loop takes for two
    input.command = 1 + params::row_of(controller.kTable, params::kModelAge);
    input.command_value = 3 * kTicksOfAModel;
  }
  record::TickOutput output;
  controller.tick(input, output);
  show(output, 1e-6f * kPeriod_us);
  return output;
}

}  // namespace

// The hand comes down and presses 2 mm into the top of the block, in one second.
int main() {
  if (!controller.open({block_fta, block_fta_size}).ok()) return 2;
  bool is_right = true;
  uint32_t models = 0, moved_within_a_model = 0;
  record::TickOutput output, last{};
  for (uint32_t i = 0; i < 4000; ++i) {
    const float height_m = 0.028f - 1.75e-6f * static_cast<float>(i);
    output = tick(i, height_m);
    if (output.model_sequence != last.model_sequence) {
      ++models;
    } else if (output.force_N[2] > last.force_N[2]) {
      ++moved_within_a_model;  // a fresh force from the same model
    }
    // Without a step: each count that the hand moves in costs 800 N/m * 10 um.
    is_right &= output.force_N[2] - last.force_N[2] < 0.02f;
    last = output;
    if (i % kTicksOfAModel == kTicksOfAModel - 1) controller.make_model();  // the main loop
  }
  is_right &= models > 990 && models <= 1000;
  is_right &= moved_within_a_model > 100;
  is_right &= output.force_N[2] > 1.58f && output.force_N[2] < 1.62f;  // 2 mm at 800 N/m
  return is_right && output.faults == 0 ? 0 : 1;
}
