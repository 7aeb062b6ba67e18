// The controller compares each joint's encoder with a second one: joints of numbers turn, and one
// encoder fails. The third differing tick is a fault, no force is left 10 ms later, and a log
// replays.
#include <cmath>
#include <cstring>

#include "controller/joints_rig.hpp"
#include "firmtouch/controller/redundant_device.hpp"
#include "firmtouch/device/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr double kFirst = 20000, kSecond = -1300, kWithin_rad = 0.005;  // counts of a radian
constexpr double kSound = -99;

struct Section {
  device::LinkageLayout linkage;
  device::SecondEncodersLayout second;
};
struct HomedSection {
  device::HomedLinkageLayout homed;
  device::SecondEncodersLayout second;
};

HomedSection arm() {
  HomedSection to = {};
  constexpr double kLow_rad[3] = {-0.8, -0.8, -2.0}, kHigh_rad[3] = {1.2, 1.2, -0.3};
  to.homed.linkage = arm_layout(static_cast<float>(kFirst), kLow_rad, kHigh_rad);
  to.homed.homing.by = static_cast<uint32_t>(device::HomeBy::kKnownPose);
  to.homed.homing.margin_rad = 0.1f;
  for (uint32_t k = 0; k < 3; ++k) {
    to.homed.homing.pose_rad[k] = k == 2 ? -1.2f : 0.5f;
    to.second.counts_per_rad[k] = static_cast<float>(kSecond);
  }
  to.second.within_rad = static_cast<float>(kWithin_rad);
  return to;
}

template <class Layout>
const Asset& asset_of(const Layout& layout) {
  static const Asset made(file_with(layout));
  return made;
}
const Asset& absolute() {
  const HomedSection from = arm();
  return asset_of(Section{from.homed.linkage, from.second});
}
const Asset& homed() { return asset_of(arm()); }

// Joints that swing; the first encoder of joint 1 may fail.
template <class Device>
struct Rig : JointsRig<MeshController<Device>> {
  using Base = JointsRig<MeshController<Device>>;
  using Base::input, Base::output;

  double angle_rad[3] = {}, off_rad = 0, stuck_rad = kSound;
  int32_t slipped = 0;
  uint32_t times = 0;

  explicit Rig(const Asset& asset) : Base(asset) { swing(); }
  void swing() {
    const double along = 0.002 * times++;
    const double middle_rad[3] = {0.2, 0.5, -1.2};
    for (int k = 0; k < 3; ++k) angle_rad[k] = middle_rad[k] + 0.3 * std::sin(along * (k + 2));
  }
  void tick(uint32_t flags, uint32_t command = record::kCommandNone) {
    uint8_t second[3];
    for (int k = 0; k < 3; ++k) {
      const double seen_rad = k == 1 && stuck_rad > kSound ? stuck_rad : angle_rad[k];
      input.encoder_counts[k] = static_cast<int32_t>(std::floor(seen_rad * kFirst));
      second[k] = static_cast<uint8_t>(static_cast<int32_t>(std::floor(angle_rad[k] * kSecond)));
    }
    input.encoder_counts[1] += slipped;
    off_rad = input.encoder_counts[1] / kFirst - angle_rad[1];
    Base::step(flags | record::flags_of_second(second), command);
    swing();
  }
  void run(uint32_t ticks) {
    tick(0);
    for (uint32_t i = 0; i < ticks; ++i) tick(record::kFlagEnable);
  }
  // Result: ticks, from the first in which the encoders differ by more than is tolerated for
  // certain, to a fault; or `most`.
  uint32_t ticks_to_fault(uint32_t most) {
    uint32_t differing = 0;
    for (uint32_t i = 0; i < most; ++i) {
      tick(record::kFlagEnable);
      if (std::fabs(off_rad) > kWithin_rad + 3 / -kSecond + 1 / kFirst) ++differing;
      if (output.faults != 0) return differing;
    }
    return most;
  }
  bool is_on() const { return Base::mode() == 2; }
};

}  // namespace

TEST(RedundantDevice_SoundEncodersAreNoFault) {
  Rig<RedundantDevice<AnyDevice>> rig(absolute());
  rig.run(5000);
  CHECK_EQ(rig.output.faults, 0u);
  CHECK(rig.is_on());
  check_replays(rig, absolute());
}

TEST(RedundantDevice_StuckAndSlippedEncoders_AreAFaultInTheThirdTick) {
  for (const bool is_stuck : {true, false})
    for (uint32_t from = 200; from < 1500; from += 37) {
      Rig<RedundantDevice<AnyDevice>> rig(absolute());
      rig.run(from);
      CHECK(rig.is_on());
      if (is_stuck)
        rig.stuck_rad = rig.angle_rad[1];
      else
        rig.slipped = 200;  // 0.01 rad, no jump that is not plausible
      const uint32_t ticks = rig.ticks_to_fault(600);
      CHECK_LE(ticks, 3u);
      CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
      for (int i = 0; i < 10; ++i) rig.tick(record::kFlagEnable);
      CHECK_LE(rig.motors_Nm(), 0.0);
      if (from == 200) check_replays(rig, absolute());
    }
}

// Without second encoders the same failures are no fault: they look like motion.
TEST(RedundantDevice_OneThatComparesNothing_SeesNothing) {
  const device::LinkageLayout alone = arm().homed.linkage;
  const Asset& asset = asset_of(alone);
  Rig<RedundantDevice<AnyDevice>> rig(asset);
  rig.run(200);
  rig.slipped = 200;
  CHECK_EQ(rig.ticks_to_fault(600), 600u);
  Rig<AnyDevice> same(asset);
  same.run(200);
  same.slipped = 200;
  CHECK_EQ(same.ticks_to_fault(600), 600u);
  CHECK(std::memcmp(same.log.data(), rig.log.data(), sizeof rig.log[0] * rig.log.size()) == 0);
}

TEST(RedundantDevice_WhatDiffers_CannotBeClearedAway) {
  Rig<RedundantDevice<AnyDevice>> rig(absolute());
  rig.run(300);
  rig.slipped = 200;
  rig.ticks_to_fault(10);
  rig.tick(0, record::kCommandClearFaults);
  CHECK_EQ(rig.output.faults, 0u);
  CHECK_LE(rig.ticks_to_fault(10), 3u);
  CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
}

TEST(RedundantDevice_HomedAnew_ComparesFromThereOn) {
  Rig<RedundantDevice<HomedDevice>> rig(homed());
  rig.run(300);
  CHECK_EQ(rig.output.faults, 0u);
  CHECK(rig.controller.device().is_homed() && rig.is_on());
  rig.slipped = 200;
  CHECK_LE(rig.ticks_to_fault(10), 3u);
  for (int i = 0; i < 40; ++i) rig.tick(record::kFlagEnable);
  CHECK(!rig.controller.device().is_homed());
  rig.tick(0, record::kCommandClearFaults);
  rig.run(600);
  CHECK_EQ(rig.output.faults, 0u);
  CHECK(rig.is_on());
  rig.slipped += 200;
  CHECK_LE(rig.ticks_to_fault(10), 3u);
  CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
  check_replays(rig, homed());
}

TEST(RedundantDevice_ItsSectionNeedsIt_AndItsRulesHold) {
  MeshController<AnyDevice> any;
  CHECK_EQ(any.open(absolute().bytes()).rule, uint16_t{device::kRuleLinkageSize});
  MeshController<HomedDevice> homes;
  CHECK_EQ(homes.open(homed().bytes()).rule, uint16_t{device::kRuleLinkageSize});
  HomedSection broken = arm();
  broken.second.within_rad = 1;
  MeshController<RedundantDevice<HomedDevice>> controller;
  const Asset asset(file_with(broken));
  CHECK_EQ(controller.open(asset.bytes()).rule, uint16_t{device::kRuleSecondEncoder});
  CHECK(!controller.device().linkage().is_open() && !controller.is_ready());
}
