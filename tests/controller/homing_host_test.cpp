// The controller homes the linkage of its asset: joints of numbers between stops, as oracle of
// where they are. No force before, the record says what happens, and a log replays it.
#include <cmath>

#include "controller/joints_rig.hpp"
#include "firmtouch/device/rules.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr float kTorque_Nm = 0.2f;
constexpr float kCounts = 20000;  // of a radian
constexpr float kLow_rad[3] = {-0.8f, 0.2f, -2.0f}, kHigh_rad[3] = {0.8f, 1.2f, -0.6f};

device::HomedLinkageLayout layout_by(device::HomeBy by) {
  device::HomedLinkageLayout to = {};
  to.linkage = arm_layout(kCounts, kLow_rad, kHigh_rad);
  to.homing.by = static_cast<uint32_t>(by);
  to.homing.margin_rad = 0.1f;
  for (uint32_t k = 0; k < 3; ++k) {
    if (by == device::HomeBy::kStops) to.homing.torque_Nm[k] = kTorque_Nm;
    if (by == device::HomeBy::kKnownPose) to.homing.pose_rad[k] = kLow_rad[k] + 0.3f;
  }
  if (by == device::HomeBy::kStops) to.homing.speed_rad_per_s = 8;
  return to;
}

const Asset& asset_by(device::HomeBy by) {
  const auto made = [](device::HomeBy how) { return Asset(file_with(layout_by(how))); };
  static const Asset stops(made(device::HomeBy::kStops)), pose(made(device::HomeBy::kKnownPose));
  return by == device::HomeBy::kStops ? stops : pose;
}

// Masses between springs, switched on where they stand; two encoders may be swapped.
struct Rig : JointsRig<FullController> {
  float angle_rad[3] = {0.1f, 0.6f, -1.1f}, rate[3] = {};
  float seen_rad[3] = {};  // where this tick's counts are from
  float blocked_rad = 9;   // a finger on joint 1
  int32_t from[3] = {};
  bool swaps = false;
  float rendered_N = 0, largest_Nm = 0;  // before it was homed
  uint32_t modes = 0;                    // and a bit for each mode

  explicit Rig(device::HomeBy by) : JointsRig(asset_by(by)) {
    for (int k = 0; k < 3; ++k) from[k] = counts(k);
  }
  int32_t counts(int k) const {
    return static_cast<int32_t>(std::floor(static_cast<double>(angle_rad[k] * kCounts)));
  }
  void move() {
    for (int step = 0; step < 20; ++step)
      for (int k = 0; k < 3; ++k) {
        const float high = k == 1 && blocked_rad < kHigh_rad[k] ? blocked_rad : kHigh_rad[k];
        float stop_Nm = 0;
        if (angle_rad[k] < kLow_rad[k]) stop_Nm = 40 * (kLow_rad[k] - angle_rad[k]) - rate[k] * .2f;
        if (angle_rad[k] > high) stop_Nm = 40 * (high - angle_rad[k]) - rate[k] * .2f;
        rate[k] += (output.motor_N[k] + stop_Nm - 0.001f * rate[k]) * (5e-5f / 1e-3f);
        angle_rad[k] += rate[k] * 5e-5f;
      }
  }
  void tick(uint32_t flags, uint32_t command = record::kCommandNone) {
    for (int k = 0; k < 3; ++k) input.encoder_counts[k] = counts(k) - from[k];
    if (swaps) std::swap(input.encoder_counts[0], input.encoder_counts[2]);
    for (int k = 0; k < 3; ++k) seen_rad[k] = angle_rad[k];
    step(flags, command);
    if (is_not_homed()) modes |= 1u << mode();
    if (is_not_homed())
      for (int k = 0; k < 3; ++k) {
        rendered_N += std::fabs(output.force_N[k]);
        largest_Nm = std::max(largest_Nm, std::fabs(output.motor_N[k]));
      }
    move();
  }
  // Result: ticks until it is homed or faulty.
  uint32_t enable(uint32_t most = 2200) {
    tick(0);
    uint32_t ticks = 0;
    do tick(record::kFlagEnable);
    while (++ticks < most && is_not_homed() && output.faults == 0);
    return ticks;
  }
  bool is_not_homed() const { return (output.state & record::kStateNotHomed) != 0; }
  bool is_homing() const { return (output.state & record::kStateHoming) != 0; }
  uint32_t failed() const { return output.state >> record::kStateHomingFaultShift; }
  double off_m() const {
    return JointsRig::off_m({static_cast<double>(seen_rad[0]), static_cast<double>(seen_rad[1]),
                             static_cast<double>(seen_rad[2])});
  }
};

void check_homes_anew(Rig& rig) {
  rig.tick(0, record::kCommandClearFaults);
  rig.enable();
  CHECK(!rig.is_not_homed());
  for (int i = 0; i < 10; ++i) rig.tick(record::kFlagEnable);
  CHECK_LE(rig.off_m(), 2e-4);
}

}  // namespace

TEST(HomedDevice_ByStops_RendersOnlyAfterIt) {
  Rig rig(device::HomeBy::kStops);
  rig.tick(0);
  CHECK(rig.is_not_homed() && !rig.is_homing() && !record::may_push(rig.output) &&
        !record::may_move(rig.output));
  rig.tick(record::kFlagEnable);
  CHECK(rig.is_homing() && record::may_push(rig.output) && record::may_move(rig.output));
  const uint32_t ticks = rig.enable();
  firmtouch::test::note("ticks of homing", ticks);
  CHECK_LE(ticks, 2000u);
  CHECK_EQ(rig.output.faults, 0u);
  CHECK_EQ(rig.output.state >> 20, 0u);
  CHECK_LE(rig.rendered_N, 0.0f);
  CHECK_EQ(rig.modes, 1u);  // off
  CHECK_LE(rig.largest_Nm, kTorque_Nm);
  CHECK_GE(rig.largest_Nm, 0.9f * kTorque_Nm);
  for (int i = 0; i < 400; ++i) rig.tick(record::kFlagEnable);
  CHECK_EQ(rig.mode(), 2u);  // on, after its ramp
  CHECK_LE(rig.off_m(), 2e-4);
  check_replays(rig, asset_by(device::HomeBy::kStops));
}

TEST(HomedDevice_ByAKnownPose_MovesNothing) {
  Rig rig(device::HomeBy::kKnownPose);
  for (int k = 0; k < 3; ++k) {
    rig.angle_rad[k] = kLow_rad[k] + 0.3f;
    rig.from[k] = rig.counts(k);
  }
  CHECK_LE(rig.enable(), 2u);
  CHECK_LE(rig.largest_Nm, 0.0f);
  CHECK_LE(rig.off_m(), 1e-4);
}

TEST(HomedDevice_DisabledOrStopped_HasNoTorque_AndBeginsAnew) {
  for (const uint32_t flags : {uint32_t{0}, record::kFlagEnable | record::kFlagEmergencyStop}) {
    Rig rig(device::HomeBy::kStops);
    rig.enable(300);
    CHECK(rig.is_homing());
    rig.tick(flags);
    CHECK(!rig.is_homing() && !record::may_push(rig.output));
    for (const float torque_Nm : rig.output.motor_N) CHECK_LE(std::fabs(torque_Nm), 0.0f);
    check_homes_anew(rig);
  }
}

TEST(HomedDevice_WrongAxesAndFingers_AreNamed) {
  Rig rig(device::HomeBy::kStops);
  rig.swaps = true;
  rig.enable();
  CHECK_EQ(rig.failed() & 15u, static_cast<uint32_t>(device::HomingFault::kSwapped));
  CHECK_EQ(rig.failed() >> 4, 0u | 2u << 2);  // joint 0 is driven, joint 2 moves
  rig.tick(record::kFlagEnable);
  CHECK_EQ(rig.output.faults, servo::kFaultHoming);
  for (const float torque_Nm : rig.output.motor_N) CHECK_LE(std::fabs(torque_Nm), 0.0f);
  rig.swaps = false;
  rig.enable(50);
  CHECK_EQ(rig.output.faults, servo::kFaultHoming);  // until it is cleared
  rig.tick(0, record::kCommandClearFaults);
  rig.blocked_rad = 0.7f;
  rig.enable();
  CHECK_EQ(rig.failed() & 63u, static_cast<uint32_t>(device::HomingFault::kBlocked) | 1u << 4);
  rig.blocked_rad = 9;
  rig.tick(0);
  rig.tick(0, record::kCommandClearFaults);
  rig.enable();
  CHECK(!rig.is_not_homed());
  check_replays(rig, asset_by(device::HomeBy::kStops));
}

TEST(HomedDevice_LostEncoder_IsHomedAnew) {
  Rig rig(device::HomeBy::kStops);
  rig.enable();
  for (int i = 0; i < 400; ++i) rig.tick(record::kFlagEnable);
  for (int i = 0; i < 3; ++i) rig.tick(record::kFlagEnable | record::kFlagEncoderFault);
  CHECK_EQ(rig.output.faults, servo::kFaultEncoder);
  rig.from[1] += 700;  // counts that nobody saw
  for (int i = 0; i < 40; ++i) rig.tick(record::kFlagEnable);
  CHECK(rig.is_not_homed() && !record::may_push(rig.output));
  check_homes_anew(rig);
}

// A model that was made before a loss names an object; the bits of the record are then homing's.
TEST(HomedDevice_LostAtTwoRates_OldModelIsNoFaultOfHoming) {
  struct ThirdObject : MeshSurface {
    void touch(const ModelRequest& request, const params::Values& values, ModelResult& result) {
      MeshSurface::touch(request, values, result);
      result.state |= 3u << record::kStateObjectShift;
    }
  };
  static Controller<Surfaces<ThirdObject>, NoGuide, HomedDevice> controller;
  CHECK_EQ(controller.open(asset_by(device::HomeBy::kKnownPose).bytes()).rule, 0u);
  record::TickInput input{};
  record::TickOutput output{};
  const auto tick = [&](uint32_t flags) {
    input.clock_us = input.tick * 1000;
    input.flags = flags;
    controller.tick(input, output);
    ++input.tick;
  };
  for (int i = 0; i < 20; ++i) {
    tick(controller.model_flags() | (i > 0 ? record::kFlagEnable : 0));
    controller.make_model();
  }
  CHECK_EQ(output.state >> record::kStateObjectShift, 3u);
  // The main loop makes no model from here on.
  for (int i = 0; i < 3; ++i)
    tick(record::kFlagModelApart | record::kFlagEnable | record::kFlagEncoderFault);
  for (int i = 0; i < 40; ++i) tick(record::kFlagModelApart | record::kFlagEnable);
  CHECK((output.state & record::kStateNotHomed) != 0);
  CHECK_EQ(output.state >> record::kStateHomingFaultShift, 0u);
}

TEST(ProgramWithoutHoming_RejectsTheLinkage) {
  static Controller<Surfaces<MeshSurface>, NoGuide, AnyDevice> controller;
  CHECK_EQ(controller.open(asset_by(device::HomeBy::kStops).bytes()).rule,
           uint16_t{device::kRuleLinkageSize});
}
