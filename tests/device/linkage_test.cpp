// What holds of every linkage: closed poses, the fade, torque limits, total functions, rules by
// name, and the same bits everywhere.
#include "firmtouch/device/linkage.hpp"

#include <stdint.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/serial_arm.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::Delta;
using device::FiveBar;
using device::JointTorques;
using device::Pose;
using device::SerialArm;
using device::TorqueLimits;
using math::Vec3;

namespace {

constexpr float kQuarter = 1.5707964f;
const FiveBar kFiveBarLinks{.025f, {.063f, .063f}, {.075f, .075f}, true};
const SerialArm kArm{3, {.13f, .12f}, .02f, .1f, false};
const Delta kDeltaLinks{{.06f, .06f, .06f}, {.103f, .103f, .103f}, .038f, .021f, .0045f, true};
const TorqueLimits kLimits{.1f, .05f, {.2f, .3f, .15f}};

float size(float a) { return a < 0.0f ? -a : a; }
bool is_finite(Vec3 a) {
  const float nothing = (a.x - a.x) + (a.y - a.y) + (a.z - a.z);
  return nothing <= 0.0f;
}

void check_near(Vec3 a, Vec3 b, float most) {
  CHECK_LE(size(a.x - b.x), most);
  CHECK_LE(size(a.y - b.y), most);
  CHECK_LE(size(a.z - b.z), most);
}

// Poses of all linkages at these angles.
template <class Take>
void each_pose(const float (&angle_rad)[3], const Take& take) {
  take(pose_of(kFiveBarLinks, angle_rad));
  take(pose_of(kArm, angle_rad));
  take(pose_of(kDeltaLinks, angle_rad));
}

Pose isotropic(float condition) {
  return {{}, {{.1f, 0, 0}, {0, .1f, 0}, {0, 0, .1f}}, condition, true};
}

// The rule that a change of a good struct breaks, with its element.
template <class Data, class Change>
uint32_t broken(Data data, const Change& change) {
  CHECK(device::check(data).ok());
  change(data);
  const core::Verdict verdict = device::check(data);
  return verdict.rule * 100u + verdict.element;
}

const float kNan = test::nan_value();

}  // namespace

TEST(FiveBar_SymmetricPose_HasItsTipOnTheAxis) {
  const Pose pose = pose_of(kFiveBarLinks, {2 * kQuarter - 1.0f, 1.0f, 0});
  CHECK(pose.is_reachable);
  CHECK_LE(size(pose.position_m.x), 1e-8f);
  CHECK_GT(pose.position_m.y, .063f);
  // Mirrored joints move the tip in mirrored directions.
  CHECK_LE(size(pose.column_m[0].x - pose.column_m[1].x), 1e-7f);
  CHECK_LE(size(pose.column_m[0].y + pose.column_m[1].y), 1e-7f);
  FiveBar other = kFiveBarLinks;
  other.is_tip_left = false;
  CHECK_LT(pose_of(other, {2 * kQuarter - 1.0f, 1.0f, 0}).position_m.y, .06f);
}

TEST(SerialArm_RightAngles_AreAtTheSumsOfTheLinks) {
  check_near(pose_of(kArm, {0, 0, kQuarter}).position_m, {.15f, 0, .22f}, 1e-7f);
  check_near(pose_of(kArm, {kQuarter, kQuarter, -kQuarter}).position_m, {0, .14f, .23f}, 1e-7f);
  SerialArm parallelogram = kArm;
  parallelogram.has_parallelogram = true;
  check_near(pose_of(parallelogram, {0, kQuarter, 0}).position_m, {.14f, 0, .23f}, 1e-7f);
  const SerialArm planar{2, {.2f, .1f}, 0, 0, false};
  check_near(pose_of(planar, {0, kQuarter, 0}).position_m, {.2f, .1f, 0}, 1e-7f);
}

TEST(Delta_EqualAngles_HaveTheTipOnZ) {
  const Pose pose = pose_of(kDeltaLinks, {.5f, .5f, .5f});
  CHECK(pose.is_reachable);
  CHECK_LE(size(pose.position_m.x), 3e-8f);
  CHECK_LE(size(pose.position_m.y), 3e-8f);
  CHECK_GT(pose.position_m.z, .06f);
  Delta below = kDeltaLinks;
  below.is_tip_above = false;
  CHECK_LT(pose_of(below, {.5f, .5f, .5f}).position_m.z, 0.0f);
}

// Elbows 0.151 m apart of 0.150 m that the distal links reach.
TEST(FiveBar_ElbowsOutOfReach_GiveNoJacobianAndNoTorque) {
  const Pose pose = pose_of(kFiveBarLinks, {2 * kQuarter, 0, 0});
  CHECK(!pose.is_reachable);
  CHECK_EQ(pose.reciprocal_condition, 0.0f);
  CHECK_LE(size(pose.position_m.x), 1e-7f);
  const JointTorques none = torques(pose, kLimits, {1, 1, 1});
  CHECK_EQ(none.share, 0.0f);
  CHECK_EQ(none.torque_Nm[0], 0.0f);
}

TEST(SerialArm_StretchedElbow_IsSingular) {
  CHECK_LE(pose_of(kArm, {.3f, .4f, 0}).reciprocal_condition, 1e-6f);
  CHECK_GE(pose_of(kArm, {.3f, .4f, .8f}).reciprocal_condition, .2f);
}

TEST(ReciprocalCondition_IsOneOfEqualOrthogonalColumnsAndZeroOfParallelOnes) {
  const Vec3 equal[3] = {{0, 3, 0}, {0, 0, 3}, {-3, 0, 0}};
  CHECK_LE(size(device::reciprocal_condition(equal) - 1), 1e-6f);
  const Vec3 parallel[3] = {{1, 2, 3}, {2, 4, 6}, {0, 1, 0}};
  CHECK_LE(device::reciprocal_condition(parallel), 1e-6f);
  // Of a planar arm at a right angle, 0.4 and 0.2 m: columns of sqrt(0.2) and 0.2 m.
  const SerialArm planar{2, {.4f, .2f}, 0, 0, false};
  CHECK_LE(size(pose_of(planar, {0, kQuarter, 0}).reciprocal_condition - .16f / .24f), 1e-6f);
  const Vec3 broken_columns[3] = {{kNan, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  CHECK_EQ(device::reciprocal_condition(broken_columns), 0.0f);
}

TEST(Torques_BetweenGoneAndFull_FadeInProportion) {
  const Vec3 force_N{1, -.5f, .25f};
  CHECK_EQ(torques(isotropic(.05f), kLimits, force_N).share, 0.0f);
  CHECK_EQ(torques(isotropic(kNan), kLimits, force_N).share, 0.0f);
  CHECK_LE(size(torques(isotropic(.0625f), kLimits, force_N).share - .25f), 1e-6f);
  CHECK_EQ(torques(isotropic(.1f), kLimits, force_N).share, 1.0f);
  const JointTorques whole = torques(isotropic(1), kLimits, force_N);
  CHECK_LE(size(whole.torque_Nm[0] - .1f), 1e-8f);
  CHECK_LE(size(whole.torque_Nm[1] + .05f), 1e-8f);
}

TEST(Torques_AnyForceAndPose_StayWithinTheLimitsInTheForcesDirection) {
  test::Lcg random(25);
  uint32_t limited = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const float angle_rad[3] = {random.between(-3, 3), random.between(-3, 3),
                                random.between(-3, 3)};
    float scale = random.between(0, 1);
    scale = i % 7 == 0 ? 1e36f * scale : 30 * scale;
    const Vec3 force_N{scale * random.between(-1, 1), scale * random.between(-1, 1),
                       scale * random.between(-1, 1)};
    each_pose(angle_rad, [&](const Pose& pose) {
      const JointTorques found = torques(pose, kLimits, force_N);
      CHECK(found.share >= 0.0f && found.share <= 1.0f);
      limited += found.share > 0.0f && found.share < 1.0f ? 1 : 0;
      float fullest = 0;
      for (uint32_t k = 0; k < 3; ++k) {
        const float part = size(found.torque_Nm[k]) / kLimits.max_torque_Nm[k];
        fullest = part > fullest ? part : fullest;
        CHECK_LE(size(found.torque_Nm[k]), kLimits.max_torque_Nm[k]);
        const Vec3 c = pose.column_m[k];
        const float whole_Nm = c.x * force_N.x + c.y * force_N.y + c.z * force_N.z;
        if (scale < 31.0f) CHECK_LE(size(found.torque_Nm[k] - found.share * whole_Nm), 1e-6f);
      }
      // No more is taken off than the limits demand.
      if (found.share < 1.0f && pose.reciprocal_condition >= kLimits.full_from)
        CHECK_GE(fullest, .999999f);
    });
  }
  CHECK_GE(limited, 1000u);
}

TEST(Linkages_EveryBitPatternOfAnglesAndForces_GiveFiniteResults) {
  test::Xorshift random(3);
  for (uint32_t i = 0; i < 20000; ++i) {
    const float angle_rad[3] = {test::float_of(random()), test::float_of(random()),
                                test::float_of(random())};
    const Vec3 force_N{test::float_of(random()), test::float_of(random()),
                       test::float_of(random())};
    each_pose(angle_rad, [&](const Pose& pose) {
      CHECK(is_finite(pose.position_m));
      for (const Vec3 column : pose.column_m) CHECK(is_finite(column));
      CHECK(pose.reciprocal_condition >= 0.0f && pose.reciprocal_condition <= 1.0f);
      const JointTorques found = torques(pose, kLimits, force_N);
      for (uint32_t k = 0; k < 3; ++k) CHECK_LE(size(found.torque_Nm[k]), kLimits.max_torque_Nm[k]);
    });
  }
}

TEST(TipVelocity_IsTheJacobianTimesTheRates) {
  Pose pose = isotropic(1);
  pose.column_m[1] = {.2f, .1f, 0};
  check_near(tip_velocity(pose, {1, 2, -3}), {.5f, .2f, -.3f}, 1e-7f);
}

TEST(Linkages_BadLengthsOffsetsAndJoints_BreakARuleByName) {
  using namespace device;  // NOLINT: rules
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.proximal_m[1] = 0; }),
           kRuleLinkLength * 100u + 1);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.distal_m[1] = kNan; }),
           kRuleLinkLength * 100u + 3);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.base_m = -.01f; }), kRuleOffset * 100u);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.base_m = .3f; }), kRuleNeverCloses * 100u);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.distal_m[0] = .3f; }), kRuleNeverCloses * 100u);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.proximal_m[0] = .3f; }),
           kRuleNeverCloses * 100u);
  CHECK_EQ(broken(kFiveBarLinks, [](FiveBar& b) { b.proximal_m[1] = .3f; }),
           kRuleNeverCloses * 100u);
  CHECK_EQ(broken(kArm, [](SerialArm& a) { a.joints = 4; }), kRuleJointCount * 100u);
  CHECK_EQ(broken(kArm, [](SerialArm& a) { a.joints = 2; }), kRuleOffset * 100u);
  CHECK_EQ(broken(kArm, [](SerialArm& a) { a.link_m[1] = -.1f; }), kRuleLinkLength * 100u + 1);
  CHECK_EQ(broken(kArm, [](SerialArm& a) { a.height_m = kNan; }), kRuleOffset * 100u + 1);
  CHECK_EQ(broken(kDeltaLinks, [](Delta& d) { d.upper_m[2] = 11; }), kRuleLinkLength * 100u + 2);
  CHECK_EQ(broken(kDeltaLinks, [](Delta& d) { d.lower_m[0] = 0; }), kRuleLinkLength * 100u + 3);
  CHECK_EQ(broken(kDeltaLinks, [](Delta& d) { d.side_m = kNan; }), kRuleOffset * 100u + 2);
  CHECK_EQ(broken(kDeltaLinks, [](Delta& d) { d.side_m = .2f; }), kRuleNeverCloses * 100u);
  CHECK_EQ(broken(kDeltaLinks, [](Delta& d) { d.base_radius_m = .3f; }), kRuleNeverCloses * 100u);
}

TEST(TorqueLimits_BadValues_BreakARuleByName) {
  using namespace device;  // NOLINT: rules
  CHECK_EQ(broken(kLimits, [](TorqueLimits& t) { t.max_torque_Nm[1] = kNan; }),
           kRuleMaxTorque * 100u + 1);
  CHECK_EQ(broken(kLimits, [](TorqueLimits& t) { t.gone_at = .1f; }), kRuleFade * 100u);
  // Every rule has a text of its own.
  for (uint16_t rule = kRuleJointCount; rule <= kRuleLoad + 1; ++rule)
    for (uint16_t other = kRuleJointCount; other < rule; ++other)
      CHECK(rule_name(rule) != rule_name(other));
}

TEST(Linkages_HaveOneHashEverywhere) {
  test::Lcg random(9);
  core::Hash hash;
  const auto add = [&](Vec3 a) {
    hash.add(test::bits_of(a.x)), hash.add(test::bits_of(a.y)), hash.add(test::bits_of(a.z));
  };
  for (uint32_t i = 0; i < 2000; ++i) {
    const float angle_rad[3] = {random.between(-3, 3), random.between(-3, 3),
                                random.between(-3, 3)};
    each_pose(angle_rad, [&](const Pose& pose) {
      add(pose.position_m);
      for (const Vec3 column : pose.column_m) add(column);
      const JointTorques found = torques(pose, kLimits, {1, 2, -3});
      add({found.torque_Nm[0], found.torque_Nm[1], found.torque_Nm[2]});
    });
  }
  CHECK_EQ(hash.value(), 150662805703886543ull);
}
