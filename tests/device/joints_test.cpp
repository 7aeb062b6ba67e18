// Joint encoders: angles, rates, ranges, rejected samples, and everything that a count can be.
#include "firmtouch/device/joints.hpp"

#include <stdint.h>

#include "firmtouch/device/rules.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::Joints;
using device::JointSettings;

namespace {

const float kNan = test::nan_value();

float size(float a) { return a < 0.0f ? -a : a; }

JointSettings thousand_counts_per_rad() {
  JointSettings settings;
  for (device::JointSetting& joint : settings.joint) joint.counts_per_rad = 1000;
  settings.velocity.estimator = device::Estimator::kDifference;
  return settings;
}

// The rule that a change of good settings breaks, with its joint.
template <class Change>
uint32_t broken(const Change& change) {
  JointSettings settings;
  CHECK(check(settings).ok());
  change(settings);
  const core::Verdict verdict = check(settings);
  return verdict.rule * 100u + verdict.element;
}

}  // namespace

TEST(Joints_CountsBecomeAnglesRatesAndAMargin) {
  JointSettings settings;
  settings.joints = 2;
  settings.joint[0].counts_per_rad = 1000;
  settings.joint[1].counts_per_rad = -2000;
  settings.joint[1].zero_rad = .25f;
  settings.velocity.estimator = device::Estimator::kDifference;
  CHECK(check(settings).ok());
  device::JointState state;
  (void)read_joints(state, settings, {{0, 0, 0}, true, 1e-3f});
  const device::Joints joints = read_joints(state, settings, {{50, -100, 700}, true, 1e-3f});
  CHECK(joints.accepted);
  CHECK_EQ(joints.faults, 0u);
  CHECK_LE(size(joints.angle_rad[0] - .05f), 1e-7f);
  CHECK_LE(size(joints.angle_rad[1] - .3f), 1e-7f);
  CHECK_LE(size(joints.rate_rad_per_s[0] - 50), 1e-4f);
  CHECK_LE(size(joints.rate_rad_per_s[1] - 50), 1e-4f);
  CHECK_EQ(joints.angle_rad[2], 0.0f);
  CHECK_LE(size(joints.margin_rad - .7f), 1e-6f);
}

TEST(Joints_BeyondTheirRange_AreClampedWithAFault) {
  JointSettings settings;
  settings.joint[1].counts_per_rad = 1000;
  device::JointState state;
  (void)read_joints(state, settings, {{0, 0, 0}, true, 1.0f});
  const device::Joints joints = read_joints(state, settings, {{0, -1500, 0}, true, 1.0f});
  CHECK_EQ(joints.faults, device::kWorkspaceFault);
  CHECK_EQ(joints.angle_rad[1], -1.0f);
  CHECK_EQ(joints.margin_rad, 0.0f);
}

TEST(Joints_BeforeATrustedSample_AreNotStartedAndAtFault) {
  device::JointState state;
  const Joints joints = read_joints(state, JointSettings{}, {{5, 5, 5}, false, 1e-3f});
  CHECK(!joints.started);
  CHECK(!joints.accepted);
  CHECK_EQ(joints.faults & device::kEncoderFault, device::kEncoderFault);
}

// 100 rad/s are 100 counts a tick, and one is for flicker.
TEST(Joints_StepBeyondTheLargestSpeed_IsExtrapolatedTwiceThenHeldAndAFault) {
  const JointSettings settings = thousand_counts_per_rad();
  device::JointState state;
  (void)read_joints(state, settings, {{0, 0, 0}, true, 1e-3f});
  CHECK(read_joints(state, settings, {{0, 101, 0}, true, 1e-3f}).accepted);
  const Joints first = read_joints(state, settings, {{0, 900, 0}, true, 1e-3f});
  CHECK(!first.accepted);
  CHECK_EQ(first.faults, 0u);
  CHECK_LE(size(first.angle_rad[1] - .202f), 1e-6f);
  const Joints second = read_joints(state, settings, {{0, -900, 0}, true, 1e-3f});
  CHECK_LE(size(second.angle_rad[1] - .303f), 1e-6f);
  const Joints third = read_joints(state, settings, {{0, 900, 0}, false, 1e-3f});
  CHECK_EQ(third.faults, device::kEncoderFault);
  CHECK_EQ(third.angle_rad[1], second.angle_rad[1]);
  CHECK_EQ(third.rate_rad_per_s[1], 0.0f);
  // Four ticks since the last good sample allow 400 counts.
  const Joints back = read_joints(state, settings, {{0, 500, 0}, true, 1e-3f});
  CHECK(back.accepted);
  CHECK_LE(size(back.angle_rad[1] - .5f), 1e-6f);
}

TEST(Joints_StepOfMoreThanASecond_CountsAsOneSecond) {
  const JointSettings settings = thousand_counts_per_rad();
  device::JointState state;
  (void)read_joints(state, settings, {{0, 0, 0}, true, 1e-3f});
  const Joints joints = read_joints(state, settings, {{0, 0, 250}, true, 10.0f});
  CHECK_LE(size(joints.rate_rad_per_s[2] - .25f), 1e-6f);
}

TEST(Joints_SixBadSamplesOf32_AreAFaultUntilCleared) {
  const JointSettings settings = thousand_counts_per_rad();
  device::JointState state;
  for (uint32_t i = 0; i < 30; ++i) {
    const Joints joints = read_joints(state, settings, {{0, 0, 0}, i % 5 != 4, 1e-3f});
    CHECK_EQ(joints.faults, i >= 29 ? device::kEncoderFault : 0u);
  }
  clear(state);
  CHECK_EQ(read_joints(state, settings, {{0, 0, 0}, true, 1e-3f}).faults, 0u);
}

TEST(Joints_EveryBitPatternOfCountsAndTime_GiveFiniteAnglesWithinTheRange) {
  JointSettings settings;
  settings.joint[1].counts_per_rad = -1e7f;
  CHECK(check(settings).ok());
  test::Xorshift random(4);
  device::JointState state;
  for (uint32_t i = 0; i < 20000; ++i) {
    device::Sample sample{{}, random() % 8 != 0, test::float_of(random())};
    for (int32_t& counts : sample.counts) counts = static_cast<int32_t>(random() >> random() % 32);
    const Joints joints = read_joints(state, settings, sample);
    for (uint32_t k = 0; k < 3; ++k) {
      CHECK_LE(size(joints.angle_rad[k]), 1.0f);
      CHECK(joints.rate_rad_per_s[k] - joints.rate_rad_per_s[k] <= 0.0f);
    }
    CHECK(joints.margin_rad >= 0.0f && joints.margin_rad <= 1.0f);
  }
}

TEST(JointSettings_BadValues_BreakARuleByName) {
  using namespace device;  // NOLINT: rules
  CHECK_EQ(broken([](JointSettings& j) { j.joints = 4; }), kRuleJointCount * 100u);
  CHECK_EQ(broken([](JointSettings& j) { j.joint[2].counts_per_rad = 0; }),
           kRuleCountsPerRad * 100u + 2);
  CHECK_EQ(broken([](JointSettings& j) { j.joint[0].zero_rad = kNan; }), kRuleZeroAngle * 100u);
  CHECK_EQ(broken([](JointSettings& j) { j.joint[1].low_rad = 1; }), kRuleAngleRange * 100u + 1);
  CHECK_EQ(broken([](JointSettings& j) { j.max_speed_rad_per_s = 0; }), kRuleMaxSpeed * 100u);
  CHECK_EQ(broken([](JointSettings& j) { j.velocity.filter_Hz = kNan; }), kRuleEstimator * 100u);
}
