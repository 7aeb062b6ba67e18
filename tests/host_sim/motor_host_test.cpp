// Motors of a simulated linkage: lag, ripple and cogging against their closed forms.
#include "host_sim/device/motor.hpp"

#include <cmath>
#include <string>

#include "harness/test.hpp"
#include "host_sim/plant/machine.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::Motor;
using host_sim::Vec;

namespace {

constexpr double kPi = 3.14159265358979323846;

// Rotors that are heavy beside the links.
const std::string kHeavy =
    "linkage serial_arm 2\nlink_0 100 mm\nlink_1 100 mm\ntip_mass 0.1 g\n"
    "counts_0 5000 counts/rad\ncounts_1 5000 counts/rad\nmax_torque_0 1 N*m\n"
    "max_torque_1 1 N*m\nlow_0 0 rad\nhigh_0 1.5 rad\nlow_1 0.7 rad\nhigh_1 2 rad\n"
    "rotor_0 0.1 kg*m2\nrotor_1 0.1 kg*m2\n";

}  // namespace

TEST(Motor_WithoutParameters_GivesWhatIsWanted) {
  Motor motor{tools::JointFriction{}};
  for (const double wanted_Nm : {0.0, -1.0, 0.3})
    CHECK(std::fabs(motor.torque_Nm(wanted_Nm, 0.7, 2e-5) - wanted_Nm) <= 0);
}

// A step of 1 N m: its impulse up to t is t - lag (1 - exp(-t / lag)), whatever the steps.
TEST(Motor_Lag_HasTheImpulseOfTheFirstOrder) {
  for (const double step_s : {2e-5, 3e-4, 5e-3}) {
    tools::JointFriction drive;
    drive.lag_s = 2e-3;
    Motor motor(drive);
    double impulse_Nms = 0, time_s = 0;
    for (int i = 0; i < 7; ++i) {
      impulse_Nms += motor.torque_Nm(1, 0, step_s) * step_s, time_s += step_s;
      const double want_Nms = time_s - 2e-3 * (1 - std::exp(-time_s / 2e-3));
      CHECK_LE(std::fabs(impulse_Nms - want_Nms), 1e-12);
    }
  }
}

TEST(Motor_RippleAndCogging_HaveTheirAmplitudesAndGiveNoWorkInATurn) {
  tools::JointFriction drive;
  drive.ripple = 0.05, drive.cogging_N_m = 0.02, drive.poles = 7;
  Motor motor(drive);
  double most_Nm = 0, work_J = 0;
  constexpr int kSteps = 7000;
  for (int i = 0; i < kSteps; ++i) {
    const double torque_Nm = motor.torque_Nm(0.4, 2 * kPi * i / kSteps, 2e-5);
    most_Nm = std::fmax(most_Nm, torque_Nm);
    work_J += (torque_Nm - 0.4) * 2 * kPi / kSteps;
  }
  CHECK_LE(std::fabs(most_Nm - (0.4 * 1.05 + 0.02)), 1e-5);
  CHECK_LE(std::fabs(work_J), 1e-12);
}

// A torque of 1 N m from the first tick on, delayed by d samples of 1 ms, has turned a rotor of
// 0.1 kg m2 to a rate of (n - d) T / 0.1 at the end of tick n, whatever the steps.
TEST(Machine_DelayOfPartOfASample_HasItsImpulse) {
  for (const double delay : {0.0, 0.25, 0.5, 0.813, 1.0, 2.4})
    for (const int steps : {1, 7, 50}) {
      host_sim::Scenario scenario;
      scenario.linkage = tools::read_device("arm", kHeavy);
      scenario.device.output_delay_samples = static_cast<uint32_t>(delay);
      scenario.device.output_delay_part = delay - std::floor(delay);
      tools::JointMotion start;
      start.angle_rad[0] = 0.7, start.angle_rad[1] = 1.2;
      host_sim::Machine machine(scenario, points_of(*scenario.linkage, start).tip.at_m, {});
      for (int tick = 0; tick < 4; ++tick) {
        machine.command({1, 0, 0});
        for (int i = 0; i < steps; ++i) machine.advance({}, 1e-3 / steps);
      }
      CHECK_LE(std::fabs(machine.joints().rate_rad_per_s[0] - (4 - delay) * 1e-2), 3e-6);
    }
}

// Time of the controller delays as `output_delay` does: the same bits.
TEST(Machine_ConstantTimeOfTheController_IsThatOutputDelay) {
  for (const double late_s : {1e-4, 4e-4, 230000 / 168e6, 2.5e-3}) {
    host_sim::Scenario scenario;
    scenario.linkage = tools::read_device("arm", kHeavy);
    tools::JointMotion start;
    start.angle_rad[0] = 0.7, start.angle_rad[1] = 1.2;
    const Vec start_m = points_of(*scenario.linkage, start).tip.at_m;
    host_sim::Machine timed(scenario, start_m, {});
    const double delay = late_s / 1e-3;
    scenario.device.output_delay_samples = static_cast<uint32_t>(delay);
    scenario.device.output_delay_part = delay - std::floor(delay);
    host_sim::Machine delayed(scenario, start_m, {});
    for (int tick = 0; tick < 100; ++tick) {
      const float Nm[3] = {std::sin(0.3f * static_cast<float>(tick)), 0.2f, 0};
      timed.command(Nm, late_s), delayed.command(Nm);
      for (int i = 0; i < 50; ++i) timed.advance({}, 2e-5), delayed.advance({}, 2e-5);
      for (int k = 0; k < 2; ++k)
        CHECK(std::fabs(timed.joints().angle_rad[k] - delayed.joints().angle_rad[k]) <= 0);
    }
    CHECK_GE(std::fabs(timed.joints().angle_rad[0] - 0.7), 1e-3);
  }
}

// A mass of 100 g under 2 N, of which motors make 1: no two ticks have the same delay. The force of
// the third tick waits for that of the second.
TEST(Machine_TimesThatDiffer_KeepTheOrderAndTheImpulse) {
  for (const int steps : {1, 7, 16}) {
    host_sim::Scenario scenario;
    scenario.device = {0.1, 0, 0, 1e-6, 1};
    host_sim::Machine machine(scenario, {}, {});
    constexpr double kLate_s[] = {0.25e-3, 2.6e-3, 0, 0.8e-3};
    constexpr float kForce_N[] = {2, -0.5f, 0.75f, 0};
    for (int tick = 0; tick < 4; ++tick) {
      machine.command({kForce_N[tick], 0, 0}, kLate_s[tick]);
      for (int i = 0; i < steps; ++i) machine.advance({}, 1e-3 / steps);
    }
    // 1 N from 0.25 to 3.6 ms, and 0.75 N to 3.8 ms.
    CHECK_LE(std::fabs(machine.velocity_mps().x - 0.035), 1e-12);
  }
}

// Beside its detent a rotor swings at sqrt(cogging x poles / inertia); what is stored is kept.
TEST(Machine_ThatCogs_SwingsAboutItsDetent) {
  host_sim::Scenario scenario;
  scenario.linkage = tools::read_device("arm", kHeavy + "cogging_0 0.5 N*m\npoles_0 7\n");
  tools::JointMotion start;
  const double detent_rad = kPi / 7;
  start.angle_rad[0] = detent_rad + 0.005, start.angle_rad[1] = 1.2;
  host_sim::Machine machine(scenario, points_of(*scenario.linkage, start).tip.at_m, {});
  machine.command({0, 0, 0});
  double before = 1, first_s = 0, last_s = 0, most_rad = 0;
  int crossings = 0;
  for (int i = 0; i < 400000; ++i) {
    machine.advance({}, 2e-5);
    const double off = machine.joints().angle_rad[0] - detent_rad;
    most_rad = std::fmax(most_rad, std::fabs(off));
    if ((off > 0) != (before > 0)) {
      last_s = i * 2e-5;
      if (crossings++ == 0) first_s = last_s;
    }
    before = off;
  }
  CHECK_GE(crossings, 10);
  const double rate = kPi * (crossings - 1) / (last_s - first_s);
  CHECK_LE(std::fabs(rate / std::sqrt(0.5 * 7 / 0.1) - 1), 1e-3);
  CHECK_LE(most_rad, 0.00502);
}
