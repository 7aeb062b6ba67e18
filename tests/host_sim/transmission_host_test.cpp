// Cables between motors and joints: energy, the first resonance, the limit cycle of a gap.
#include "host_sim/device/transmission_check.hpp"

#include <cmath>
#include <string>

#include "device/machines.hpp"
#include "harness/test.hpp"
#include "host_sim/device/driven_linkage.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::DrivenLinkage;
using host_sim::TransmissionCheck;
using tools::LinkageDevice;

namespace {

std::string refusal(const std::string& more) {
  try {
    (void)tools::read_device("arm.txt", tools::machine_text("touch_like") + more);
  } catch (const tools::Refused& refused) {
    return refused.what();
  }
  return "";
}

LinkageDevice machine(const std::string& name, const std::string& more = "") {
  return tools::read_device(name, tools::machine_text(name) + more);
}

}  // namespace

TEST(Transmission_EveryMachine_RingsAndCyclesAsTheClosedFormsSay) {
  for (const std::string& name : tools::machine_names()) {
    test::note(name.c_str(), 0);
    LinkageDevice device = machine(name);
    CHECK(host_sim::assume_cables(device));
    const TransmissionCheck check = host_sim::check_transmission(device);
    CHECK_GE(check.resonance_Hz.closed_form, 1.0);
    CHECK_LE(check.resonance_Hz.error(), 0.01);
    CHECK_LE(check.cycle_Hz.error(), 0.05);
    CHECK_LE(check.cycle_rad.error(), 0.05);
    CHECK(host_sim::is_good(check));
  }
}

// The motor's inertia belongs to the rotor alone, and the encoder sits on the motor.
TEST(Transmission_AStiffCable_IsNearlyRigid) {
  const LinkageDevice rigid = machine("touch_like");
  const LinkageDevice sprung =
      machine("touch_like", "cable_0 3000 N*m/rad\ncable_1 3000 N*m/rad\ncable_2 3000 N*m/rad\n");
  const host_sim::JointMotion start{{0.2, 0.9, -1.5}, {}};
  DrivenLinkage one(rigid, start), other(sprung, start);
  for (int step = 0; step < 10000; ++step) {
    const double motor_Nm[] = {0.1, 0.2 * std::cos(1e-3 * step), -0.1};
    one.advance(motor_Nm, {}, 1e-5), other.advance(motor_Nm, {}, 1e-5);
  }
  for (uint32_t k = 0; k < 3; ++k) {
    const double moved = one.body().motion().angle_rad[k] - start.angle_rad[k];
    CHECK_GE(std::fabs(moved), 0.05);
    CHECK_LE(std::fabs(other.body().motion().angle_rad[k] - one.body().motion().angle_rad[k]),
             0.01 * std::fabs(moved));
    CHECK_LE(std::abs(other.count(k) - one.count(k)), 10);
  }
}

TEST(Transmission_WorkIsStoredOrLost) {
  std::string cables;
  for (const char* k : {"0", "1", "2"})
    cables += std::string("cable_") + k + " 20 N*m/rad\ncable_damping_" + k +
              " 0.002 N*m*s/rad\nbacklash_" + k + " 0.1 deg\ncoulomb_" + k + " 0.002 N*m\n";
  DrivenLinkage linkage(machine("touch_like", cables), {{0.2, 0.9, -1.5}, {}});
  double twist_rad = 0;
  for (int step = 0; step < 100000; ++step) {
    const double t = step * 1e-5, motor_Nm[] = {0.1 * std::sin(30 * t), 0.2, -0.1};
    linkage.advance(motor_Nm, {0, 0.3 * std::sin(40 * t), 0.3}, 1e-5);
    twist_rad = std::fmax(twist_rad, std::fabs(linkage.twist_rad(1)));
  }
  const host_sim::EnergyBook& book = linkage.energy();
  CHECK_GE(twist_rad, 5e-3);
  CHECK_GE(book.lost_J, 1e-3);
  CHECK_LE(std::fabs(book.error_J()), 1e-5 * book.turnover_J);
}

TEST(Transmission_WhatCannotBeSimulated_IsRefused) {
  CHECK(refusal("cable_1 20 N*m/rad\nbacklash_1 1 deg\n").empty());
  CHECK(refusal("cable_1 50000 N*m/rad\n").find("`cable_1` on `rotor_1`") != std::string::npos);
  CHECK(refusal("backlash_0 1 deg\n").find("`backlash_0` needs `cable_0`") != std::string::npos);
  CHECK(refusal("cable_0 nan N*m/rad\n").find("arm.txt:") == 0);
  CHECK(refusal("cable_0 20 N/m\n").find("arm.txt:") == 0);
}
