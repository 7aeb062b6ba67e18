// What the motors of an arm carry of its weight, against the height's gradient: alone, and beside a
// force.
#include <cmath>
#include <cstdint>

#include "controller/arm_ride.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

// An arm with 50 g at the elbow and 30 g at the tip, which its motors carry.
device::LinkageLayout heavy_arm(float max_torque_Nm) {
  device::LinkageLayout layout = arm_with(max_torque_Nm);
  layout.elbow_mass_kg[0] = 0.05f;
  layout.tip_mass_kg = 0.03f;
  layout.gravity_mps2[2] = -9.81f;
  layout.carried_share = 0.5f;
  return layout;
}

// By the height's gradient, in the middle of the next tick.
struct CarriedWeight {
  double torque_Nm[3] = {}, before_rad[3] = {};

  static double energy_J(const double (&q)[3]) {
    return 9.81 * (0.05 * kUpper_m * std::sin(q[1]) + 0.03 * tip_of(q).z);
  }
  void next(const double (&angle_rad)[3]) {
    double q[3];
    for (int k = 0; k < 3; ++k) {
      q[k] = 1.5 * angle_rad[k] - 0.5 * before_rad[k];
      before_rad[k] = angle_rad[k];
    }
    for (int k = 0; k < 3; ++k) {
      const double middle = q[k];
      q[k] = middle + 1e-6;
      const double after_J = energy_J(q);
      q[k] = middle - 1e-6;
      torque_Nm[k] = (after_J - energy_J(q)) / 2e-6;
      q[k] = middle;
    }
  }
};

}  // namespace

// With the hand off the surface.
TEST(CarriedWeight_IsTheGradientOfTheHeight) {
  ArmRide ride(heavy_arm(2));
  CarriedWeight weight;
  uint32_t free_ticks = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.step(tick);
    CHECK_EQ(ride.output.faults, 0u);
    weight.next(ride.angle_rad);
    if (tick < 400 || size_of(ride.output.force_N) > 0) continue;
    ++free_ticks;
    for (int k = 0; k < 3; ++k)
      CHECK_LE(std::fabs(static_cast<double>(ride.output.motor_N[k]) - weight.torque_Nm[k]), 1e-5);
  }
  CHECK_GE(free_ticks, 300u);
}

// Weight that is let go while a wall pushes, and taken up as it lets go, does work that no observer
// counts: the force alone waits for torques to rise.
TEST(CarriedWeight_WhileTorquesRise_IsCarriedWhole) {
  device::LinkageLayout layout = heavy_arm(3);
  layout.torque_rise_s = 0.05f;
  ArmRide ride(layout);
  ride.stiffness_N_per_m = 20000;
  CarriedWeight weight;
  float before_Nm[3] = {};
  uint32_t rising = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.step(tick);
    CHECK_EQ(ride.output.faults, 0u);
    weight.next(ride.angle_rad);
    bool rises = false;
    for (int k = 0; k < 3; ++k) {
      const float torque_Nm = ride.output.motor_N[k];
      const float from_Nm = torque_Nm * before_Nm[k] > 0 ? std::fabs(before_Nm[k]) : 0;
      CHECK_LE(std::fabs(torque_Nm), from_Nm + 0.06001f);
      rises |= std::fabs(torque_Nm) > from_Nm + 0.0599f;
      before_Nm[k] = torque_Nm;
    }
    if (tick < 400) continue;
    rising += rises ? 1u : 0u;
    for (int k = 0; k < 3; ++k) {
      const double of_force_Nm = torque_of(ride.angle_rad, k, ride.output.force_N);
      CHECK_LE(std::fabs(static_cast<double>(ride.output.motor_N[k]) - of_force_Nm -
                         weight.torque_Nm[k]),
               5e-5);
    }
  }
  CHECK_GE(rising, 5u);
}
