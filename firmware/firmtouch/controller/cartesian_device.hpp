#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/device/cartesian.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/servo/guard.hpp"

namespace firmtouch {

/// Torques on joints: of springs that balance the weight, and those that carry friction.
struct Compensating {
  math::Vec3 spring_Nm;
  float friction_Nm[record::kAxes] = {};
};

/// What a tick demands of the motors.
struct Push {
  math::Vec3 force_N;     // at the tool
  bool is_on = false;     // the motors are on, and do not ramp out
  bool may_push = false;  // false: the force falls to 0
  bool cut = false;       // no force at all
  // Of each joint of a linkage the largest torque, or null: that of the asset.
  const float* largest_Nm = nullptr;
  // Of a linkage, or null.
  const Compensating* compensating = nullptr;
};

/// What became of the force of the last tick, for the observer of energy.
struct Rendered {
  float share = 1;      // of the force that the motors rendered
  math::Vec3 off_m;     // the motion along which its torques worked, less the tool's
  float hidden_J2 = 0;  // (change of torque x a count)^2, of all joints
};

/// Base of the policies of devices, which turn counts to a position and a force to motors.
struct DevicePolicy {
  /// False: the device has a `Rendered rendered() const`, valid after read().
  static constexpr bool kRendersAll = true;
  /// True: the device has a `bool is_homed() const` and a `bool has_failed() const`, valid after
  /// read(). Until it is homed no force is rendered, and may_push lets it home itself.
  static constexpr bool kHomes = false;
  /// True: the device has a `uint32_t wall_state(const params::Values&, scene::Stiffening) const`:
  /// 0, or one of record::kStateWallRefused and kStateWallForced.
  static constexpr bool kKnowsWalls = false;
  /// True: a tick's flags need the counts of second encoders; index pulses.
  static constexpr bool kHasSecondEncoders = false, kHasIndexPulses = false;
  /// True: the device has a `bool encoders_agree(const device::Sample&, uint32_t flags)`, which a
  /// tick calls before read() with a sample that the encoders report as valid.
  static constexpr bool kComparesEncoders = false;
};

/// How the parameters estimate velocity.
device::VelocitySettings velocity_settings(const params::Values& values);

/// The device policy of three straight axes at right angles, by the parameters alone: each motor's
/// force is the tool's.
class CartesianDevice : public DevicePolicy, public asset::LoadsNothing {
 public:
  using Parameters = params::Groups<params::DeviceRows>;
  static constexpr uint32_t kParts = 0;

  static const char* find(const asset::Container&, const char*) { return nullptr; }
  void reset() { state_ = {}; }
  /// After a swap of the asset: whether `other` is the same device, and its state.
  bool is_same(const CartesianDevice&) const { return true; }
  void continue_as(const CartesianDevice& other) { state_ = other.state_; }
  /// `clear`: earlier bad samples are forgotten.
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear);
  /// Sets motors and force of the record.
  /// Result: false if the guard stopped them.
  bool push(const params::Values& values, const Push& push, servo::GuardState& guard,
            record::TickOutput& output);

 private:
  device::State state_;
};

}  // namespace firmtouch
