// What you feel: a solid block, 40 mm wide. The tool is a ball of 3 mm radius that comes down on
// it, slides over its edge without a bump, and meets its side on the way back.
// Picture: pictures/touch_mesh.svg
//
// A baked mesh, and the whole chain from encoder counts to motor forces. CMake bakes block.obj and
// links it in (CMakeLists.txt beside this file). On a device, tick() is the servo interrupt
// (tests/consumer/minimal/main.cpp); here a simulated hand moves the encoders.
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char block_fta[];  // the asset
extern "C" const unsigned block_fta_size;

namespace {

constexpr float kCountsPerMetre = 100000.0f;  // the initial value of counts_per_metre_x, _y, _z

Controller<Surfaces<MeshSurface>> controller;

record::TickOutput tick(uint32_t number, float x_m, float z_m) {
  record::TickInput input{};
  input.tick = number;
  input.clock_us = number * 1000;
  input.encoder_counts[0] = static_cast<int32_t>(x_m * kCountsPerMetre);
  input.encoder_counts[2] = static_cast<int32_t>(z_m * kCountsPerMetre);
  if (number > 0) input.flags = record::kFlagEnable;  // the motors start after it was seen low
  record::TickOutput output;
  controller.tick(input, output);
  show(output);
  return output;
}

}  // namespace

int main() {
  // Proves the asset, and runs its probe queries. Otherwise the motors never push.
  if (!controller.open({block_fta, block_fta_size}).ok()) return 2;
  bool is_right = true;
  uint32_t now = 0;
  record::TickOutput output;

  // Down onto the middle of the top, 20 mm high, until the ball's centre is at 21 mm: 2 mm deep.
  for (uint32_t i = 0; i <= 500; ++i) {
    output = tick(now++, 0.0f, 0.031f - 0.00002f * static_cast<float>(i));
    if (i < 400) is_right &= is_between(output.force_N[2], 0, 0);
  }
  for (uint32_t i = 0; i < 100; ++i) output = tick(now++, 0.0f, 0.021f);
  is_right &= is_between(output.force_N[2], 1.59f, 1.61f);  // 800 N/m
  is_right &= is_between(output.penetration_m, 0.00199f, 0.00201f);

  // Across the top and off its edge: the force stays upright until there, and then lets go.
  for (uint32_t i = 0; i <= 1000; ++i) {
    const float x_m = 0.00003f * static_cast<float>(i);
    output = tick(now++, x_m, 0.021f);
    if (x_m < 0.018f) is_right &= is_between(output.force_N[2], 1.5f, 1.7f);
  }
  is_right &= is_between(output.force_N[2], 0, 0) && (output.state & record::kStateContact) == 0;

  // Down beside the block, and back against its side, 1 mm deep.
  for (uint32_t i = 0; i <= 500; ++i)
    output = tick(now++, 0.03f, 0.021f - 0.00004f * static_cast<float>(i));
  for (uint32_t i = 0; i <= 400; ++i)
    output = tick(now++, 0.03f - 0.00002f * static_cast<float>(i), 0.001f);
  for (uint32_t i = 0; i < 100; ++i) output = tick(now++, 0.022f, 0.001f);
  is_right &= is_between(output.force_N[0], 0.79f, 0.81f);
  is_right &= is_between(output.force_N[2], -0.01f, 0.01f);
  return is_right && output.faults == 0 ? 0 : 1;
}
