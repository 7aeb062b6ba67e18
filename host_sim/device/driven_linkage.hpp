#pragma once
#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {

/// A linkage whose motors move its joints through cables or belts: each a spring with a damper
/// between rotor and joint, with a gap (backlash) in between. A joint without `cable_` in the
/// device file is rigid: its rotor belongs to the linkage. Rotors are integrated beside the
/// linkage, each in a step at the torque of the cable that is predicted for the step's middle: to
/// the second order.
class DrivenLinkage {
 public:
  DrivenLinkage(const LinkageDevice& device, const JointMotion& start);

  void advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s);
  const LinkageBody& body() const { return body_; }
  const EnergyBook& energy() const { return is_sprung_ ? book_ : body_.energy(); }
  /// Of the encoder: on the motor, before the cable.
  int32_t count(uint32_t joint, double off_rad = 0) const {
    return body_.count_at(joint, rotor(joint).angle_rad + off_rad);
  }

  /// Angle of the rotor less that of the joint.
  double twist_rad(uint32_t joint) const;
  double rotor_rad(uint32_t joint) const { return rotor(joint).angle_rad; }
  double rotor_rad_per_s(uint32_t joint) const { return rotor(joint).rate_rad_per_s; }
  void set_twist(uint32_t joint, double twist_rad);

 private:
  struct Rotor {
    double angle_rad = 0, rate_rad_per_s = 0;
  };
  bool has_cable(uint32_t joint) const { return drive_[joint].cable_N_m_per_rad > 0; }
  Rotor rotor(uint32_t joint) const;
  double stretch_rad(uint32_t joint, double twist_rad) const;

  LinkageBody body_;
  bool is_sprung_ = false;  // has a cable
  tools::JointFriction drive_[kJoints];
  Rotor rotor_[kJoints];
  double work_J_ = 0, lost_J_ = 0;  // of the motors beyond the body's book; of the dampers
  EnergyBook book_;
};

}  // namespace firmtouch::host_sim
