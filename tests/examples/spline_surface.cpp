// What you feel: a polished ring, 140 mm wide. Led once around its crest, the force does not change
// by a hundredth of a newton: a surface of splines has no facets.
// Picture: pictures/spline_surface.svg
//
// A NURBS model (torus.igs, from a CAD system) is baked and touched like a mesh: only the
// controller's type says SplineSurface. The tool is a ball of 3 mm radius.
#include "firmtouch/controller/spline_surface.hpp"
#include "firmtouch/controller/controller.hpp"
#include "firmtouch/math/elementary.hpp"
#include "hand.hpp"

using namespace firmtouch;

extern "C" const unsigned char torus_fta[];  // the asset
extern "C" const unsigned torus_fta_size;

namespace {

constexpr float kCrest_m = 0.05f;    // radius of the ring's middle circle
constexpr float kTop_m = 0.02f;      // height of the crest: the radius of its tube
constexpr float kRadius_m = 0.003f;  // of the tool, the initial value of tool_radius_m

Controller<Surfaces<SplineSurface>> controller;
record::TickOutput output;
uint32_t now = 0;

void tick(math::Vec3 position_m) {
  controller.tick(input_at(now++, position_m), output);
  show(output);
}

}  // namespace

int main() {
  if (!controller.open({torus_fta, torus_fta_size}).ok()) return 2;
  bool is_right = true;
  // Down onto the crest, until the ball's centre is 2 mm too deep: 800 N/m.
  constexpr float kPressed_m = kTop_m + kRadius_m - 0.002f;
  for (uint32_t i = 0; i <= 500; ++i)
    tick({kCrest_m, 0, kPressed_m + 0.00002f * static_cast<float>(500 - i)});
  for (uint32_t i = 0; i < 200; ++i) tick({kCrest_m, 0, kPressed_m});
  is_right &= is_between(output.force_N[2], 1.59f, 1.61f);

  // Once around in three seconds. An encoder resolves 10 um, which is 8 mN.
  float least_N = 9, most_N = 0;
  for (uint32_t i = 0; i < 3000; ++i) {
    const float angle_rad = 6.2831853f * static_cast<float>(i) / 3000;
    tick({kCrest_m * math::cosine(angle_rad), kCrest_m * math::sine(angle_rad), kPressed_m});
    if (output.force_N[2] < least_N) least_N = output.force_N[2];
    if (output.force_N[2] > most_N) most_N = output.force_N[2];
    is_right &= (output.state & record::kStateContact) != 0;
  }
  is_right &= least_N > 1.59f && most_N < 1.61f;

  // Up, inwards, and down into the hole, 12 mm beside the axis: nothing is there. (On the axis
  // itself the whole ring is equally near, and the work of a tick does not suffice to know it.)
  constexpr float kAbove_m = 0.03f, kBeside_m = 0.012f;
  const auto part = [](uint32_t i) { return static_cast<float>(i) / 1000; };
  for (uint32_t i = 0; i <= 1000; ++i)
    tick({kCrest_m, 0, kPressed_m + (kAbove_m - kPressed_m) * part(i)});
  for (uint32_t i = 0; i <= 1000; ++i)
    tick({kCrest_m + (kBeside_m - kCrest_m) * part(i), 0, kAbove_m});
  for (uint32_t i = 0; i <= 1000; ++i) tick({kBeside_m, 0, kAbove_m * (1 - part(i))});
  is_right &= (output.state & record::kStateContact) == 0 && is_between(output.force_N[2], 0, 0);

  // And against the inner wall, 1 mm deep.
  constexpr float kWall_m = kCrest_m - kTop_m - kRadius_m + 0.001f;
  for (uint32_t i = 0; i <= 1000; ++i) tick({kBeside_m + (kWall_m - kBeside_m) * part(i), 0, 0});
  for (uint32_t i = 0; i < 200; ++i) tick({kWall_m, 0, 0});
  is_right &= is_between(output.force_N[0], -0.81f, -0.79f);
  return is_right && output.faults == 0 ? 0 : 1;
}
