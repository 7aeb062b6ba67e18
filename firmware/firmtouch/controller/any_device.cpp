#include "firmtouch/controller/any_device.hpp"

#include "firmtouch/device/stable_wall.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/step.hpp"

namespace firmtouch {
namespace {

using device::kMaxJoints;
using math::Vec3;
using params::Values;

float size(float a) { return __builtin_fabsf(a); }

constexpr float kMinLeft_Nm = 0x1p-40f;  // no division by 0

float at_most(float value, float most) { return value < most ? value : most; }

}  // namespace

void AnyDevice::take_ceilings() {
  const device::LinkageLayout& layout = linkage_.layout();
  servo::set_ceilings(ceilings_, layout.max_torque_Nm, layout.torque_rise_s);
}

void AnyDevice::reset() {
  cartesian_.reset();
  joints_ = {};
  pose_ = {};
  for (float& torque_Nm : before_Nm_) torque_Nm = 0;
  carried_ = 0;
  rendered_ = {};
  fast_ticks_ = 0;
}

bool AnyDevice::is_same(const AnyDevice& other) const {
  if (linkage_.is_open() != other.linkage_.is_open()) return false;
  if (!linkage_.is_open()) return true;
  if (section_.size() != other.section_.size()) return false;
  for (uint32_t i = 0; i < section_.size(); ++i)
    if (section_[i] != other.section_[i]) return false;
  return true;
}

void AnyDevice::continue_as(const AnyDevice& other) {
  cartesian_ = other.cartesian_;
  joints_ = other.joints_;
  pose_ = other.pose_;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    angle_rad_[k] = other.angle_rad_[k];
    before_Nm_[k] = other.before_Nm_[k];
    weight_Nm_[k] = other.weight_Nm_[k];
  }
  carried_ = other.carried_;
  rendered_ = other.rendered_;
  fast_ticks_ = other.fast_ticks_;
}

device::Reading AnyDevice::read(const Values& values, const device::Sample& sample, bool clear) {
  if (!linkage_.is_open()) return cartesian_.read(values, sample, clear);
  if (clear) {
    device::clear(joints_);
    fast_ticks_ = 0;
  }
  const device::Joints joints =
      read_joints(joints_, linkage_.joints(velocity_settings(values)), sample);
  float turn_rad[kMaxJoints];
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    turn_rad[k] = joints.angle_rad[k] - angle_rad_[k];
    angle_rad_[k] = joints.angle_rad[k];
  }
  const Vec3 worked_m = tip_velocity(pose_, turn_rad), before_m = pose_.position_m;
  pose_ = pose_of(linkage_, angle_rad_);
  rendered_.off_m = worked_m - (pose_.position_m - before_m);
  device::Reading reading;
  reading.position_m = pose_.position_m;
  reading.velocity_mps = tip_velocity(pose_, joints.rate_rad_per_s);
  reading.accepted = joints.accepted;
  reading.started = joints.started;
  reading.faults = joints.faults;
  if (!pose_.is_reachable) reading.faults |= device::kWorkspaceFault;
  if (!joints.started) reading.faults = device::kEncoderFault;  // the angles are not measured yet
  const float speed_mps = math::length(reading.velocity_mps);
  fast_ticks_ = speed_mps <= values[params::kMaxSpeed] ? 0 : fast_ticks_ + 1;
  if (fast_ticks_ >= device::kBadInARow) {
    fast_ticks_ = device::kBadInARow;
    reading.faults |= device::kEncoderFault;
  }
  return reading;
}

bool AnyDevice::is_stable(const Values& values, scene::Stiffening by) const {
  const auto holds = [&](float stiffness_N_per_m, float damping_N_s_per_m) {
    return stiffness_N_per_m <= device::stiffest_stable_N_per_m(linkage_.layout().least_mass_kg,
                                                                damping_N_s_per_m,
                                                                values[params::kTickPeriod]);
  };
  const float contact_N_per_m = values[params::kContactStiffness] * by.share;
  const float guide_N_per_m = values[params::kGuideStiffness];
  const float contact_N_s_per_m = values[params::kContactDamping];
  const float guide_N_s_per_m = values[params::kGuideDamping];
  return holds(contact_N_per_m, contact_N_s_per_m) && holds(guide_N_per_m, guide_N_s_per_m) &&
         holds(contact_N_per_m + guide_N_per_m, contact_N_s_per_m + guide_N_s_per_m) &&
         (!(by.per_m > 0.0f) ||
          holds(values[params::kForceLimit] * by.per_m, values[params::kDeviceDamping]));
}

uint32_t AnyDevice::wall_state(const Values& values, scene::Stiffening by) const {
  if (!linkage_.is_open() || !(linkage_.layout().least_mass_kg > 0.0f) || is_stable(values, by))
    return 0;
  return (linkage_.layout().flags & device::kFlagForcedWalls) != 0 ? record::kStateWallForced
                                                                   : record::kStateWallRefused;
}

// The weight is taken up over ramp_in_s, and let go as fast as a force ramps out. The motors hold
// the torques for a tick, so they get those of its middle: half a tick late they would give energy
// to a moving hand (host_sim.Passivity_CarriedWeight_GivesAMovingHandNoEnergy).
void AnyDevice::carry(const Values& values, const Push& push, const float* largest_Nm,
                      float (&torque_Nm)[kMaxJoints]) {
  const float tick_s = values[params::kTickPeriod];
  const float share = linkage_.layout().carried_share;
  const float ahead = carried_ > 0.0f ? 0.5f : 0.0f;  // of the change since the last tick
  if (push.is_on) {
    const float ramp_s = values[params::kRampIn];
    carried_ = ramp_s > tick_s ? at_most(carried_ + tick_s / ramp_s, 1.0f) : 1.0f;
  } else {
    carried_ = carried_ > tick_s / servo::kRampOut_s ? carried_ - tick_s / servo::kRampOut_s : 0.0f;
  }
  if (!(share > 0.0f && carried_ > 0.0f)) return;
  Vec3 whole_Nm = carrying_torques_Nm(linkage_, angle_rad_, pose_);
  static constexpr float kNone_Nm[kMaxJoints] = {};
  const float* friction_Nm = kNone_Nm;
  if (push.compensating != nullptr) {
    whole_Nm = whole_Nm - push.compensating->spring_Nm;
    friction_Nm = push.compensating->friction_Nm;
  }
  const float carrying_Nm[kMaxJoints] = {whole_Nm.x, whole_Nm.y, whole_Nm.z};
  for (uint32_t k = 0; k < linkage_.layout().joints; ++k) {
    const float most_Nm = share * largest_Nm[k];
    const float middle_Nm = carrying_Nm[k] + (carrying_Nm[k] - weight_Nm_[k]) * ahead;
    weight_Nm_[k] = carrying_Nm[k];
    const float wanted_Nm = (middle_Nm + friction_Nm[k]) * carried_;
    const float held_Nm = at_most(size(wanted_Nm), most_Nm);
    torque_Nm[k] = wanted_Nm < 0.0f ? -held_Nm : held_Nm;
  }
}

// Torques may fall to 0 at once; away from it they rise by a share of the largest. The force has
// what is left beside what is held.
bool AnyDevice::drive(const Values& values, const Push& push, const device::JointTorques& wanted,
                      const float (&held_Nm)[kMaxJoints], servo::GuardState& guard,
                      record::TickOutput& output) {
  const device::LinkageLayout& layout = linkage_.layout();
  const float* const largest_Nm = this->largest_Nm(push);
  const float rise = at_most(values[params::kTickPeriod] / layout.torque_rise_s, 1.0f);
  float low_Nm[kMaxJoints], high_Nm[kMaxJoints], left_Nm[kMaxJoints];
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float rise_Nm = layout.max_torque_Nm[k] * rise, before_Nm = before_Nm_[k];
    high_Nm[k] = math::smaller(math::larger(before_Nm, 0.0f) + rise_Nm, largest_Nm[k]);
    low_Nm[k] = -math::smaller(math::larger(-before_Nm, 0.0f) + rise_Nm, largest_Nm[k]);
    const float left =
        wanted.torque_Nm[k] < 0.0f ? held_Nm[k] - low_Nm[k] : high_Nm[k] - held_Nm[k];
    // A joint that the linkage does not have has a torque of 0, which any bound allows.
    left_Nm[k] = math::larger(left, kMinLeft_Nm);
  }
  device::JointTorques rendered = limited(wanted, left_Nm);
  for (uint32_t k = 0; k < kMaxJoints; ++k)
    rendered.torque_Nm[k] =
        math::smaller(math::larger(rendered.torque_Nm[k] + held_Nm[k], low_Nm[k]), high_Nm[k]);
  if (push.cut) rendered = {};
  const bool passed =
      servo::guard_torques(guard, ceilings_, push.may_push, push.cut, rendered.torque_Nm);
  rendered_.share = passed ? rendered.share : 0.0f;
  float hidden_J2 = 0;
  for (uint32_t k = 0; k < linkage_.layout().joints; ++k) {
    const float change_Nm = rendered.torque_Nm[k] - before_Nm_[k];
    const float hidden_J = change_Nm / linkage_.layout().joint[k].counts_per_rad;
    hidden_J2 += hidden_J * hidden_J;
    output.motor_N[k] = before_Nm_[k] = rendered.torque_Nm[k];
  }
  rendered_.hidden_J2 = hidden_J2;
  return passed;
}

bool AnyDevice::push(const Values& values, const Push& push, servo::GuardState& guard,
                     record::TickOutput& output) {
  if (!linkage_.is_open()) return cartesian_.push(values, push, guard, output);
  float carrying_Nm[kMaxJoints] = {};
  carry(values, push, largest_Nm(push), carrying_Nm);
  const device::JointTorques wanted = torques(pose_, linkage_.limits(), push.force_N);
  const bool passed = drive(values, push, wanted, carrying_Nm, guard, output);
  const Vec3 force_N = push.force_N * rendered_.share;
  output.force_N[0] = force_N.x;
  output.force_N[1] = force_N.y;
  output.force_N[2] = force_N.z;
  return passed;
}

}  // namespace firmtouch
