#pragma once
// An arm of three joints on a mesh, whose joints the test moves: what the tests of homing, index
// pulses and second encoders stand on.
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "controller/ride.hpp"

namespace firmtouch::controller_test {

/// Links of 0.3 and 0.25 m, motors of 2 N m.
template <class Real>
device::LinkageLayout arm_layout(float counts_per_rad, const Real (&low_rad)[3],
                                 const Real (&high_rad)[3]) {
  device::LinkageLayout l = {};
  l.kind = device::kSerialArm;
  l.joints = 3;
  l.length_m[0] = 0.3f;
  l.length_m[1] = 0.25f;
  l.torque_rise_s = 0.002f;
  l.max_speed_rad_per_s = 50;
  l.full_from = 0.1f;
  l.gone_at = 0.05f;
  for (uint32_t k = 0; k < 3; ++k) {
    l.joint[k] = {counts_per_rad, 0, static_cast<float>(low_rad[k]),
                  static_cast<float>(high_rad[k])};
    l.max_torque_Nm[k] = 2;
  }
  return l;
}

/// The part with a linkage's section.
template <class Layout>
std::vector<uint8_t> file_with(const Layout& layout) {
  std::vector<tools::Section> sections = part_sections();
  sections.push_back(tools::make_section(device::kLinkageSection, "arm", &layout, 1));
  return file_of(std::move(sections));
}

template <class Device>
using MeshController = Controller<Surfaces<MeshSurface>, NoGuide, Device>;

template <class OfController>
struct JointsRig {
  OfController controller;
  record::TickInput input{};
  record::TickOutput output{};
  std::vector<record::TickRecord> log;

  explicit JointsRig(const Asset& asset) { CHECK_EQ(controller.open(asset.bytes()).rule, 0u); }
  /// Of the counts that the test has put into the input.
  void step(uint32_t flags, uint32_t command) {
    input.clock_us = input.tick * 1000;
    input.flags = flags;
    input.command = command;
    std::memset(&output, 0xA5, sizeof output);  // a tick writes all of it
    controller.tick(input, output);
    log.push_back({input, output});
    ++input.tick;
  }
  uint32_t mode() const { return output.state & record::kStateServoMask; }
  double motors_Nm() const {
    double sum_Nm = 0;
    for (const float torque_Nm : output.motor_N)
      sum_Nm += std::fabs(static_cast<double>(torque_Nm));
    return sum_Nm;
  }
  /// From the tip at these angles to where the controller sees it.
  double off_m(const double (&at)[3]) const {
    const double out = .3 * std::cos(at[1]) + .25 * std::cos(at[1] + at[2]);
    const double up = .3 * std::sin(at[1]) + .25 * std::sin(at[1] + at[2]);
    return std::hypot(static_cast<double>(output.position_m[0]) - out * std::cos(at[0]),
                      static_cast<double>(output.position_m[1]) - out * std::sin(at[0]),
                      static_cast<double>(output.position_m[2]) - up);
  }
};

template <class OfController>
void check_replays(const JointsRig<OfController>& rig, const Asset& asset) {
  static OfController again;
  CHECK_EQ(again.open(asset.bytes()).rule, 0u);
  CHECK_EQ(differing_ticks(again, rig.log), 0u);
}

}  // namespace firmtouch::controller_test
