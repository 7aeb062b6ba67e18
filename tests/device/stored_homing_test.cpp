// Homing as an asset stores it: each word broken alone.
#include "firmtouch/device/stored_homing.hpp"

#include "device/stored_bar.hpp"
#include "firmtouch/device/rules.hpp"
#include "harness/float_bits.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::HomedLinkageLayout;

namespace {

HomedLinkageLayout bar(device::HomeBy by) {
  const bool is_by_stops = by == device::HomeBy::kStops;
  HomedLinkageLayout to = {};
  to.linkage = device_test::stored_bar(2200);
  for (uint32_t k = 0; k < 2; ++k) {
    to.homing.torque_Nm[k] = is_by_stops ? .1f : 0;
    to.homing.pose_rad[k] = is_by_stops ? 0 : 1.f;
  }
  to.homing.by = static_cast<uint32_t>(by);
  to.homing.margin_rad = .1f;
  to.homing.speed_rad_per_s = is_by_stops ? 6.f : 0;
  return to;
}

template <class Change>
void check_broken(device::HomeBy by, uint32_t element, const Change& change) {
  static HomedLinkageLayout layout;
  const core::Bytes bytes(reinterpret_cast<const uint8_t*>(&layout), sizeof layout);
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  layout = bar(by);
  CHECK_EQ(open(bytes, linkage, homing).rule, 0u);
  CHECK(linkage.is_open() && homing.is_open());
  CHECK(homing.settings().by == by);
  change(layout.homing);
  const core::Verdict verdict = open(bytes, linkage, homing);
  CHECK_EQ(verdict.rule, uint16_t{device::kRuleHoming});
  CHECK_EQ(verdict.element, element);
  CHECK(!linkage.is_open() && !homing.is_open());
}

constexpr auto kStops = device::HomeBy::kStops, kPose = device::HomeBy::kKnownPose;
const float kNan = test::nan_value();

}  // namespace

TEST(StoredHoming_EachWordIsBrokenAlone) {
  using L = device::HomingLayout;
  check_broken(kStops, 0, [](L& h) { h.by = 1; });  // an absolute sensor is the board's
  check_broken(kStops, 0, [](L& h) { h.by = 3; });
  check_broken(kPose, 1, [](L& h) { h.speed_rad_per_s = 1; });
  check_broken(kStops, 2, [](L& h) { h.torque_Nm[0] = .31f; });  // above the joint's limit
  check_broken(kStops, 3, [](L& h) { h.torque_Nm[1] = kNan; });
  check_broken(kStops, 4, [](L& h) { h.torque_Nm[2] = .1f; });  // no such joint
  check_broken(kStops, 2, [](L& h) { h.pose_rad[0] = -0.0f; });
  check_broken(kPose, 2, [](L& h) { h.torque_Nm[0] = .1f; });
  check_broken(kPose, 3, [](L& h) { h.pose_rad[1] = 2.1f; });  // beyond the range
  check_broken(kPose, 3, [](L& h) { h.pose_rad[1] = kNan; });
  check_broken(kStops, 5, [](L& h) { h.torque_Nm[0] = 0; });
  check_broken(kStops, 5, [](L& h) { h.speed_rad_per_s = 101; });
  check_broken(kStops, 5, [](L& h) { h.margin_rad = kNan; });
  check_broken(kPose, 5, [](L& h) { h.margin_rad = 0; });
}

TEST(StoredHoming_LinkageAlone_IsNotHomed_AndItsRulesHold) {
  static HomedLinkageLayout layout;
  layout = bar(kStops);
  const uint8_t* data = reinterpret_cast<const uint8_t*>(&layout);
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  CHECK_EQ(open({data, sizeof layout.linkage}, linkage, homing).rule, 0u);
  CHECK(linkage.is_open() && !homing.is_open());
  CHECK_EQ(open({data, sizeof layout}, linkage).rule, uint16_t{device::kRuleLinkageSize});
  layout.linkage.kind = 7;
  CHECK_EQ(open({data, sizeof layout}, linkage, homing).rule, uint16_t{device::kRuleKind});
  CHECK(!linkage.is_open() && !homing.is_open());
  for (uint32_t size = 0; size < sizeof layout; size += 4)
    if (size != sizeof layout.linkage)
      CHECK_EQ(open({data, size}, linkage, homing).rule, uint16_t{device::kRuleLinkageSize});
}
