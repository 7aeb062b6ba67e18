// Balancing springs: each word as it is stored is broken alone, in every section that may have
// them; their torques against the gradient of their energy.
#include "firmtouch/device/compensation.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include "device/opened_part.hpp"
#include "firmtouch/device/derating.hpp"
#include "firmtouch/device/index_pulses.hpp"
#include "firmtouch/device/second_encoders.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

using Stored = device_test::StoredWith<device::CompensationLayout>;

// Of its two joints the second has no spring.
Stored bar() {
  Stored to = {};
  to.before = device_test::stored_bar(2200);
  to.part.tag = device::kCompensationTag;
  to.part.spring_Nm_per_rad[0] = 0.05f;
  to.part.relaxed_rad[0] = 1.5f;
  return to;
}

using Opened = device_test::OpenedPart<device::Compensation, Stored>;

void check_broken(uint32_t joint, float spring, float relaxed_rad, uint32_t element) {
  Stored stored = bar();
  stored.part.spring_Nm_per_rad[joint] = spring;
  stored.part.relaxed_rad[joint] = relaxed_rad;
  device_test::check_broken<device::Compensation>(stored, device::kRuleCompensation, element);
}

}  // namespace

TEST(Compensation_EachWordIsBrokenAlone) {
  const float nan = test::nan_value();
  CHECK(Opened(bar()).verdict.ok());
  check_broken(0, 0, 1, 0);
  check_broken(0, -0.0f, 0, 0);
  check_broken(0, -0.05f, 1, 0);
  check_broken(0, nan, 1, 0);
  check_broken(1, 1000.1f, 1, 1);
  check_broken(2, 0.05f, 1, 2);  // no such joint
  check_broken(0, 0.05f, nan, 3);
  check_broken(0, 0.05f, -100.1f, 3);
  check_broken(1, 0.05f, 100.1f, 4);
  check_broken(0, 0, 0, 10);
}

TEST(CarriedFriction_EachWordIsBrokenAlone) {
  const float nan = test::nan_value();
  const struct {
    uint32_t joint;
    float friction_Nm, share, fade;
    uint32_t element;
  } kBroken[] = {{0, -0.01f, .5f, .1f, 6}, {1, nan, .5f, .1f, 7},     {1, .301f, .5f, .1f, 7},
                 {2, .01f, .5f, .1f, 8},  // no such joint
                 {0, 0, .5f, .1f, 9},      {0, 0, 0, .1f, 9},         {0, .01f, 0, .1f, 9},
                 {0, .01f, .801f, .1f, 9}, {0, .01f, -.5f, .1f, 9},   {0, .01f, nan, .1f, 9},
                 {0, .01f, .5f, 0, 9},     {0, .01f, .5f, .0009f, 9}, {0, .01f, .5f, 101, 9},
                 {0, .01f, .5f, nan, 9}};
  for (const bool has_spring : {true, false}) {
    Stored stored = bar();
    if (!has_spring) stored.part = {device::kCompensationTag, {}, {}, {}, 0, 0};
    for (const auto& broken : kBroken) {
      Stored each = stored;
      each.part.friction_Nm[broken.joint] = broken.friction_Nm;
      each.part.friction_share = broken.share;
      each.part.friction_fade_rad_per_s = broken.fade;
      device_test::check_broken<device::Compensation>(each, device::kRuleCompensation,
                                                      broken.element);
    }
    stored.part.friction_Nm[1] = .3f;
    stored.part.friction_share = .8f;
    stored.part.friction_fade_rad_per_s = .1f;
    CHECK(Opened(stored).verdict.ok());
  }
}

// None of any rate exceeds its share, which is what makes joint and torque passive.
TEST(FrictionTorques_AreTheLaw_AndNeverAboveTheirShare) {
  test::Lcg random(7);
  for (int i = 0; i < 100000; ++i) {
    Stored stored = bar();
    stored.part.friction_Nm[1] = random.between(1e-4f, .3f);
    stored.part.friction_share = random.between(.01f, .8f);
    stored.part.friction_fade_rad_per_s = random.between(.001f, 10);
    const Opened opened(stored);
    CHECK(opened.verdict.ok());
    const float size = std::pow(10.0f, random.between(-8, 8));
    const float rate[3] = {size, i % 2 == 0 ? size : -size, size};
    float torque_Nm[3], still_Nm[3];
    friction_torques_Nm(opened.part, rate, torque_Nm);
    const device::CompensationLayout& l = stored.part;
    const double most_Nm = double{l.friction_share} * double{l.friction_Nm[1]};
    const double law_Nm = most_Nm * double{rate[1]} /
                          (std::fabs(double{rate[1]}) + double{l.friction_fade_rad_per_s});
    CHECK_LE(std::fabs(double{torque_Nm[1]} - law_Nm), 4e-7 * most_Nm);
    CHECK_LE(std::fabs(double{torque_Nm[1]}), most_Nm * (1 + 2e-7));
    CHECK(std::fabs(torque_Nm[0]) + std::fabs(torque_Nm[2]) <= 0);
    const float none[3] = {};
    friction_torques_Nm(opened.part, none, still_Nm);
    CHECK(std::fabs(still_Nm[1]) <= 0);
  }
}

// A section is as long with other parts, and a tag alone makes it one with springs.
TEST(Compensation_OfEverySection_IsFoundByItsTag) {
  constexpr uint32_t kHoming = sizeof(device::HomingLayout), kIndex = sizeof(device::IndexLayout),
                     kSecond = sizeof(device::SecondEncodersLayout),
                     kHeat = sizeof(device::DeratingLayout);
  const uint32_t before[] = {
      0,     kSecond,         kHoming,         kHoming + kSecond,         kHoming + kIndex,
      kHeat, kSecond + kHeat, kHoming + kHeat, kHoming + kSecond + kHeat, kHoming + kIndex + kHeat};
  for (const uint32_t more : before) {
    std::vector<float> words(
        (sizeof(device::LinkageLayout) + more + sizeof(device::CompensationLayout)) / 4, 1.0f);
    const core::Bytes bytes = test::bytes(words.data(), static_cast<uint32_t>(4 * words.size()));
    CHECK_EQ(device::Compensation::before(bytes).size(), bytes.size());
    std::memcpy(&words[words.size() - sizeof(device::CompensationLayout) / 4],
                &device::kCompensationTag, 4);
    CHECK_EQ(device::Compensation::before(bytes).size(),
             bytes.size() - sizeof(device::CompensationLayout));
    CHECK_EQ(device::Compensation::before(device::Compensation::before(bytes)).size(),
             bytes.size() - sizeof(device::CompensationLayout));
  }
  const Stored stored = bar();
  for (uint32_t size = 0; size < sizeof stored; ++size)
    CHECK_EQ(device::Compensation::before(test::bytes(&stored, size)).size(), size);
}

// A program without the part rejects a section with it, whatever it takes its words for.
TEST(Compensation_ProgramsWithoutIt_RejectIt) {
  struct Redundant {
    device::LinkageLayout linkage;
    device::SecondEncodersLayout second;  // of the second joint alone: its first word is 0
    device::CompensationLayout compensation;
  };
  Redundant both = {};
  both.linkage = bar().before;
  both.second.counts_per_rad[1] = 1300;
  both.second.within_rad = 0.005f;
  both.compensation = bar().part;
  const core::Bytes bytes = test::bytes(&both, sizeof both);
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  const core::Bytes homed = device::IndexPulses::before(bytes);
  CHECK_EQ(homed.size(), sizeof(device::HomedLinkageLayout));  // its size alone misleads
  CHECK_EQ(open(homed, linkage, homing).rule, uint16_t{device::kRuleHoming});
}

// Central differences of stiffness (angle - relaxed)^2 / 2.
TEST(SpringTorques_AreTheGradientOfTheirEnergy) {
  test::Lcg random(3);
  for (int i = 0; i < 10000; ++i) {
    Stored stored = bar();
    float angle_rad[3] = {random.between(-7, 7), random.between(-7, 7), 0};
    for (int k = 0; k < 2; ++k) {
      stored.part.spring_Nm_per_rad[k] = random.between(1e-4f, 2);
      stored.part.relaxed_rad[k] = random.between(-7, 7);
    }
    const Opened opened(stored);
    CHECK(opened.verdict.ok());
    const math::Vec3 torque = spring_torques_Nm(opened.part, angle_rad);
    const float torque_Nm[] = {torque.x, torque.y, torque.z};
    for (int k = 0; k < 2; ++k) {
      const double stiffness = double{stored.part.spring_Nm_per_rad[k]};
      const auto energy_J = [&](double at_rad) {
        const double off_rad = at_rad - double{stored.part.relaxed_rad[k]};
        return 0.5 * stiffness * off_rad * off_rad;
      };
      const double at_rad = double{angle_rad[k]};
      const double expected_Nm = (energy_J(at_rad - 1e-3) - energy_J(at_rad + 1e-3)) / 2e-3;
      CHECK_LE(std::fabs(double{torque_Nm[k]} - expected_Nm), 2e-6 * stiffness);
    }
    CHECK_EQ(torque_Nm[2], 0.0f);
  }
}
