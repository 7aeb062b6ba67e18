// What motors carry of an arm's weight that springs balance, against the gradient of both energies,
// and of its joints' friction.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "controller/joints_rig.hpp"
#include "firmtouch/controller/compensated_device.hpp"
#include "firmtouch/device/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr double kCounts = 1e6, kElbow_kg = 0.05, kTip_kg = 0.03, kGravity = 9.81;
constexpr double kSpring[3] = {0, 0.3, 0.05}, kRelaxed_rad[3] = {0, 1.2, -0.4};

struct Section {
  device::LinkageLayout linkage;
  device::CompensationLayout compensation;
};
struct HotSection {
  device::HomedLinkageLayout homed;
  device::SecondEncodersLayout second;
  device::DeratingLayout derating;
  device::CompensationLayout compensation;
};

constexpr double kFriction_Nm[3] = {0.05, 0, 0.02}, kFrictionShare = 0.75, kFade = 0.1;

Section arm(float share = 0.5f) {
  constexpr double kLow_rad[3] = {-3, -3, -3}, kHigh_rad[3] = {3, 3, 3};
  Section to = {};
  to.linkage = arm_layout(static_cast<float>(kCounts), kLow_rad, kHigh_rad);
  to.linkage.elbow_mass_kg[0] = static_cast<float>(kElbow_kg);
  to.linkage.tip_mass_kg = static_cast<float>(kTip_kg);
  to.linkage.gravity_mps2[2] = static_cast<float>(-kGravity);
  to.linkage.carried_share = share;
  to.compensation.tag = device::kCompensationTag;
  for (int k = 0; k < 3; ++k) {
    to.compensation.spring_Nm_per_rad[k] = static_cast<float>(kSpring[k]);
    to.compensation.relaxed_rad[k] = static_cast<float>(kRelaxed_rad[k]);
  }
  return to;
}

// Of links of 0.3 and 0.25 m.
double energy_J(const double (&q)[3]) {
  const double elbow_m = .3 * std::sin(q[1]), tip_m = elbow_m + .25 * std::sin(q[1] + q[2]);
  double sum_J = kGravity * (kElbow_kg * elbow_m + kTip_kg * tip_m);
  for (int k = 0; k < 3; ++k)
    sum_J += .5 * kSpring[k] * (q[k] - kRelaxed_rad[k]) * (q[k] - kRelaxed_rad[k]);
  return sum_J;
}

double held_Nm(double (&q)[3], int joint) {
  const double middle = q[joint];
  q[joint] = middle + 1e-6;
  const double after_J = energy_J(q);
  q[joint] = middle - 1e-6;
  const double before_J = energy_J(q);
  q[joint] = middle;
  return (after_J - before_J) / 2e-6;
}

// Far from the part.
template <class Device = CompensatedDevice<AnyDevice>>
struct Rig : JointsRig<MeshController<Device>> {
  using Base = JointsRig<MeshController<Device>>;
  using Base::input;

  double q[3] = {}, middle_rad[3] = {};  // in the middle of the tick that begins
  explicit Rig(const Asset& asset) : Base(asset) {}
  void tick() {
    const double t = 1e-3 * input.tick;
    const double next[3] = {.4 * std::sin(3 * t), .9 + .4 * std::cos(4 * t),
                            -.8 + .3 * std::sin(5 * t)};
    for (int k = 0; k < 3; ++k) {
      input.encoder_counts[k] = static_cast<int32_t>(std::lround(next[k] * kCounts));
      const double at_rad = input.encoder_counts[k] / kCounts;
      middle_rad[k] = 1.5 * at_rad - .5 * q[k];
      q[k] = at_rad;
    }
    Base::step(input.tick > 3 ? record::kFlagEnable : 0, record::kCommandNone);
  }
};

template <class Layout>
Asset asset_of(const Layout& layout) {
  return Asset(file_with(layout));
}

}  // namespace

TEST(CompensatedDevice_CarriesTheGradientOfWeightAndSprings) {
  const Asset asset = asset_of(arm());
  Rig<> rig(asset);
  uint32_t compared = 0;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    CHECK_EQ(rig.output.faults, 0u);
    if (i < 400) continue;
    for (int k = 0; k < 3; ++k) {
      const double carried_Nm = static_cast<double>(rig.output.motor_N[k]);
      CHECK_LE(std::fabs(carried_Nm - held_Nm(rig.middle_rad, k)), 1e-5);
      compared += std::fabs(carried_Nm) > .01 ? 1u : 0u;
    }
  }
  CHECK_GE(compared, 3000u);
  check_replays(rig, asset);
}

TEST(CompensatedDevice_SpringsAndWeight_KeepTheirShareOfTheLimit) {
  const Asset asset = asset_of(arm(0.05f));  // of 2 N m
  Rig<> rig(asset);
  uint32_t held = 0;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    for (const float torque_Nm : rig.output.motor_N) {
      CHECK_LE(std::fabs(torque_Nm), 0.1f);
      held += std::fabs(torque_Nm) >= 0.1f ? 1u : 0u;
    }
  }
  CHECK_GE(held, 100u);
}

// Less the springs and the weight, which the same arm without friction carries: share x friction x
// rate / (|rate| + fade), of the rate in the record's velocity of joint 0.
TEST(CompensatedDevice_Friction_FollowsTheRates) {
  Section with = arm();
  for (int k = 0; k < 3; ++k)
    with.compensation.friction_Nm[k] = static_cast<float>(kFriction_Nm[k]);
  with.compensation.friction_share = static_cast<float>(kFrictionShare);
  with.compensation.friction_fade_rad_per_s = static_cast<float>(kFade);
  const Asset asset = asset_of(with), bare = asset_of(arm());
  Rig<> rig(asset), without(bare);
  uint32_t fast = 0;
  double before[3] = {};
  for (int i = 0; i < 3000; ++i) {
    rig.tick(), without.tick();
    CHECK_EQ(rig.output.faults, 0u);
    for (int k = 0; k < 3; ++k) {
      const double rate = (rig.q[k] - before[k]) / 1e-3;
      before[k] = rig.q[k];
      if (i < 400) continue;
      const double carried_Nm = static_cast<double>(rig.output.motor_N[k]) -
                                static_cast<double>(without.output.motor_N[k]);
      const double most_Nm = kFrictionShare * kFriction_Nm[k];
      CHECK_LE(std::fabs(carried_Nm), most_Nm + 1e-6);
      // Fast enough that the rate's error changes the law by less than a fiftieth.
      const double law_Nm = most_Nm * rate / (std::fabs(rate) + kFade);
      if (std::fabs(rate) > 0.3) CHECK_LE(std::fabs(carried_Nm - law_Nm), 0.02 * most_Nm);
      fast += std::fabs(rate) > 0.3 && k != 1 ? 1u : 0u;
    }
  }
  CHECK_GE(fast, 3000u);
  check_replays(rig, asset);
}

// No rate, of any count, makes weight, springs and friction exceed their share.
TEST(CompensatedDevice_AnyCounts_FrictionKeepsItsShare) {
  Section with = arm(0.05f);
  for (float& friction_Nm : with.compensation.friction_Nm) friction_Nm = 2;
  with.compensation.friction_share = 0.8f;
  with.compensation.friction_fade_rad_per_s = 0.001f;
  const Asset asset = asset_of(with);
  Rig<> rig(asset);
  uint32_t random = 1, held = 0;
  for (int i = 0; i < 20000; ++i) {
    for (int& count : rig.input.encoder_counts) {
      random = random * 1664525u + 1013904223u;
      count += static_cast<int>(random >> 16) % 2001 - 1000;
      count = std::clamp(count, -2000000, 2000000);
    }
    rig.input.command_value = 0;
    rig.step(i > 3 ? record::kFlagEnable : 0, record::kCommandNone);
    for (const float torque_Nm : rig.output.motor_N) {
      CHECK(std::isfinite(torque_Nm));
      CHECK_LE(std::fabs(torque_Nm), 0.1f);
      held += std::fabs(torque_Nm) >= 0.1f ? 1u : 0u;
    }
  }
  CHECK_GE(held, 1000u);
}

// Also one that had springs in the asset before.
TEST(CompensatedDevice_WithoutSprings_HasTheBitsOfItsBase) {
  const Asset sprung = asset_of(arm()), bare = asset_of(arm().linkage);
  Rig<> rig(sprung);
  for (int i = 0; i < 500; ++i) rig.tick();
  CHECK_EQ(rig.controller.open(bare.bytes()).rule, 0u);
  rig.controller.reset();
  Rig<> fresh(bare);
  Rig<AnyDevice> same(bare);
  rig.log.clear();
  rig.input = {};
  for (int i = 0; i < 2000; ++i) rig.tick(), fresh.tick(), same.tick();
  const size_t size = sizeof same.log[0] * same.log.size();
  CHECK(std::memcmp(same.log.data(), fresh.log.data(), size) == 0);
  CHECK(std::memcmp(same.log.data(), rig.log.data(), size) == 0);
}

TEST(CompensatedDevice_ItsSectionNeedsIt_BehindEveryOtherPart) {
  const Asset sprung = asset_of(arm());
  MeshController<DeratedDevice<RedundantDevice<IndexedDevice>>> without;
  CHECK_EQ(without.open(sprung.bytes()).rule, uint16_t{device::kRuleLinkageSize});
  HotSection hot = {};
  hot.homed.linkage = arm().linkage;
  hot.homed.homing.margin_rad = 0.1f;
  for (float& counts_per_rad : hot.second.counts_per_rad) counts_per_rad = 1300;
  hot.second.within_rad = 0.005f;
  for (int k = 0; k < 3; ++k) hot.derating.continuous_Nm[k] = 1, hot.derating.time_s[k] = 5;
  hot.compensation = arm().compensation;
  MeshController<CompensatedDevice<DeratedDevice<RedundantDevice<IndexedDevice>>>> controller;
  {
    const Asset asset = asset_of(hot);
    CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
    CHECK(controller.device().homing().is_open() && controller.device().derating().is_open() &&
          controller.device().second_encoders().is_open() &&
          controller.device().compensation().is_open());
    CHECK_EQ(controller.device().stored_bytes().size(), uint32_t{sizeof hot});
  }
  hot.compensation.relaxed_rad[1] = 101;
  const Asset broken = asset_of(hot);
  CHECK_EQ(controller.open(broken.bytes()).rule, uint16_t{device::kRuleCompensation});
  CHECK(!controller.device().linkage().is_open() && !controller.is_ready());
}
