// The force law of a contact that slides from material to material: the work of a hand, counted in
// double by the law's own potential, which is exact between changes.
#include <stdint.h>

#include "firmtouch/scene/material_touch.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using scene::ForceLaw;

namespace {

constexpr float kStep_N = 0.02f;
constexpr float kStiffness_N_per_m[] = {150, 400, 1000, 1700};

struct Draw {
  uint32_t state;
  uint32_t below(uint32_t n) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % n;
  }
};

double stored_J(const ForceLaw& law, float penetration_m) {
  const double stretch_m = static_cast<double>(penetration_m) - static_cast<double>(law.slack_m);
  return stretch_m > 0 ? 0.5 * static_cast<double>(law.stiffness_N_per_m) * stretch_m * stretch_m
                       : 0;
}

float distance(float a, float b) { return a > b ? a - b : b - a; }

struct Loop {
  double given_J = 0, most_J = 0;
};

// Presses to and fro over changing materials, and lets go.
Loop loop_of(uint32_t seed) {
  Draw draw{seed};
  Loop loop;
  ForceLaw law{kStiffness_N_per_m[draw.below(4)], 0, 0};
  float at_m = 0;
  for (uint32_t leg = 0; leg < 9; ++leg) {
    const float to_m = leg == 8 ? 0.0f : static_cast<float>(draw.below(4000)) * 1e-6f;
    const uint32_t ticks = 1 + draw.below(60);
    for (uint32_t k = ticks; k-- > 0;) {
      const float next_m =
          to_m + (at_m - to_m) * (static_cast<float>(k) / (static_cast<float>(k) + 1));
      loop.given_J += stored_J(law, at_m) - stored_J(law, next_m);
      at_m = next_m;
      // Noise at a border changes it in every tick.
      const float wanted = kStiffness_N_per_m[leg % 3 == 2 ? draw.below(4) : leg % 4];
      const float before_N = law.at_N(at_m), was = law.stiffness_N_per_m;
      if (stored_J(law, at_m) > loop.most_J) loop.most_J = stored_J(law, at_m);
      law.approach(wanted, at_m, kStep_N);
      CHECK_LE(distance(law.at_N(at_m), before_N), kStep_N * 1.001f + 1e-6f);
      CHECK_LE(law.stiffness_N_per_m, wanted > was ? wanted : was);
      CHECK_GE(law.slack_m, 0.0f);
      CHECK_GE(law.left_J, 0.0f);
    }
  }
  loop.given_J += stored_J(law, at_m);
  return loop;
}

}  // namespace

TEST(ForceLaw_AnyChangesOfMaterial_GiveNoEnergyAndMakeNoStep) {
  double most = -1, least = 0;
  const uint32_t loops = 2000;
  for (uint32_t i = 0; i < loops; ++i) {
    const Loop loop = loop_of(i + 1);
    const double share = loop.given_J / loop.most_J;
    if (share > most) most = share;
    if (share < least) least = share;
  }
  CHECK_LE(most, 1e-6);
  CHECK_LE(least, -0.1);  // some must take energy, or nothing was changed
}

TEST(ForceLaw_SofterMaterial_IsReachedAtTheRate) {
  ForceLaw law{1000, 0, 0};
  uint32_t ticks = 0;
  while (law.at_N(0.002f) > 1.0001f && ticks < 1000) law.approach(500, 0.002f, kStep_N), ++ticks;
  CHECK_GE(ticks, 49u);
  CHECK_LE(ticks, 51u);
  CHECK_LE(distance(law.stiffness_N_per_m, 500), 0.1f);
}

// A stiffer spring of the same energy has sqrt(2) of the force.
TEST(ForceLaw_StifferMaterial_RisesToTheEnergyThatIsStored) {
  ForceLaw law{500, 0, 0};
  for (uint32_t i = 0; i < 20; ++i) law.approach(1000, 0.002f, kStep_N);
  CHECK_LE(distance(law.at_N(0.002f), 1.4f), 1e-4f);
  for (uint32_t i = 0; i < 80; ++i) law.approach(1000, 0.002f, kStep_N);
  CHECK_LE(distance(law.at_N(0.002f), 1.41421f), 1e-4f);
  CHECK_LE(distance(law.at_N(0.003f), 2.41421f), 1e-4f);
}

// Noise of an encoder at a border must not wear the force down.
TEST(ForceLaw_ToAndFroAtOneDepth_KeepsTheForceOfTheSofterOne) {
  ForceLaw law{500, 0, 0};
  for (uint32_t i = 0; i < 10000; ++i) law.approach(i % 2 == 0 ? 1000 : 500, 0.002f, kStep_N);
  CHECK_GE(law.at_N(0.002f), 0.99f);
  CHECK_LE(law.at_N(0.002f), 1.03f);
}

TEST(ForceLaw_NoStiffness_StaysFinite) {
  ForceLaw law;
  law.approach(0, 0.001f, kStep_N);
  CHECK_EQ(law.at_N(0.001f), 0.0f);
  law.approach(1000, 0.001f, kStep_N);
  CHECK_EQ(law.at_N(0.001f), 0.0f);
  CHECK_LE(distance(law.at_N(0.002f), 1.0f), 1e-5f);
  for (uint32_t i = 0; i < 200; ++i) law.approach(0, 0.002f, kStep_N);
  CHECK_EQ(law.at_N(0.002f), 0.0f);
}
