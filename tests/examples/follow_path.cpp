// What you feel: a groove in the air. Near the path the tool is drawn into it and glides along it;
// pulled far enough away it comes free.
// Picture: pictures/follow_path.svg
//
// A virtual fixture along a baked path (path.csv, a half circle over the block) and a baked mesh.
// Settings are parameters: a command of a tick sets one, so that a log has them all.
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/math/elementary.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char block_and_path_fta[];  // the asset
extern "C" const unsigned block_and_path_fta_size;

namespace {

constexpr float kRadius_m = 0.035f;  // of the half circle, about the y axis
constexpr float kHalfTurn_rad = 3.1415927f;
constexpr float kStiffness_N_per_m = 500.0f;

Controller<Surfaces<MeshSurface>, CurveGuide> controller;
constexpr uint32_t kSetStiffness =
    1 + params::row_of(decltype(controller)::kTable, params::kGuideStiffness);
uint32_t now = 0;

// The tool at an angle of the half circle, so far out of it. `command`: 1 + a parameter.
record::TickOutput tick(float angle_rad, float out_m, uint32_t command = 0, float value = 0) {
  const float from_axis_m = kRadius_m + out_m;
  record::TickInput input = input_at(
      now++, {-from_axis_m * math::cosine(angle_rad), 0, from_axis_m * math::sine(angle_rad)});
  input.command = command;
  input.command_value = value;
  record::TickOutput output;
  controller.tick(input, output);
  show(output);
  return output;
}

float outwards_N(const record::TickOutput& output, float angle_rad) {
  return output.force_N[2] * math::sine(angle_rad) - output.force_N[0] * math::cosine(angle_rad);
}
float onwards_N(const record::TickOutput& output, float angle_rad) {
  return output.force_N[0] * math::sine(angle_rad) + output.force_N[2] * math::cosine(angle_rad);
}

}  // namespace

int main() {
  if (!controller.open({block_and_path_fta, block_and_path_fta_size}).ok()) return 2;
  bool is_right = true;
  record::TickOutput output = tick(0.1f, 0.0f, kSetStiffness, kStiffness_N_per_m);
  is_right &= (output.state & record::kStateCommandTaken) != 0;
  for (uint32_t i = 0; i < 300; ++i) output = tick(0.1f, 0.0f);  // the force ramps in
  is_right &= (output.state & record::kStateOnGuide) != 0;

  // Along the path, 2 mm outside of it: drawn in by 1 N, and free to go on.
  float arc = output.guide_arc;
  for (uint32_t i = 0; i <= 2000; ++i) {
    const float angle_rad = 0.1f + 0.0013f * static_cast<float>(i);
    output = tick(angle_rad, i < 100 ? 0.00002f * static_cast<float>(i) : 0.002f);
    is_right &= output.guide_arc >= arc;
    arc = output.guide_arc;
    if (i < 200) continue;
    is_right &= is_between(outwards_N(output, angle_rad), -1.05f, -0.95f);
    is_right &= is_between(onwards_N(output, angle_rad), -0.05f, 0.05f);
  }
  is_right &= is_between(arc, 2.69f / kHalfTurn_rad, 2.71f / kHalfTurn_rad);

  // Away from it: it holds until 15 mm, the initial value of guide_release_m.
  for (uint32_t i = 0; i <= 1000; ++i) {
    const float out_m = 0.002f + 0.000016f * static_cast<float>(i);
    output = tick(2.7f, out_m);
    const bool is_held = (output.state & record::kStateOnGuide) != 0;
    if (out_m < 0.0149f) is_right &= is_held;
    if (out_m > 0.0152f) is_right &= !is_held;
  }
  is_right &= is_between(outwards_N(output, 2.7f), -0.001f, 0.001f);
  return is_right && output.faults == 0 ? 0 : 1;
}
