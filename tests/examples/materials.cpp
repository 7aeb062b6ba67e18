// What you feel: one block whose top is bone on the left and skin on the right. The tool presses
// into it and strokes over the border: the force changes from the one to the other, without a step.
// The skin has fine grooves, a texture.
// Picture: pictures/materials.svg
//
// The triangles of a mesh have materials: names in the model (`usemtl` of two_materials.obj), and
// what they stand for in two_materials.txt. MaterialMesh renders them; a controller program has
// part `materials` for it.
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/controller/material_mesh.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char two_materials_fta[];  // the asset
extern "C" const unsigned two_materials_fta_size;

namespace {

constexpr float kTool_N_per_m = 800.0f;  // the initial value of contact_stiffness
constexpr float kBone_N_per_m = 3000.0f, kSkin_N_per_m = 400.0f;  // as in two_materials.txt
constexpr float kDeep_m = 0.002f, kGroove_m = 0.0001f;

Controller<Surfaces<MaterialMesh>> controller;
uint32_t now = 0;
float largest_step_N = 0;  // of the force, in a tick
float least_N = 0;         // over the skin
record::TickOutput output;

void tick(float x_m, float z_m) {
  const float before_N = output.force_N[2];
  controller.tick(input_at(now++, {x_m, 0, z_m}), output);
  const float step_N = output.force_N[2] - before_N;
  if (step_N > largest_step_N) largest_step_N = step_N;
  if (-step_N > largest_step_N) largest_step_N = -step_N;
  if (x_m > 0.002f && output.force_N[2] < least_N) least_N = output.force_N[2];
  show(output);
}

// In a straight line, and then at rest.
void go(float x0_m, float z0_m, float x1_m, float z1_m, uint32_t ticks) {
  for (uint32_t i = 1; i <= ticks; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(ticks);
    tick(x0_m + (x1_m - x0_m) * share, z0_m + (z1_m - z0_m) * share);
  }
  for (uint32_t i = 0; i < 100; ++i) tick(x1_m, z1_m);
}

// The tool's spring and the material's, one behind the other.
bool is_force(float force_N, float deep_m, float own_N_per_m) {
  const float wanted_N = deep_m * kTool_N_per_m * own_N_per_m / (kTool_N_per_m + own_N_per_m);
  return is_between(force_N, 0.99f * wanted_N, 1.01f * wanted_N);
}
bool is_pressed_by(float own_N_per_m) { return is_force(output.force_N[2], kDeep_m, own_N_per_m); }

// 1: bone, 2: skin.
uint32_t material() { return output.state >> record::kStateMaterialShift & 255u; }

}  // namespace

int main() {
  if (!controller.open({two_materials_fta, two_materials_fta_size}).ok()) return 2;
  // The top is 20 mm high and the tool a ball of 3 mm radius.
  constexpr float kAbove_m = 0.033f, kTop_m = 0.023f - kDeep_m;
  go(-0.01f, kAbove_m, -0.01f, kTop_m, 500);
  bool is_right = is_pressed_by(kBone_N_per_m) && material() == 1;
  // Over the border under load: it changes the force by 20 N/s, and the motion of the hand a
  // little.
  largest_step_N = 0, least_N = 1;
  go(-0.01f, kTop_m, 0.01f, kTop_m, 1000);
  is_right &= is_pressed_by(kSkin_N_per_m) && material() == 2;  // on a crest
  is_right &= is_force(least_N, kDeep_m - kGroove_m, kSkin_N_per_m);
  is_right &= is_between(largest_step_N, 0.0f, 0.025f);
  // And back: the energy that the change took before pays for it.
  go(0.01f, kTop_m, -0.01f, kTop_m, 1000);
  is_right &= is_pressed_by(kBone_N_per_m) && material() == 1;
  is_right &= is_between(largest_step_N, 0.0f, 0.025f);
  go(-0.01f, kTop_m, -0.01f, kAbove_m, 500);
  is_right &= material() == 0;
  return is_right && output.faults == 0 ? 0 : 1;
}
