#include "host_sim/device/driven_linkage.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {

DrivenLinkage::DrivenLinkage(const LinkageDevice& device, const JointMotion& start)
    : body_(device, start), book_(body_.energy()) {
  for (uint32_t k = 0; k < kJoints; ++k) {
    drive_[k] = device.masses.joint[k];
    is_sprung_ |= has_cable(k);
    rotor_[k] = {start.angle_rad[k], start.rate_rad_per_s[k]};
  }
}

DrivenLinkage::Rotor DrivenLinkage::rotor(uint32_t joint) const {
  if (has_cable(joint)) return rotor_[joint];
  const JointMotion& at = body_.motion();
  return {at.angle_rad[joint], at.rate_rad_per_s[joint]};
}

double DrivenLinkage::twist_rad(uint32_t joint) const {
  return rotor(joint).angle_rad - body_.motion().angle_rad[joint];
}

void DrivenLinkage::set_twist(uint32_t joint, double twist_rad) {
  rotor_[joint].angle_rad = body_.motion().angle_rad[joint] + twist_rad;
}

// What of a twist the gap leaves.
double DrivenLinkage::stretch_rad(uint32_t joint, double twist_rad) const {
  const double half_rad = 0.5 * drive_[joint].backlash_rad;
  return twist_rad - std::clamp(twist_rad, -half_rad, half_rad);
}

void DrivenLinkage::advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s) {
  if (!is_sprung_) return body_.advance(motor_Nm, hand_N, time_s);
  double torque_Nm[kJoints], damper_Nm[kJoints] = {}, before_rad[kJoints], turned_rad[kJoints] = {};
  for (uint32_t k = 0; k < kJoints; ++k) {
    torque_Nm[k] = motor_Nm[k];
    before_rad[k] = body_.motion().angle_rad[k];
    if (!has_cable(k)) continue;
    const double rate = rotor_[k].rate_rad_per_s - body_.motion().rate_rad_per_s[k];
    const double stretch = stretch_rad(k, twist_rad(k) + 0.5 * time_s * rate);
    if (std::fabs(stretch) > 0) damper_Nm[k] = drive_[k].cable_N_m_s * rate;
    torque_Nm[k] = drive_[k].cable_N_m_per_rad * stretch + damper_Nm[k];
    const double bend = (motor_Nm[k] - torque_Nm[k]) / drive_[k].rotor_kg_m2;
    turned_rad[k] = time_s * (rotor_[k].rate_rad_per_s + 0.5 * time_s * bend);
    rotor_[k].angle_rad += turned_rad[k];
    rotor_[k].rate_rad_per_s += time_s * bend;
  }
  body_.advance(torque_Nm, hand_N, time_s);
  double stored_J = 0;
  for (uint32_t k = 0; k < kJoints; ++k) {
    if (!has_cable(k)) continue;
    const double joint_rad = body_.motion().angle_rad[k] - before_rad[k];
    work_J_ += motor_Nm[k] * turned_rad[k] - torque_Nm[k] * joint_rad;
    lost_J_ += damper_Nm[k] * (turned_rad[k] - joint_rad);
    const double stretch = stretch_rad(k, twist_rad(k)), rate = rotor_[k].rate_rad_per_s;
    stored_J += 0.5 * (drive_[k].cable_N_m_per_rad * stretch * stretch +
                       drive_[k].rotor_kg_m2 * rate * rate);
  }
  const double turnover_J = book_.turnover_J;
  book_ = body_.energy();
  book_.motors_J += work_J_;
  book_.lost_J += lost_J_;
  book_.stored_J += stored_J;
  book_.turnover_J = std::max(turnover_J, std::fabs(book_.stored_J - book_.start_J) + book_.lost_J);
}

}  // namespace firmtouch::host_sim
