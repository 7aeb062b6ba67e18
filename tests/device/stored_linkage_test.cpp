// Linkages as an asset stores them: each rule broken alone, every word damaged, and the same pose
// as the plain structs.
#include "firmtouch/device/stored_linkage.hpp"

#include <stdint.h>

#include "firmtouch/device/rules.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::LinkageLayout;
using device::StoredLinkage;

namespace {

LinkageLayout five_bar() {
  LinkageLayout l = {};
  l.kind = device::kFiveBar;
  l.joints = 2;
  l.flags = device::kFlagTip;
  l.length_m[0] = l.length_m[1] = 0.063f;
  l.length_m[2] = l.length_m[3] = 0.075f;
  l.offset_m[0] = 0.025f;
  for (uint32_t k = 0; k < 2; ++k) {
    l.joint[k] = {2200, 0, 0.5f, 2.6f};
    l.max_torque_Nm[k] = 0.3f;
    l.elbow_mass_kg[k] = 0.01f;
  }
  l.torque_rise_s = 0.002f;
  l.max_speed_rad_per_s = 100;
  l.full_from = 0.1f;
  l.gone_at = 0.05f;
  l.tip_mass_kg = 0.02f;
  l.gravity_mps2[2] = -9.81f;
  l.carried_share = 0.5f;
  return l;
}

LinkageLayout delta() {
  LinkageLayout l = five_bar();
  l.kind = device::kDelta;
  l.joints = 3;
  for (uint32_t k = 0; k < 3; ++k) {
    l.length_m[k] = 0.06f;
    l.length_m[3 + k] = 0.103f;
    l.joint[k] = {2200, 0, 0.0f, 0.8f};
    l.max_torque_Nm[k] = 0.3f;
    l.elbow_mass_kg[k] = 0.01f;
  }
  l.offset_m[0] = 0.038f;
  l.offset_m[1] = 0.021f;
  l.offset_m[2] = 0.0045f;
  return l;
}

LinkageLayout arm() {
  LinkageLayout l = delta();
  l.kind = device::kSerialArm;
  l.flags = device::kFlagParallelogram;
  for (uint32_t k = 2; k < 6; ++k) l.length_m[k] = 0;
  l.offset_m[2] = 0;
  l.elbow_mass_kg[1] = l.elbow_mass_kg[2] = 0;
  return l;
}

core::Verdict open_layout(const LinkageLayout& layout, StoredLinkage& to) {
  return open(core::Bytes(reinterpret_cast<const uint8_t*>(&layout), sizeof layout), to);
}

template <class Change>
void check_broken(const LinkageLayout& good, const Change& change, uint16_t rule) {
  static LinkageLayout layout;
  StoredLinkage linkage;
  layout = good;
  CHECK_EQ(open_layout(layout, linkage).rule, 0u);
  CHECK(linkage.is_open());
  change(layout);
  CHECK_EQ(open_layout(layout, linkage).rule, rule);
  CHECK(!linkage.is_open());
}

const float kNan = test::nan_value();

}  // namespace

TEST(StoredLinkage_EachRuleIsBrokenAlone) {
  using namespace device;  // NOLINT: rules
  using L = LinkageLayout;
  check_broken(
      five_bar(), [](L& l) { l.kind = 0; }, kRuleKind);
  check_broken(
      five_bar(), [](L& l) { l.kind = 4; }, kRuleKind);
  check_broken(
      five_bar(), [](L& l) { l.joints = 3; }, kRuleKind);
  check_broken(
      arm(), [](L& l) { l.joints = 4; }, kRuleKind);
  check_broken(
      delta(), [](L& l) { l.joints = 2; }, kRuleKind);
  check_broken(
      five_bar(), [](L& l) { l.least_mass_kg = -1; }, kRuleLoad);
  check_broken(
      five_bar(), [](L& l) { l.least_mass_kg = kNan; }, kRuleLoad);
  check_broken(
      five_bar(), [](L& l) { l.flags = 8; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.flags = 2; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.length_m[5] = 0.1f; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.length_m[4] = -0.0f; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.offset_m[1] = kNan; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.joint[2].high_rad = 1; }, kRuleUnused);
  check_broken(
      five_bar(), [](L& l) { l.max_torque_Nm[2] = 1; }, kRuleUnused);
  check_broken(
      arm(), [](L& l) { l.elbow_mass_kg[2] = 1; }, kRuleUnused);
  check_broken(
      delta(), [](L& l) { l.length_m[4] = 0; }, kRuleLinkLength);
  check_broken(
      arm(), [](L& l) { l.offset_m[1] = 11; }, kRuleOffset);
  check_broken(
      five_bar(), [](L& l) { l.offset_m[0] = 2.5f; }, kRuleNeverCloses);
  check_broken(
      delta(), [](L& l) { l.joint[2].counts_per_rad = 0; }, kRuleCountsPerRad);
  check_broken(
      delta(), [](L& l) { l.joint[1].zero_rad = kNan; }, kRuleZeroAngle);
  check_broken(
      delta(), [](L& l) { l.joint[0].low_rad = 1; }, kRuleAngleRange);
  check_broken(
      delta(), [](L& l) { l.max_speed_rad_per_s = 0; }, kRuleMaxSpeed);
  check_broken(
      delta(), [](L& l) { l.max_torque_Nm[1] = -1; }, kRuleMaxTorque);
  check_broken(
      delta(), [](L& l) { l.gone_at = 0.2f; }, kRuleFade);
  check_broken(
      delta(), [](L& l) { l.torque_rise_s = kNan; }, kRuleTorqueRise);
  check_broken(
      delta(), [](L& l) { l.elbow_mass_kg[2] = -1; }, kRuleLoad);
  check_broken(
      delta(), [](L& l) { l.tip_mass_kg = kNan; }, kRuleLoad);
  check_broken(
      delta(), [](L& l) { l.gravity_mps2[0] = 1e4f; }, kRuleLoad);
  check_broken(
      delta(), [](L& l) { l.carried_share = 0.95f; }, kRuleLoad);
  const LinkageLayout whole = delta();
  StoredLinkage linkage;
  const auto* bytes = reinterpret_cast<const uint8_t*>(&whole);
  CHECK_EQ(open(core::Bytes(bytes, sizeof whole - 4), linkage).rule, uint16_t{kRuleLinkageSize});
  CHECK_EQ(open(core::Bytes(), linkage).rule, uint16_t{kRuleLinkageSize});
}

// Whatever passes the proof gives finite poses and torques.
TEST(StoredLinkage_EveryWordDamaged_IsRefusedOrFinite) {
  const LinkageLayout whole[] = {five_bar(), arm(), delta()};
  const uint32_t words[] = {0, 1, 0x7FC00000u, 0x7F800000u, 0x80000000u, 0x7F7FFFFFu, 0x00000001u};
  uint32_t opened = 0;
  for (const LinkageLayout& good : whole)
    for (uint32_t at = 0; at < sizeof good / 4; ++at)
      for (const uint32_t word : words) {
        LinkageLayout layout = good;
        __builtin_memcpy(reinterpret_cast<uint8_t*>(&layout) + at * 4, &word, sizeof word);
        StoredLinkage linkage;
        if (!open_layout(layout, linkage).ok()) continue;
        ++opened;
        const float angle_rad[3] = {0.3f, 0.4f, 0.2f};
        const device::Pose pose = pose_of(linkage, angle_rad);
        const math::Vec3 carrying = carrying_torques_Nm(linkage, angle_rad, pose);
        const device::JointTorques out = torques(pose, linkage.limits(), {3, -2, 1});
        const float sum = pose.position_m.x + pose.position_m.y + pose.position_m.z + carrying.x +
                          carrying.y + carrying.z + out.torque_Nm[0] + out.torque_Nm[1] +
                          out.torque_Nm[2];
        CHECK_EQ(sum - sum, 0.0f);
      }
  CHECK_GE(opened, 60u);
}

TEST(StoredLinkage_HasThePoseOfItsStruct) {
  test::Lcg random(4);
  const LinkageLayout bar = five_bar(), serial = arm(), three = delta();
  StoredLinkage stored_bar, stored_arm, stored_delta;
  CHECK(open_layout(bar, stored_bar).ok());
  CHECK(open_layout(serial, stored_arm).ok());
  CHECK(open_layout(three, stored_delta).ok());
  for (uint32_t i = 0; i < 200; ++i) {
    const float angle_rad[3] = {random.between(-3, 3), random.between(-3, 3),
                                random.between(-3, 3)};
    const auto same = [](const device::Pose& a, const device::Pose& b) {
      CHECK_EQ(test::bits_of(a.position_m.x), test::bits_of(b.position_m.x));
      CHECK_EQ(test::bits_of(a.column_m[1].y), test::bits_of(b.column_m[1].y));
    };
    same(pose_of(stored_bar, angle_rad),
         pose_of(device::FiveBar{0.025f, {0.063f, 0.063f}, {0.075f, 0.075f}, true}, angle_rad));
    same(pose_of(stored_arm, angle_rad),
         pose_of(device::SerialArm{3, {0.06f, 0.06f}, 0.038f, 0.021f, true}, angle_rad));
    same(pose_of(stored_delta, angle_rad),
         pose_of(
             device::Delta{
                 {0.06f, 0.06f, 0.06f}, {0.103f, 0.103f, 0.103f}, 0.038f, 0.021f, 0.0045f, true},
             angle_rad));
  }
}
