// The controller homes joints by their index pulses and follows these pulses after it: joints of
// numbers between stops, as oracle of where they are. A belt that slips, or an index that is
// absent, is a fault; no force is left 10 ms later, and a log replays.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "controller/joints_rig.hpp"
#include "firmtouch/controller/redundant_device.hpp"
#include "firmtouch/device/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr double kCounts = 20000;  // of a radian
constexpr double kLow_rad[3] = {-0.8, 0.2, -2.0}, kHigh_rad[3] = {0.8, 1.2, -0.6};
constexpr double kIndex_rad[3] = {0.11, 0.55, -0.95}, kPeriod_rad = 0.5, kWithin_rad = 0.002;

struct Section {
  device::HomedLinkageLayout homed;
  device::IndexLayout index;
};

Section arm() {
  Section to = {};
  to.homed.linkage = arm_layout(static_cast<float>(kCounts), kLow_rad, kHigh_rad);
  to.homed.homing.by = static_cast<uint32_t>(device::HomeBy::kStops);
  to.homed.homing.margin_rad = 0.1f;
  to.homed.homing.speed_rad_per_s = 6;
  for (uint32_t k = 0; k < 3; ++k) {
    to.homed.homing.torque_Nm[k] = 0.2f;
    to.index.index_rad[k] = static_cast<float>(kIndex_rad[k]);
    to.index.period_rad[k] = static_cast<float>(kPeriod_rad);
  }
  to.index.within_rad = static_cast<float>(kWithin_rad);
  return to;
}

const Asset& arm_asset() {
  static const Asset made(file_with(arm()));
  return made;
}

// Masses between springs until they are homed; then a hand swings them.
template <class Device = IndexedDevice>
struct Rig : JointsRig<MeshController<Device>> {
  using Base = JointsRig<MeshController<Device>>;
  using Base::controller, Base::input, Base::output;

  double angle_rad[3] = {0.1, 0.6, -1.1}, rate[3] = {}, phase[3] = {};
  double soft_Nm_per_rad[3] = {40, 25, 60};  // the upper stop; the lower ones have 40
  uint32_t pulses = 0, slipping = 0;         // pulses: of this tick, after a slip of this joint
  uint8_t latched[3] = {};
  int32_t slipped = 0;
  bool is_absent = false, was_homed = false;
  double speed = 2;

  Rig() : Base(arm_asset()) {}
  int32_t counts(int k, double at_rad) const {
    const int32_t off = static_cast<uint32_t>(k) == slipping ? slipped : 0;
    return static_cast<int32_t>(std::floor(at_rad * kCounts)) + off - 4000 * k + 70;
  }
  double turns(int k) const { return std::floor((angle_rad[k] - kIndex_rad[k]) / kPeriod_rad); }
  void drive(int k) {
    double stop_Nm = 0;
    if (angle_rad[k] < kLow_rad[k]) stop_Nm = 40 * (kLow_rad[k] - angle_rad[k]) - rate[k] * .2;
    if (angle_rad[k] > kHigh_rad[k])
      stop_Nm = soft_Nm_per_rad[k] * (kHigh_rad[k] - angle_rad[k]) - rate[k] * .2;
    rate[k] += (static_cast<double>(output.motor_N[k]) + stop_Nm - 0.001 * rate[k]) * (5e-5 / 1e-3);
    angle_rad[k] += rate[k] * 5e-5;
  }
  void swing(int k) {
    if (!was_homed) {  // from where homing left it, which is near to the upper end
      const double half = 0.5 * (kHigh_rad[k] - kLow_rad[k]);
      phase[k] = std::asin(std::min((angle_rad[k] - kHigh_rad[k] + half) / (0.9 * half), 1.0));
    }
    phase[k] += speed * (1 + 0.3 * k) * 5e-5;
    const double half = 0.5 * (kHigh_rad[k] - kLow_rad[k]);
    angle_rad[k] = kHigh_rad[k] - half + 0.9 * half * std::sin(phase[k]);
  }
  void move() {
    pulses = 0;
    const bool is_homed = controller.device().is_homed();
    for (int step = 0; step < 20; ++step) {
      for (int k = 0; k < 3; ++k) {
        const double before = turns(k);
        if (is_homed)
          swing(k);
        else
          drive(k);
        if (before > turns(k) || before < turns(k)) {
          if (is_absent && k == 1) continue;
          pulses |= 1u << k;
          const double at_rad = kIndex_rad[k] + kPeriod_rad * std::max(before, turns(k));
          latched[k] = static_cast<uint8_t>(counts(k, at_rad));
        }
      }
      was_homed = is_homed;
    }
  }
  void tick(uint32_t flags, uint32_t command = record::kCommandNone) {
    for (int k = 0; k < 3; ++k) input.encoder_counts[k] = counts(k, angle_rad[k]);
    Base::step(flags | record::flags_of_index(pulses, latched), command);
    move();
  }
  // Result: whether the motors are on, homed.
  bool enable() {
    tick(0);
    for (int i = 0; i < 2500 && output.faults == 0; ++i) {
      tick(record::kFlagEnable);
      if (Base::mode() == 2) return true;
    }
    return false;
  }
};

}  // namespace

// Stops that give way differently put homing by stops off by several counts.
TEST(IndexedDevice_IsHomedWithinACount_AndSoundPulsesAreNoFault) {
  Rig<> rig;
  CHECK(rig.enable());
  double worst_m = 0;
  for (const double speed : {0.5, 2.0, 5.0}) {
    rig.speed = speed;
    for (int i = 0; i < 20000; ++i) {
      const double at[3] = {rig.angle_rad[0], rig.angle_rad[1], rig.angle_rad[2]};
      rig.tick(record::kFlagEnable);
      worst_m = std::max(worst_m, rig.off_m(at));
    }
  }
  CHECK_EQ(rig.output.faults, 0u);
  CHECK_LE(worst_m, 3 * 0.55 / kCounts);
  check_replays(rig, arm_asset());
}

TEST(IndexedDevice_ASlippedBelt_IsAFaultInTheTickOfThePulse) {
  for (uint32_t from = 50; from < 1500; from += 97)
    for (uint32_t joint = 0; joint < 3; ++joint) {
      Rig<> rig;
      CHECK(rig.enable());
      for (uint32_t i = 0; i < from; ++i) rig.tick(record::kFlagEnable);
      CHECK_EQ(rig.output.faults, 0u);
      rig.slipping = joint;
      rig.slipped = from % 2 == 0 ? 700 : -700;  // 2 deg: no jump that is not plausible
      rig.tick(record::kFlagEnable);             // a pulse of before
      int ticks = 0;
      bool was_pulse = false;
      for (; rig.output.faults == 0 && ticks < 20000; ++ticks) {
        CHECK(!was_pulse);
        was_pulse = (rig.pulses >> joint & 1u) != 0;
        rig.tick(record::kFlagEnable);
      }
      CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
      for (int i = 0; i < 10; ++i) rig.tick(record::kFlagEnable);
      CHECK_LE(rig.motors_Nm(), 0.0);
      if (from == 50) check_replays(rig, arm_asset());
    }
}

TEST(IndexedDevice_AfterASlip_HomesAnew) {
  Rig<> rig;
  CHECK(rig.enable());
  rig.slipped = 700;
  for (int i = 0; i < 20000 && rig.output.faults == 0; ++i) rig.tick(record::kFlagEnable);
  CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
  for (int i = 0; i < 20; ++i) rig.tick(0);
  CHECK(!rig.controller.device().is_homed());
  rig.tick(0, record::kCommandClearFaults);
  CHECK_EQ(rig.output.faults, 0u);
  for (int k = 0; k < 3; ++k) rig.rate[k] = 0;
  CHECK(rig.enable());
  for (int i = 0; i < 8000; ++i) rig.tick(record::kFlagEnable);
  CHECK_EQ(rig.output.faults, 0u);
  check_replays(rig, arm_asset());
}

TEST(IndexedDevice_AnAbsentIndex_IsAFaultInHomingAndAfterIt) {
  Rig<> absent;
  absent.is_absent = true;
  CHECK(!absent.enable());
  CHECK_EQ(absent.output.faults, servo::kFaultHoming);
  CHECK_EQ(absent.output.state >> record::kStateHomingFaultShift & 15u,
           static_cast<uint32_t>(device::HomingFault::kNoIndex));
  Rig<> rig;
  CHECK(rig.enable());
  rig.is_absent = true;
  int ticks = 0;
  for (; ticks < 20000 && rig.output.faults == 0; ++ticks) rig.tick(record::kFlagEnable);
  CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
  for (int i = 0; i < 10; ++i) rig.tick(record::kFlagEnable);
  CHECK_LE(rig.motors_Nm(), 0.0);
}

// A pulse in a sample that is not valid is lost, and no fault.
TEST(IndexedDevice_AnInvalidSampleAtAPulse_IsNoFault) {
  Rig<> rig;
  CHECK(rig.enable());
  uint32_t lost = 0;
  int since = 100;
  for (int i = 0; i < 20000; ++i) {
    const bool is_bad = rig.pulses != 0 && ++since > 40;  // at most five of 32
    if (is_bad) since = 0;
    lost += is_bad ? 1 : 0;
    rig.tick(record::kFlagEnable | (is_bad ? record::kFlagEncoderFault : 0));
  }
  CHECK_GE(lost, 3u);
  CHECK_EQ(rig.output.faults, 0u);
}

// One sample far off: rejected as implausible, and no sign of a slip.
TEST(IndexedDevice_AnImplausibleSample_IsNoFault) {
  Rig<> rig;
  CHECK(rig.enable());
  for (int i = 0; i < 4000; ++i) {
    rig.slipped = i % 50 == 0 && rig.pulses == 0 ? 9000 : 0;
    rig.tick(record::kFlagEnable);
  }
  CHECK_EQ(rig.output.faults, 0u);
}

// The same bits as without anything that compares second encoders; other programs reject it.
TEST(IndexedDevice_ItsSectionNeedsIt_AndItsRulesHold) {
  Rig<> plain;
  Rig<RedundantDevice<IndexedDevice>> both;
  CHECK(plain.enable() && both.enable());
  for (int i = 0; i < 3000; ++i) plain.tick(record::kFlagEnable), both.tick(record::kFlagEnable);
  CHECK(std::memcmp(plain.log.data(), both.log.data(), sizeof plain.log[0] * plain.log.size()) ==
        0);
  static MeshController<HomedDevice> homes;
  CHECK_EQ(homes.open(arm_asset().bytes()).rule, uint16_t{device::kRuleLinkageSize});
  Section broken = arm();
  broken.index.within_rad = 1;
  const Asset asset(file_with(broken));
  static MeshController<IndexedDevice> controller;
  CHECK_EQ(controller.open(asset.bytes()).rule, uint16_t{device::kRuleIndex});
  CHECK(!controller.device().linkage().is_open() && !controller.is_ready());
}
