#pragma once
// A tool that rides over the part as a Cartesian device's does, held by an arm of three joints
// whose kinematics are the test's own.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "controller/ride.hpp"

namespace firmtouch::controller_test {

constexpr double kUpper_m = 0.3, kLower_m = 0.25, kAside_m = 0.35;
constexpr double kCountsPerRad = 1e7;  // of a radian

struct Tip {
  double x, y, z;
};

// Of a turntable, a shoulder and an elbow, by a product of rotations.
inline Tip tip_of(const double (&q)[3]) {
  const double out = kUpper_m * std::cos(q[1]) + kLower_m * std::cos(q[1] + q[2]);
  return {out * std::cos(q[0]), out * std::sin(q[0]),
          kUpper_m * std::sin(q[1]) + kLower_m * std::sin(q[1] + q[2])};
}

inline void angles_of(const Tip& p, double (&q)[3]) {
  const double out = std::hypot(p.x, p.y), far2 = out * out + p.z * p.z;
  q[0] = std::atan2(p.y, p.x);
  q[2] = -std::acos((far2 - kUpper_m * kUpper_m - kLower_m * kLower_m) / (2 * kUpper_m * kLower_m));
  q[1] = std::atan2(p.z, out) -
         std::atan2(kLower_m * std::sin(q[2]), kUpper_m + kLower_m * std::cos(q[2]));
}

// The transposed Jacobian by central differences, times the force.
inline double torque_of(double (&q)[3], int joint, const float (&force_N)[3]) {
  constexpr double kStep = 1e-6;
  const double middle = q[joint];
  q[joint] = middle + kStep;
  const Tip after = tip_of(q);
  q[joint] = middle - kStep;
  const Tip before = tip_of(q);
  q[joint] = middle;
  return (static_cast<double>(force_N[0]) * (after.x - before.x) +
          static_cast<double>(force_N[1]) * (after.y - before.y) +
          static_cast<double>(force_N[2]) * (after.z - before.z)) /
         (2 * kStep);
}

inline device::LinkageLayout arm_with(float max_torque_Nm) {
  device::LinkageLayout l = {};
  l.kind = device::kSerialArm;
  l.joints = 3;
  l.length_m[0] = static_cast<float>(kUpper_m);
  l.length_m[1] = static_cast<float>(kLower_m);
  for (uint32_t k = 0; k < 3; ++k) {
    l.joint[k] = {static_cast<float>(kCountsPerRad), 0, -3, 3};
    l.max_torque_Nm[k] = max_torque_Nm;
  }
  l.torque_rise_s = 0.002f;
  l.max_speed_rad_per_s = 50;
  l.full_from = 0.1f;
  l.gone_at = 0.05f;
  return l;
}

inline std::vector<uint8_t> file_with(const device::LinkageLayout& layout) {
  std::vector<tools::Section> sections = part_sections();
  sections.push_back(tools::make_section(device::kLinkageSection, "arm", &layout, 1));
  return file_of(std::move(sections));
}

inline void put_counts(const double (&q)[3], record::TickInput& input) {
  for (int k = 0; k < 3; ++k)
    input.encoder_counts[k] = static_cast<int32_t>(std::lround(q[k] * kCountsPerRad));
}

// The ride's tool, held by the arm, with the part aside of its base.
struct ArmRide {
  Asset asset;
  Ride cartesian;
  FullController controller;
  record::TickOutput output{};
  double angle_rad[3] = {};
  float stiffness_N_per_m = 800;

  explicit ArmRide(const device::LinkageLayout& layout)
      : asset(file_with(layout)), cartesian(without_linkage()) {
    CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
    CHECK(controller.linkage().is_open());
  }
  static const Asset& without_linkage() {
    static const Asset part(file_of(part_sections()));
    return part;
  }
  record::TickInput input_of(uint32_t tick) {
    cartesian.fill(tick);
    record::TickInput input = cartesian.input;
    angles_of({input.encoder_counts[0] * 1e-5 + kAside_m, input.encoder_counts[1] * 1e-5,
               input.encoder_counts[2] * 1e-5},
              angle_rad);
    put_counts(angle_rad, input);
    if (tick == 2) {
      input.command = 1 + static_cast<uint32_t>(params::kSceneX);
      input.command_value = static_cast<float>(kAside_m);
    }
    if (tick == 3) {
      input.command = 1 + static_cast<uint32_t>(params::kContactStiffness);
      input.command_value = stiffness_N_per_m;
    }
    return input;
  }
  void step(uint32_t tick) {
    const record::TickInput input = input_of(tick);
    std::memset(&output, 0xA5, sizeof output);  // a tick writes all of it
    controller.tick(input, output);
    cartesian.step();
  }
};

}  // namespace firmtouch::controller_test
