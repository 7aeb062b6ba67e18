// Motors of an arm that is held in a wall get hot: their heat is integrated in double from the
// torques of the record. The limits fall with it, smoothly, and a log replays. Where a device fails
// to derate, the guard stops it.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "controller/joints_rig.hpp"
#include "firmtouch/controller/derated_device.hpp"
#include "firmtouch/device/rules.hpp"
#include "harness/random.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr double kCounts = 1e6;  // of a radian
constexpr double kLargest_Nm = 0.5, kContinuous_Nm = 0.2, kTime_s = 1, kTick_s = 1e-3;
constexpr double kTipAside_m = 0.35;

struct Section {
  device::LinkageLayout linkage;
  device::DeratingLayout derating;
};
struct HomedSection {
  device::HomedLinkageLayout homed;
  device::SecondEncodersLayout second;
  device::DeratingLayout derating;
};

Section arm(bool carries = false) {
  Section to = {};
  constexpr double kLow_rad[3] = {-3, -3, -3}, kHigh_rad[3] = {3, 3, 3};
  to.linkage = arm_layout(static_cast<float>(kCounts), kLow_rad, kHigh_rad);
  if (carries) {
    to.linkage.tip_mass_kg = 0.3f;
    to.linkage.gravity_mps2[2] = -9.81f;
    to.linkage.carried_share = 0.9f;
  }
  for (uint32_t k = 0; k < 3; ++k) {
    to.linkage.max_torque_Nm[k] = static_cast<float>(kLargest_Nm);
    to.derating.continuous_Nm[k] = static_cast<float>(kContinuous_Nm);
    to.derating.time_s[k] = static_cast<float>(kTime_s);
  }
  return to;
}

template <class Layout>
const Asset& asset_of(const Layout& layout) {
  static const Asset made(file_with(layout));
  return made;
}
const Asset& pushing() { return asset_of(arm()); }
const Asset& carrying() {
  static const Asset made(file_with(arm(true)));
  return made;
}

void angles_of(double x, double y, double z, double (&q)[3]) {
  const double out = std::hypot(x, y), far2 = out * out + z * z;
  q[0] = std::atan2(y, x);
  q[2] = -std::acos((far2 - .3 * .3 - .25 * .25) / (2 * .3 * .25));
  q[1] = std::atan2(z, out) - std::atan2(.25 * std::sin(q[2]), .3 + .25 * std::cos(q[2]));
}

// Where the ride of a Cartesian device is deepest in the part.
const double (&deepest())[3] {
  static double at_m[3];
  static bool is_found = false;
  if (is_found) return at_m;
  is_found = true;
  static const Asset part(file_of(part_sections()));
  Ride ride(part);
  double most_N = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.fill(tick);
    ride.step();
    const double force_N = std::hypot(static_cast<double>(ride.output.force_N[0]),
                                      static_cast<double>(ride.output.force_N[1]),
                                      static_cast<double>(ride.output.force_N[2]));
    if (tick < 500 || force_N <= most_N) continue;
    most_N = force_N;
    for (int k = 0; k < 3; ++k) at_m[k] = static_cast<double>(ride.output.position_m[k]);
  }
  return at_m;
}

template <class Device = DeratedDevice<AnyDevice>, class OfController = MeshController<Device>>
struct Rig : JointsRig<OfController> {
  using Base = JointsRig<OfController>;
  using Base::input, Base::output;

  double heat[3] = {1, 1, 1}, most_heat = 1, most_step_Nm = 0, over_law_Nm = 0;
  double above_m = .05;

  explicit Rig(const Asset& asset) : Base(asset) {}
  void tick(bool is_deep, bool is_enabled, bool is_counted = true) {
    const double(&at_m)[3] = deepest();
    above_m = is_deep ? std::max(above_m - .0005, 0.) : std::min(above_m + .0005, .05);
    double angle_rad[3];
    angles_of(at_m[0] + kTipAside_m, at_m[1], at_m[2] + above_m, angle_rad);
    for (int k = 0; k < 3; ++k)
      input.encoder_counts[k] = static_cast<int32_t>(std::lround(angle_rad[k] * kCounts));
    const bool places = input.tick == 2;
    input.command_value = static_cast<float>(kTipAside_m);
    double before_Nm[3];
    for (int k = 0; k < 3; ++k) before_Nm[k] = static_cast<double>(output.motor_N[k]);
    Base::step(is_enabled && input.tick > 3 ? record::kFlagEnable : 0,
               places ? 1 + row_of_scene_x() : record::kCommandNone);
    for (int k = 0; k < 3; ++k) {
      const double load = before_Nm[k] / kContinuous_Nm, now_Nm = motor_Nm(k);
      heat[k] = load * load + (heat[k] - load * load) * std::exp(-kTick_s / kTime_s);
      most_heat = std::max(most_heat, heat[k]);
      const double share = std::clamp(4 * (1 - heat[k]), 0., 1.);
      const double law_Nm = kContinuous_Nm + (kLargest_Nm - kContinuous_Nm) * share;
      over_law_Nm = std::max(over_law_Nm, now_Nm - law_Nm);
      if (is_counted)
        most_step_Nm = std::max(most_step_Nm,
                                std::fabs(static_cast<double>(output.motor_N[k]) - before_Nm[k]));
    }
  }
  static uint32_t row_of_scene_x() {
    uint32_t row = 0;
    while (MeshController<Device>::kTable[row].number != params::kSceneX) ++row;
    return row;
  }
  double motor_Nm(int k) const { return std::fabs(static_cast<double>(output.motor_N[k])); }
  double largest_Nm() const { return std::max({motor_Nm(0), motor_Nm(1), motor_Nm(2)}); }
  void check_heat() {
    CHECK_LE(most_heat, 1 + 1e-3);  // the device integrates each tick by its first order
    CHECK_LE(over_law_Nm, 2e-3);
    CHECK_EQ(output.faults, 0u);
  }
};

}  // namespace

TEST(DeratedDevice_HeldInAWall_FallsToTheContinuousTorque) {
  Rig<> rig(pushing());
  Rig<AnyDevice> whole(asset_of(arm().linkage));
  for (int i = 0; i < 1000; ++i) {
    rig.tick(false, true);  // cools
    whole.tick(false, true);
  }
  CHECK_LE(rig.heat[0], .38);
  double most_Nm = 0;
  for (int i = 0; i < 6000; ++i) {
    const bool is_pressed = i > 150;  // contact has risen
    rig.tick(true, true, is_pressed);
    whole.tick(true, true);
    most_Nm = std::max(most_Nm, rig.largest_Nm());
    for (int k = 0; k < 3; ++k) CHECK_LE(rig.motor_Nm(k), whole.motor_Nm(k) + 1e-6);
  }
  CHECK_GE(whole.largest_Nm(), kLargest_Nm * .999);
  CHECK_GE(most_Nm, kLargest_Nm * .999);
  CHECK_LE(std::fabs(rig.largest_Nm() - kContinuous_Nm), .01 * kContinuous_Nm);
  CHECK_LE(rig.most_step_Nm, (kLargest_Nm - kContinuous_Nm) * kTick_s / .025);
  rig.check_heat();
  const double share = rig.largest_Nm() / whole.largest_Nm();  // the force keeps its direction
  for (int k = 0; k < 3; ++k)
    CHECK_LE(std::fabs(static_cast<double>(rig.output.force_N[k]) -
                       share * static_cast<double>(whole.output.force_N[k])),
             1e-3);
  check_replays(rig, pushing());
}

TEST(DeratedDevice_RightAfterAReset_HasTheContinuousTorque) {
  Rig<> rig(pushing());
  for (int i = 0; i < 300; ++i) rig.tick(true, true);
  CHECK_LE(rig.largest_Nm(), 1.6 * kContinuous_Nm);
  for (int i = 0; i < 2000; ++i) rig.tick(false, false);
  CHECK_LE(static_cast<double>(rig.controller.device().heat().heat[0]), .2);
  DeratedDevice<AnyDevice> next;
  next.continue_as(rig.controller.device());
  CHECK_EQ(next.heat().heat[0], rig.controller.device().heat().heat[0]);
  rig.controller.reset();
  for (const float heat : rig.controller.device().heat().heat) CHECK_EQ(heat, 1.0f);
}

// Else the energy of the tick behind a swap is counted as if the motors had given all of the force.
TEST(AnyDevice_ThatContinues_KnowsWhatTheMotorsRendered) {
  Rig<> rig(pushing());
  for (int i = 0; i < 300; ++i) rig.tick(true, true);
  const Rendered& rendered = rig.controller.device().rendered();
  CHECK(rendered.share > 0.0f && rendered.share < 1.0f);
  DeratedDevice<AnyDevice> next;
  next.continue_as(rig.controller.device());
  CHECK_EQ(next.rendered().share, rendered.share);
  CHECK_EQ(next.rendered().hidden_J2, rendered.hidden_J2);
}

// It goes on cold, and so does the guard.
TEST(DeratedDevice_BehindASwapOfTheAsset_HasItsHeat) {
  using Device = DeratedDevice<AnyDevice>;
  Rig<Device, Controller<Surfaces<MeshSurface>, NoGuide, Device, asset::Proven, TwoScenes>> rig(
      pushing());
  for (int i = 0; i < 3000; ++i) rig.tick(false, true);
  const float heat = rig.controller.device().heat().heat[0];
  rig.controller.begin_next(pushing().bytes());
  while (!rig.controller.work_next(kSliceUnits)) {
  }
  CHECK(rig.controller.swap());
  CHECK_EQ(rig.controller.device().heat().heat[0], heat);
  double most_Nm = 0;
  for (int i = 0; i < 2000; ++i) {
    rig.tick(true, true);
    most_Nm = std::max(most_Nm, rig.largest_Nm());
  }
  CHECK_GE(most_Nm, 2 * kContinuous_Nm);
  rig.check_heat();
}

// Enable, disable, push and let go in any order.
TEST(DeratedDevice_NoHandHeatsItBeyond) {
  for (const bool carries : {false, true}) {
    const Asset& asset = carries ? carrying() : pushing();
    Rig<> rig(asset);
    uint32_t random = 1;
    bool is_deep = true, is_enabled = true;
    for (int i = 0; i < 20000; ++i) {
      if (i % 97 == 0) random = random * 1664525u + 1013904223u;
      if (i % 97 == 0) is_deep = (random >> 28) > 4, is_enabled = (random >> 24 & 15u) > 1;
      rig.tick(is_deep, is_enabled);
    }
    rig.check_heat();
    check_replays(rig, asset);
  }
}

// Its weight takes at most its share of the limits that are left.
TEST(DeratedDevice_WeightAlone_FallsWithTheLimit) {
  Rig<> rig(carrying());
  for (int i = 0; i < 4000; ++i) rig.tick(false, true);
  rig.check_heat();
  const double part = kLargest_Nm / kContinuous_Nm - 1;  // torque / c = 0.9 (1 + part 4 (1 - x))
  const double a = 3.6 * part, c = .9 + a;
  const double held = (std::sqrt(1 + 4 * a * c) - 1) / (2 * a);  // where x = (torque / c)^2
  CHECK_LE(std::fabs(rig.motor_Nm(1) - held * kContinuous_Nm), 1e-3);
}

namespace {

// Its memory is the test's to break.
struct BrokenDevice : DeratedDevice<AnyDevice> {
  using DeratedDevice::before_Nm_, DeratedDevice::part_state_;
};
bool is_zero(float value) { return !(value < 0 || value > 0); }
struct BrokenRig : Rig<BrokenDevice> {
  explicit BrokenRig(const Asset& asset) : Rig(asset) {}
  BrokenDevice& device() { return const_cast<BrokenDevice&>(controller.device()); }
  // Result: whether the guard stopped it.
  template <class Break>
  bool push(int ticks, const Break& breaks) {
    for (int i = 0; i < ticks; ++i) {
      breaks(device());
      tick(true, true);
      if ((output.faults & servo::kFaultGuard) == 0) continue;
      for (int k = 0; k < 3; ++k) CHECK(is_zero(output.motor_N[k]) && is_zero(output.force_N[k]));
      return true;
    }
    return false;
  }
};

}  // namespace

// It takes each motor for cold: the guard ends it before a winding is 10 % too hot.
TEST(DeratedDevice_ThatStaysCold_IsStoppedByTheGuard) {
  for (const bool carries : {false, true}) {
    const Asset& asset = carries ? carrying() : pushing();
    for (const int rest : {1, 300, 3000}) {
      BrokenRig rig(asset);
      for (int i = 0; i < rest; ++i) rig.tick(false, false);
      CHECK(rig.push(5000, [](BrokenDevice& it) { it.part_state_ = {{0, 0, 0}, {}}; }));
      CHECK_GE(rig.most_heat, 1.05);
      CHECK_LE(rig.most_heat, 1.07);
      for (int i = 0; i < 200; ++i) rig.tick(true, i % 20 > 9);  // nobody clears the fault
      CHECK_LE(rig.most_heat, 1.07);
    }
  }
}

// The shortest thermal times that R720 admits, ticks that come late, and every limit used whole.
TEST(DeratedDevice_ThatDerates_IsNeverStoppedByTheGuard) {
  test::Lcg random(3);
  for (const float tick_s : {5e-5f, 1e-3f, 6e-3f, .02f}) {
    for (const float ratio : {1.02f, 1.1f, 1.5f, 4.f, 20.f}) {
      Section section = arm();
      for (int k = 0; k < 3; ++k) {
        section.derating.continuous_Nm[k] = section.linkage.max_torque_Nm[k] / ratio;
        section.derating.time_s[k] = .1001f * ratio * ratio;
      }
      const core::Bytes bytes(reinterpret_cast<const uint8_t*>(&section), sizeof section);
      device::StoredLinkage linkage;
      device::Derating derating;
      CHECK_EQ(open({bytes.data(), sizeof section.linkage}, linkage).rule, 0u);
      CHECK_EQ(derating.open(bytes, linkage).rule, 0u);
      device::HeatState state;
      servo::GuardState guard;
      servo::HeatGuard heat;
      CHECK(servo::guard_set_limits(guard, {8, 5000, tick_s}));
      servo::set_heat(heat, section.derating.continuous_Nm, section.derating.time_s);
      float torque_Nm[3] = {}, most_Nm[3], late_s = 0;
      uint32_t stopped = 0;
      for (int tick = 0; tick < 100000; ++tick) {
        const float later_s = tick_s * random.between(0, .2f);
        device::heat(state, derating, linkage, torque_Nm, tick_s + later_s - late_s, most_Nm);
        late_s = later_s;
        for (int k = 0; k < 3; ++k)
          torque_Nm[k] = tick % 7000 < 2000 * k ? 0 : tick % 2 == 0 ? most_Nm[k] : -most_Nm[k];
        stopped += !servo::guard_heat(guard, heat, torque_Nm);
      }
      CHECK_EQ(stopped, 0u);
    }
  }
}

TEST(DeratedDevice_BitsThatStandInItsMemory_DoNotHeatItBeyond) {
  uint32_t stopped = 0;
  constexpr uint32_t kState = sizeof(device::HeatState), kAll = kState + 12;
  for (uint32_t bit = 0; bit < 8 * kAll; ++bit) {
    for (const bool is_set : {false, true}) {
      BrokenRig rig(pushing());
      stopped += rig.push(800, [&](BrokenDevice& it) {
        uint8_t* const bytes = bit / 8 < kState
                                   ? reinterpret_cast<uint8_t*>(&it.part_state_) + bit / 8
                                   : reinterpret_cast<uint8_t*>(it.before_Nm_) + bit / 8 - kState;
        const uint8_t mask = static_cast<uint8_t>(1u << (bit % 8));
        *bytes = static_cast<uint8_t>(is_set ? *bytes | mask : *bytes & ~mask);
      });
      CHECK_LE(rig.most_heat, 1.07);
    }
  }
  CHECK_GE(stopped, 3u);
}

TEST(DeratedDevice_WithoutThermalLimits_HasTheBitsOfItsBase) {
  const device::LinkageLayout alone = arm().linkage;
  Rig<> rig(asset_of(alone));
  Rig<AnyDevice> same(asset_of(alone));
  for (int i = 0; i < 2000; ++i) {
    rig.tick(i % 500 < 300, true);
    same.tick(i % 500 < 300, true);
  }
  CHECK(std::memcmp(same.log.data(), rig.log.data(), sizeof rig.log[0] * rig.log.size()) == 0);
}

TEST(DeratedDevice_ItsSectionNeedsIt_AndItsRulesHold) {
  MeshController<RedundantDevice<IndexedDevice>> any;
  CHECK_EQ(any.open(pushing().bytes()).rule, uint16_t{device::kRuleLinkageSize});
  HomedSection homed = {};
  homed.homed.linkage = arm().linkage;
  homed.homed.homing.margin_rad = 0.1f;
  homed.derating = arm().derating;
  for (float& counts_per_rad : homed.second.counts_per_rad) counts_per_rad = 1300;
  homed.second.within_rad = 0.005f;
  MeshController<DeratedDevice<RedundantDevice<IndexedDevice>>> controller;
  {
    const Asset asset(file_with(homed));
    CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
    CHECK(controller.device().homing().is_open() && controller.device().derating().is_open() &&
          controller.device().second_encoders().is_open());
  }
  homed.derating.time_s[1] = 0.1f;
  const Asset asset(file_with(homed));
  CHECK_EQ(controller.open(asset.bytes()).rule, uint16_t{device::kRuleDerating});
  CHECK(!controller.device().linkage().is_open() && !controller.is_ready());
}
