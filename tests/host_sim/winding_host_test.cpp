// Temperatures of a simulated motor against closed forms, and what derating keeps them at.
#include "host_sim/device/winding.hpp"

#include <cmath>
#include <vector>

#include "device/device_file.hpp"
#include "firmtouch/device/derating.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"
#include "host_sim/device/motor.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::MotorRating;
using host_sim::Winding;

namespace {

constexpr double kContinuous_Nm = 0.2, kTime_s = 3, kCopper_per_K = 0.0039;
constexpr MotorRating kRating{kContinuous_Nm, kTime_s, 80, 0, 300};

// Of a current i from cold: x = g (1 - exp(-k t)) / (k T), g = i^2 / (1 + a), k = (1 - g a) / T.
double closed_form(double current, double time_s) {
  const double a = kCopper_per_K * 80, g = current * current / (1 + a);
  const double k = (1 - g * a) / kTime_s;
  return std::fabs(k) < 1e-12 ? g * time_s / kTime_s : g * -std::expm1(-k * time_s) / (k * kTime_s);
}

}  // namespace

TEST(Winding_ConstantTorque_HasItsClosedForm_WhateverTheSteps) {
  const double a = kCopper_per_K * 80,
               even = std::sqrt((1 + a) / a);  // neither rises nor runs away
  for (const double current : {0.3, 1.0, -1.5, even, 3.0})
    for (const double step_s : {2e-5, 1e-3, 0.3}) {
      Winding winding(kRating);
      const int steps = static_cast<int>(0.6 / step_s);
      for (int i = 0; i < steps; ++i) winding.heat(current * kContinuous_Nm, step_s);
      const double want = closed_form(current, steps * step_s);
      CHECK_LE(std::fabs(winding.rise() - want), 1e-8 * (1 + want));
    }
}

TEST(Winding_ContinuousTorque_EndsAtTheRatedRise) {
  Winding winding(kRating);
  for (int i = 0; i < 10000; ++i) winding.heat(kContinuous_Nm, 0.01);
  CHECK_LE(std::fabs(winding.rise() - 1), 1e-9);
  winding = Winding(kRating);
  for (int i = 0; i < 1000; ++i) winding.heat(1.5 * kContinuous_Nm, 0.01);
  const double hot = winding.rise();
  for (int i = 0; i < 1000; ++i) winding.heat(0, 0.01);
  CHECK_LE(std::fabs(winding.rise() - hot * std::exp(-10 / kTime_s)), 1e-9);
  CHECK_LE(std::fabs(winding.largest_rise() - hot), 0);
}

// At rest of the winding's rise the magnets are at their own, and 0.11 % a kelvin is gone.
TEST(Winding_WarmMagnets_GiveLessTorque) {
  MotorRating rating = kRating;
  rating.magnet_rise_K = 40, rating.magnet_time_s = 20;
  host_sim::Motor motor({}, rating);
  CHECK_LE(std::fabs(motor.torque_Nm(kContinuous_Nm, 0, 1e-3) - kContinuous_Nm), 1e-7);
  for (int i = 0; i < 400000; ++i) motor.torque_Nm(kContinuous_Nm, 0, 1e-3);
  CHECK_LE(std::fabs(motor.torque_Nm(kContinuous_Nm, 0, 1e-3) - kContinuous_Nm * (1 - 0.044)),
           1e-6);
}

TEST(Winding_WithoutARating_ChangesNothing) {
  host_sim::Motor motor(tools::JointFriction{});
  for (int i = 0; i < 1000; ++i) CHECK_LE(std::fabs(motor.torque_Nm(5, 0, 1) - 5), 0);
  CHECK_LE(motor.winding().largest_rise(), 0);
}

// The firmware counts with the resistance of a hot winding, which is the larger one.
TEST(Winding_DeratedTorque_KeepsTheRatedRise_AndTheWholeOneDoesNot) {
  const tools::LinkageDevice device = tools::read_device(
      "arm",
      "linkage serial_arm 2\nlink_0 100 mm\nlink_1 100 mm\n"
      "counts_0 5000 counts/rad\ncounts_1 5000 counts/rad\nmax_torque_0 1 N*m\n"
      "max_torque_1 1 N*m\nlow_0 0 rad\nhigh_0 1.5 rad\nlow_1 0.7 rad\nhigh_1 2 rad\n"
      "continuous_torque_0 0.2 N*m\nthermal_time_0 3 s\n");
  const std::vector<uint8_t> stored = stored_bytes_of(device);
  const core::Bytes section(stored.data(), static_cast<uint32_t>(stored.size()));
  device::StoredLinkage linkage;
  device::Derating derating;
  CHECK(open(device::Derating::before(section), linkage).ok());
  CHECK(derating.open(section, linkage).ok());
  test::Lcg random(5);
  for (const bool is_derated : {true, false}) {
    device::HeatState state;
    Winding winding(kRating);
    float torque_Nm[3] = {}, most_Nm[3];
    double share = 1;
    for (int tick = 0; tick < 100000; ++tick) {
      device::heat(state, derating, linkage, torque_Nm, 1e-3f, most_Nm);
      if (tick % 2000 == 0) share = tick < 20000 ? 1 : static_cast<double>(random.between(-1, 1));
      torque_Nm[0] = static_cast<float>(share) * (is_derated ? most_Nm[0] : 1);
      winding.heat(static_cast<double>(torque_Nm[0]), 1e-3);
    }
    CHECK(is_derated ? winding.largest_rise() <= 1.001 && winding.largest_rise() > 0.95
                     : winding.largest_rise() > 2);
  }
}
