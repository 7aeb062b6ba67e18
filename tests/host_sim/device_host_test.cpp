// The simulated device against closed forms and against the stability limits of sampled walls.
#include <cmath>

#include "harness/test.hpp"
#include "host_sim/plant/device.hpp"

using firmtouch::host_sim::Axis;
using firmtouch::host_sim::Device;
using firmtouch::host_sim::DeviceModel;
using firmtouch::host_sim::Vec;

namespace {

DeviceModel free_mass(double mass_kg, double viscous) {
  DeviceModel model;
  model.mass_kg = mass_kg;
  model.viscous_N_s_per_m = viscous;
  model.coulomb_N = 0;
  model.encoder_quantum_m = 1e-6;
  model.force_limit_N = 1e300;
  return model;
}

// Simulates the device against a sampled wall, F = -K x - B (x - previous x) / T, for `ticks`
// ticks. Result: log of the growth of the largest excursion from the first to the second half.
double growth(const DeviceModel& model, double period_s, double stiffness, double damping,
              int ticks) {
  Device device(model, {1e-3, 0, 0});
  double before = 1e-3, first = 1e-300, second = 1e-300, scale = 0;
  for (int i = 0; i < ticks; ++i) {
    const double x = device.position_m().x;
    const double at = std::fabs(x);
    if (i >= ticks / 4 && i < ticks / 2) first = std::fmax(first, at);
    if (i >= 3 * (ticks / 4)) second = std::fmax(second, at);
    scale = std::fmax(scale, at);
    if (scale > 1e100) return 1;
    device.command({-stiffness * x - damping * (x - before) / period_s, 0, 0});
    before = x;
    device.advance({}, period_s);
  }
  return std::log(second / first);
}

// Stiffness at the stability limit, by bisection.
double stable_limit(const DeviceModel& model, double period_s, double damping) {
  double low = 1, high = 1e6;
  while (high / low > 1.0005) {
    const double middle = std::sqrt(low * high);
    (growth(model, period_s, middle, damping, 40000) > 0 ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

struct Row {
  double mass_kg, viscous, period_s, damping, no_delay, one_sample;
};

// Stability limits from the spectral radius of the exact discrete model.
constexpr Row kTable[] = {
    {.050, .2, 1e-3, 0, 400, 133},       {.050, .2, 1e-3, .1, 599, 200},
    {.050, .2, 1e-3, 2, 4231, 1403},     {.050, .2, .25e-3, 0, 1600, 533},
    {.050, .2, .25e-3, .1, 2398, 799},   {.050, .2, .25e-3, 2, 17427, 5803},
    {.075, .5, 1e-3, 0, 1001, 334},      {.075, .5, 1e-3, .25, 1497, 499},
    {.075, .5, 1e-3, 5, 10304, 3401},    {.075, .5, .25e-3, 0, 4000, 1333},
    {.075, .5, .25e-3, .25, 5995, 1998}, {.075, .5, .25e-3, 5, 43284, 14401},
    {.075, .5, .1e-3, 0, 9991, 3330},    {.075, .5, .1e-3, .25, 14986, 4994},
    {.075, .5, .1e-3, 5, 109270, 36396}, {.200, 1.0, 1e-3, 0, 2001, 668},
    {.200, 1.0, 1e-3, .5, 2995, 999},    {.200, 1.0, 1e-3, 10, 20947, 6936},
};

void check_table(uint32_t delay_samples, double Row::*column) {
  for (const Row& row : kTable) {
    DeviceModel model = free_mass(row.mass_kg, row.viscous);
    model.output_delay_samples = delay_samples;
    const double limit = stable_limit(model, row.period_s, row.damping);
    firmtouch::test::note("row", &row - kTable);
    CHECK_LE(std::fabs(limit / (row.*column) - 1), 0.01);
  }
}

}  // namespace

TEST(StiffestStableWall_EqualsExactModel_WithoutDelay) { check_table(0, &Row::no_delay); }

TEST(StiffestStableWall_EqualsExactModel_WithOneSampleDelay) { check_table(1, &Row::one_sample); }

// K < (b + B) / (T/2 + delay), Gil, Hulin, Diaz: holds for small B.
TEST(StiffestStableWall_EqualsClosedForm_ForSmallDamping) {
  for (const uint32_t delay : {0u, 1u, 2u}) {
    for (const double damping : {0.0, 0.05}) {
      DeviceModel model = free_mass(0.1, 0.3);
      model.output_delay_samples = delay;
      const double period_s = 0.5e-3;
      const double closed_form = (0.3 + damping) / (period_s / 2 + delay * period_s);
      CHECK_LE(std::fabs(stable_limit(model, period_s, damping) / closed_form - 1), 0.01);
    }
  }
}

TEST(FreeMotion_ConstantForce_IsExactForAnyStep) {
  for (const double viscous : {0.0, 1e-6, 0.5, 40.0}) {
    const DeviceModel model = free_mass(0.075, viscous);
    for (const int steps : {1, 7, 1000}) {
      Axis axis;
      axis.position_m = 0.01;
      axis.velocity_mps = 0.2;
      for (int i = 0; i < steps; ++i) axis.advance(model, 1.5, 0.05 / steps);
      const double rate = viscous / 0.075, t = 0.05;
      const double lost = rate > 0 ? -std::expm1(-rate * t) / rate : t;  // integral of the decay
      const double expected_v = viscous > 1e-5
                                    ? 0.2 + (1.5 / viscous - 0.2) * -std::expm1(-rate * t)
                                    : 0.2 + 1.5 / 0.075 * t;
      const double expected_x = viscous > 1e-5
                                    ? 0.01 + 1.5 / viscous * t + (0.2 - 1.5 / viscous) * lost
                                    : 0.01 + 0.2 * t + 0.5 * 1.5 / 0.075 * t * t;
      CHECK_LE(std::fabs(axis.velocity_mps - expected_v), 2e-6);
      CHECK_LE(std::fabs(axis.position_m - expected_x), 1e-7);
    }
  }
}

TEST(CoulombFriction_SmallerForce_DoesNotMove) {
  DeviceModel model = free_mass(0.075, 0.5);
  model.coulomb_N = 0.1;
  Axis axis;
  for (int i = 0; i < 100; ++i) axis.advance(model, 0.0999, 1e-3);
  CHECK(!(std::fabs(axis.position_m) > 0));
  for (int i = 0; i < 100; ++i) axis.advance(model, 0.2, 1e-3);
  CHECK_LT(1e-4, axis.position_m);
}

TEST(CoulombFriction_StopsAfterClosedFormDistance) {
  DeviceModel model = free_mass(0.1, 0);
  model.coulomb_N = 0.5;
  Axis axis;
  axis.velocity_mps = 0.3;
  for (int i = 0; i < 2000; ++i) axis.advance(model, 0, 1e-4);
  CHECK(!(std::fabs(axis.velocity_mps) > 0));
  CHECK_LE(std::fabs(axis.position_m - 0.1 * 0.3 * 0.3 / (2 * 0.5)), 2e-6);  // m v^2 / 2 f
}

TEST(Encoder_RoundsDownToWholeQuanta) {
  DeviceModel model = free_mass(1, 0);
  model.encoder_quantum_m = 1e-3;
  CHECK_EQ(Device(model, {0.00199, -0.0001, 0}).count(0), 1);
  CHECK_EQ(Device(model, {0.00199, -0.0001, 0}).count(1), -1);
  CHECK_EQ(Device(model, {1e12, 0, 0}).count(0), 2147483647);
}

TEST(MotorForce_IsDelayedAndLimited) {
  DeviceModel model = free_mass(1, 0);
  model.force_limit_N = 4;
  model.output_delay_samples = 2;
  Device device(model, {});
  const double commands[] = {9, -9, std::nan(""), 1, 2};
  const double expected_N[] = {0, 0, 4, -4, 0};
  for (int i = 0; i < 5; ++i) {
    device.command({commands[i], 0, 0});
    CHECK(!(std::fabs(device.motor_N().x - expected_N[i]) > 0));
  }
}
