// The simulated linkage: its energy, its motion against constrained point masses, friction, and the
// force at its tip against the firmware's torques.
#include "host_sim/device/linkage_body.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "firmtouch/device/stored_linkage.hpp"
#include "harness/long.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::EnergyBook;
using host_sim::JointMotion;
using host_sim::LinkageBody;
using host_sim::Vec;
using tools::LinkageDevice;

namespace {

constexpr double kNone[3] = {0, 0, 0};

std::string joints(int count, const std::string& low, const std::string& high) {
  std::string text;
  for (int k = 0; k < count; ++k) {
    const std::string end = "_" + std::to_string(k) + " ";
    text += "counts" + end + "1e6 counts/rad\nlow" + end + low + " deg\nhigh" + end + high +
            " deg\nmax_torque" + end + "0.5 N*m\nrotor" + end + "2e-6 kg*m2\n";
  }
  return text;
}

// Gravity in the plane of the five-bar, so that it swings.
const std::string kFiveBar =
    "linkage five_bar\nbase 80 mm\nproximal_0 63 mm\nproximal_1 60 mm\ndistal_0 75 mm\n"
    "distal_1 78 mm\nproximal_mass_0 12 g\nproximal_mass_1 14 g\nproximal_centre_0 20 mm\n"
    "distal_mass_0 9 g\ndistal_mass_1 11 g\ntip_mass 20 g\ngravity_y 9.81 m/s2\ngravity_z 0 m/s2\n";
const std::string kDelta =
    "linkage delta\nupper_0 60 mm\nupper_1 60 mm\nupper_2 60 mm\nlower_0 103 mm\nlower_1 103 mm\n"
    "lower_2 103 mm\nbase_radius 80 mm\nplatform_radius 21 mm\nside 4.5 mm\nupper_mass_0 20 g\n"
    "upper_mass_1 22 g\nupper_mass_2 18 g\nupper_centre_1 25 mm\nlower_mass_0 8 g\n"
    "lower_mass_1 8 g\nlower_mass_2 9 g\ntip_mass 60 g\ngravity_z 9.81 m/s2\n";
const std::string kArm =
    "linkage serial_arm 3\nlink_0 130 mm\nlink_1 120 mm\noffset 20 mm\nlink_mass_0 50 g\n"
    "link_mass_1 30 g\nlink_centre_0 50 mm\ntip_mass 25 g\n";

LinkageDevice five_bar(const std::string& more = "") {
  return tools::read_device("five-bar", kFiveBar + joints(2, "-400", "400") + more);
}
LinkageDevice delta(const std::string& more = "") {
  return tools::read_device("delta", kDelta + joints(3, "-400", "400") + more);
}
LinkageDevice arm(const std::string& more = "") {
  return tools::read_device("arm", kArm + joints(3, "-400", "400") + more);
}

struct Swing {
  const char* name;
  LinkageDevice device;
  JointMotion start;
};

std::vector<Swing> swings(const std::string& more = "") {
  return {{"five-bar", five_bar(more), {{1.8, 1.35}, {0.5, -0.3}}},
          {"delta", delta(more), {{1.2, 1.3, 1.1}, {1, -0.5, 0.2}}},
          {"arm", arm(more), {{0.2, -1.2, -0.6}, {0, 0.5, -0.5}}}};
}

double size(double a) { return std::fabs(a); }

}  // namespace

// 60 s of the arm; of the others with --long, else 10 s.
TEST(FreeSwing_60Seconds_KeepsItsEnergy) {
  for (const Swing& swing : swings("spring_0 5 mN*m/rad\nrelaxed_0 2 rad\n")) {
    LinkageBody body(swing.device, swing.start);
    CHECK(body.has_inertia());
    double low_J = 1e9, high_J = -1e9, worst_J = 0, moved_rad = 0;
    const bool is_arm = swing.device.linkage.index() == 1;
    const uint32_t seconds = is_arm || test::is_long() ? 60 : 10;
    for (uint32_t step = 0; step < seconds * 50000; ++step) {
      body.advance(kNone, {}, 2e-5);
      if (step % 50 != 0) continue;
      const EnergyBook& book = body.energy();
      worst_J = std::max(worst_J, size(book.stored_J - book.start_J));
      const double kinetic_J = body.kinetic_J();
      low_J = std::min(low_J, kinetic_J), high_J = std::max(high_J, kinetic_J);
      moved_rad = std::max(moved_rad, size(body.motion().angle_rad[1] - swing.start.angle_rad[1]));
    }
    test::note(swing.name, static_cast<uint32_t>(worst_J / high_J * 1e12));
    CHECK_GE(moved_rad, 0.2);
    CHECK_LE(low_J, 0.5 * high_J);
    CHECK_LE(worst_J, 1e-6 * high_J);
  }
}

// Hand and motors push, friction brakes, and the stops are hit.
TEST(Balance_WorkIsStoredOrLost) {
  const std::string dry =
      "viscous_0 1e-4 N*m*s/rad\ncoulomb_0 0.002 N*m\nspring_1 2 mN*m/rad\nrelaxed_1 1.5 rad\n"
      "coulomb_1 0.003 N*m\nstop_stiffness 30 N*m/rad\n";
  std::vector<Swing> all = swings(dry);
  for (const Swing& swing :
       swings(dry + "breakaway_0 0.004 N*m\nstribeck_speed_0 0.1 rad/s\nbreakaway_1 0.006 N*m\n"
                    "stribeck_speed_1 0.05 rad/s\n"))
    all.push_back(swing);
  for (const Swing& swing : all) {
    LinkageDevice device = swing.device;
    device.joints.joint[0].high_rad = static_cast<float>(swing.start.angle_rad[0]) + 0.02f;
    LinkageBody body(device, swing.start);
    double beyond_rad = 0;
    for (uint32_t step = 0; step < 100000; ++step) {
      const double t = step * 2e-5;
      const double motor_Nm[] = {0.006 * std::sin(9 * t), -0.004 * std::cos(7 * t), 0.003};
      body.advance(motor_Nm,
                   {0.05 * std::sin(5 * t), 0.04 * std::cos(4 * t), 0.05 * std::sin(3 * t)}, 2e-5);
      beyond_rad = std::max(beyond_rad, body.motion().angle_rad[0] -
                                            static_cast<double>(device.joints.joint[0].high_rad));
    }
    const EnergyBook& book = body.energy();
    test::note(swing.name, static_cast<uint32_t>(size(book.error_J()) / book.turnover_J * 1e9));
    CHECK_GE(book.lost_J, 1e-3);
    CHECK_GE(beyond_rad, 1e-4);
    CHECK_LE(size(book.error_J()), 1e-5 * book.turnover_J);
  }
}

TEST(DryFriction_HoldsUpToItsTorque_AndBringsToRest) {
  LinkageDevice device = five_bar("coulomb_0 0.005 N*m\ncoulomb_1 0.005 N*m\n");
  device.masses.gravity_mps2 = {};
  LinkageBody body(device, {{2.1, 1.0}, {}});
  const double weak_Nm[] = {0.0049, -0.0049, 0}, strong_Nm[] = {0.0052, 0, 0};
  for (int step = 0; step < 50000; ++step) body.advance(weak_Nm, {}, 2e-5);
  CHECK_LE(size(body.motion().angle_rad[0] - 2.1), 1e-12);
  CHECK_LE(size(body.motion().angle_rad[1] - 1.0), 1e-12);
  for (int step = 0; step < 5000; ++step) body.advance(strong_Nm, {}, 2e-5);
  CHECK_GE(size(body.motion().angle_rad[0] - 2.1), 1e-3);
  for (int step = 0; step < 50000; ++step) body.advance(kNone, {}, 2e-5);
  CHECK_LE(size(body.motion().rate_rad_per_s[0]), 1e-9);
}

// Closed form: a rotor without links, a pendulum of torsion.
TEST(BalancingSpring_SwingsAtItsOwnFrequency) {
  LinkageDevice device = tools::read_device(
      "arm",
      "linkage serial_arm 2\nlink_0 130 mm\nlink_1 120 mm\nspring_0 0.2 N*m/rad\n"
      "relaxed_0 0.3 rad\n" +
          joints(2, "-400", "400"));
  device.masses.joint[0].rotor_kg_m2 = 1e-3;
  LinkageBody body(device, {{0.8, 1}, {}});
  const double turns_per_s = std::sqrt(0.2 / 1e-3);  // radians of its phase
  double worst_rad = 0;
  for (uint32_t step = 1; step <= 100000; ++step) {
    body.advance(kNone, {}, 2e-5);
    const double expected_rad = 0.3 + 0.5 * std::cos(turns_per_s * step * 2e-5);
    worst_rad = std::max(worst_rad, size(body.motion().angle_rad[0] - expected_rad));
  }
  CHECK_LE(worst_rad, 1e-6);
  CHECK_LE(size(body.energy().weight_J - 0.1 * std::pow(body.motion().angle_rad[0] - 0.3, 2)),
           1e-12);
}

static device::StoredLinkage opened(const device::LinkageLayout& layout) {
  device::StoredLinkage linkage;
  CHECK(open(core::Bytes(reinterpret_cast<const uint8_t*>(&layout), sizeof layout), linkage).ok());
  return linkage;
}

// The firmware's pose and torques, from counts, hold a hand of the opposite force still.
TEST(StaticForce_IsTheOneRequested) {
  test::Lcg random(3);
  for (const Swing& swing : swings()) {
    const device::LinkageLayout layout = tools::layout_of(swing.device);
    const device::StoredLinkage linkage = opened(layout);
    uint32_t poses = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
      JointMotion at = swing.start;
      for (double& angle : at.angle_rad) angle += static_cast<double>(random.between(-.5f, .5f));
      const LinkageBody body(swing.device, at);
      device::JointState state;
      const device::Joints joints =
          read_joints(state, linkage.joints({device::Estimator::kDifference, 100}),
                      {{body.count(0), body.count(1), body.count(2)}, true, 0.001f});
      const device::Pose pose = pose_of(linkage, joints.angle_rad);
      if (pose.reciprocal_condition < 0.2f) continue;
      ++poses;
      const math::Vec3 force_N{random.between(-1, 1), random.between(-1, 1),
                               layout.joints == 2 ? 0 : random.between(-1, 1)};
      const device::JointTorques out = torques(pose, linkage.limits(), force_N);
      CHECK_EQ(out.share, 1.0f);
      const Vec tip_N = body.tip_force_N({static_cast<double>(out.torque_Nm[0]),
                                          static_cast<double>(out.torque_Nm[1]),
                                          static_cast<double>(out.torque_Nm[2])});
      const Vec off = tip_N - tools::to_point(force_N);
      CHECK_LE(host_sim::norm(off), 0.005 * host_sim::norm(tools::to_point(force_N)));
    }
    CHECK_GE(poses, 300u);
  }
}

// Against the torques that hold the body, whose gravity the constrained masses below confirm.
TEST(CarriedWeight_1000Poses_LeavesAHundredthAtMost) {
  test::Lcg random(5);
  std::vector<Swing> all = swings();
  for (Swing& swing : all) {
    swing.device.masses.gravity_mps2 = {4, -5, 7};  // mounted askew: every axis counts
    const device::LinkageLayout layout = tools::layout_of(swing.device);
    const device::StoredLinkage linkage = opened(layout);
    uint32_t poses = 0;
    double heaviest_Nm = 0, worst_Nm = 0;
    while (poses < 1000) {
      JointMotion at = swing.start;
      for (double& angle : at.angle_rad) angle += static_cast<double>(random.between(-.5f, .5f));
      float angle_rad[3];
      for (int k = 0; k < 3; ++k) angle_rad[k] = static_cast<float>(at.angle_rad[k]);
      const device::Pose pose = pose_of(linkage, angle_rad);
      if (pose.reciprocal_condition < 0.1f) continue;
      ++poses;
      const math::Vec3 carried = carrying_torques_Nm(linkage, angle_rad, pose);
      double held_Nm[3];
      LinkageBody(swing.device, at).holding_torques_Nm(held_Nm);
      const double off[] = {held_Nm[0] - static_cast<double>(carried.x),
                            held_Nm[1] - static_cast<double>(carried.y),
                            held_Nm[2] - static_cast<double>(carried.z)};
      for (uint32_t k = 0; k < layout.joints; ++k) {
        heaviest_Nm = std::max(heaviest_Nm, size(held_Nm[k]));
        worst_Nm = std::max(worst_Nm, size(off[k]));
      }
    }
    CHECK_GE(heaviest_Nm, 0.005);
    CHECK_LE(worst_Nm, 1e-4 * heaviest_Nm);
  }
}
