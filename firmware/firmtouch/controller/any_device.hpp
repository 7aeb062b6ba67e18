#pragma once
#include "firmtouch/controller/cartesian_device.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/device/stored_linkage.hpp"
#include "firmtouch/scene/texture.hpp"

namespace firmtouch {

/// The device policy of the linkage that the asset stores; without one a Cartesian device. The
/// record's motors are then joint torques in N m, and counts and motors are those of the joints.
/// The parameters counts_per_metre, origin and workspace_half have no effect on a linkage.
class AnyDevice : public DevicePolicy {
 public:
  using State = core::OneOf<uint32_t>;
  using Parameters = CartesianDevice::Parameters;
  static constexpr uint32_t kParts = kPartLinkage;

  static const char* find(const asset::Container& asset, const char* wanted) {
    return asset::find_name(asset, device::kLinkageSection, wanted);
  }
  void close() { linkage_ = {}; }
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State&) {
    section_ = asset.find(device::kLinkageSection, name);
  }
  template <class Trust>
  asset::Progress work(State&, uint32_t) {
    const core::Verdict verdict = device::open(section_, linkage_);
    if (verdict.ok()) take_ceilings();
    return {true, verdict};
  }

  void reset();
  /// After a swap of the asset: whether `other` stores the same linkage, and its state.
  bool is_same(const AnyDevice& other) const;
  void continue_as(const AnyDevice& other);
  /// Faults beside those of read_joints(): a pose that the links do not reach is outside of the
  /// workspace; a tip faster than max_speed_mps for three ticks is an encoder fault.
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear);
  /// Torques of the force and, while the motors are on, of the linkage's own weight. Each joint
  /// stays within its largest torque, and none rises faster than from 0 to there in torque_rise_s.
  /// Where torques are too large those of the force are scaled alike; force_N of the record is what
  /// is left.
  bool push(const params::Values& values, const Push& push, servo::GuardState& guard,
            record::TickOutput& output);

  /// Torques that are held do not hold the force: their work is that of the last tick's Jacobian.
  static constexpr bool kRendersAll = false;
  const Rendered& rendered() const { return rendered_; }

  /// Contact, guide, and both as where a guide pulls into a surface, against the stiffest wall that
  /// is stable with the tip's least mass and the wall's damping; the device's own would only help.
  /// guide_stiffness counts with and without a guide. An asset without that mass passes.
  /// Textures (scene/texture.hpp) stiffen contact. Along them, up to force_limit, device_damping
  /// alone has to do.
  static constexpr bool kKnowsWalls = true;
  uint32_t wall_state(const params::Values& values, scene::Stiffening by) const;

  const device::StoredLinkage& linkage() const { return linkage_; }
  /// The whole section. Pre: linkage().is_open().
  core::Bytes stored_bytes() const { return section_; }

 protected:
  /// Of a linkage that was opened: the guard gets its ceilings.
  void take_ceilings();
  /// The motors take the torques as far as rise, ceilings and guard allow: first `held_Nm`, each
  /// joint's own, then those of a force, all scaled alike.
  bool drive(const params::Values& values, const Push& push, const device::JointTorques& wanted,
             const float (&held_Nm)[device::kMaxJoints], servo::GuardState& guard,
             record::TickOutput& output);

  /// Of the last sample.
  const float (&angle_rad() const)[device::kMaxJoints] { return angle_rad_; }
  float rate_rad_per_s(uint32_t joint) const { return joints_.joint[joint].velocity.units_per_s; }

  core::Bytes section_;
  device::StoredLinkage linkage_;
  float before_Nm_[device::kMaxJoints] = {};  // torques of the last tick
  Rendered rendered_;

 private:
  void carry(const params::Values& values, const Push& push, const float* largest_Nm,
             float (&torque_Nm)[device::kMaxJoints]);
  bool is_stable(const params::Values& values, scene::Stiffening by) const;
  const float* largest_Nm(const Push& push) const {
    return push.largest_Nm != nullptr ? push.largest_Nm : linkage_.layout().max_torque_Nm;
  }

  CartesianDevice cartesian_;
  servo::TorqueCeilings ceilings_;  // the guard's own copy
  device::JointState joints_;
  device::Pose pose_ = {};
  float angle_rad_[device::kMaxJoints] = {};
  float weight_Nm_[device::kMaxJoints] = {};  // torques that carried it in the last tick
  float carried_ = 0;                         // share of the weight, from 0 to 1
  uint32_t fast_ticks_ = 0;
};

}  // namespace firmtouch
