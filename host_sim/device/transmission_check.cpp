#include "host_sim/device/transmission_check.hpp"

#include <algorithm>
#include <cmath>

#include "device/symmetric.hpp"
#include "host_sim/device/driven_linkage.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kTurn_rad = 6.283185307179586, kStep_s = 1e-5, kMaxTime_s = 60;
constexpr double kHeld_kg_m2 = 100;  // the rotor of a joint that stays where it is
constexpr uint32_t kSettling = 40, kPeriods = 20;

// Without gravity, springs and friction, and with the gap or without.
LinkageDevice bare(LinkageDevice device, bool has_gap) {
  device.masses.gravity_mps2 = {};
  for (tools::JointFriction& joint : device.masses.joint) {
    joint.spring_N_m_per_rad = 0;
    joint.viscous_N_m_s = joint.coulomb_N_m = joint.breakaway_N_m = joint.cable_N_m_s = 0;
    if (!has_gap) joint.backlash_rad = 0;
  }
  return device;
}

// Times of upward zero crossings, and the extremes between them.
class Oscillation {
 public:
  explicit Oscillation(double expected_Hz)
      : most_s_(std::min(kMaxTime_s, 2 * (kSettling + kPeriods) / expected_Hz)) {}
  // Result: whether kPeriods periods after the settling ones are over, or twice the time for them,
  // or kMaxTime_s.
  bool add(double value) {
    if (crossings_ > kSettling) most_ = std::max(most_, value), least_ = std::min(least_, value);
    if (before_ < 0 && value >= 0) {
      const double at_s = now_s_ - kStep_s * value / (value - before_);
      if (crossings_ == kSettling) first_s_ = at_s;
      last_s_ = at_s;
      ++crossings_;
    }
    before_ = value;
    now_s_ += kStep_s;
    return crossings_ > kSettling + kPeriods || !(now_s_ < most_s_);
  }
  double frequency_Hz() const {
    return crossings_ > kSettling + kPeriods ? kPeriods / (last_s_ - first_s_) : 0;
  }
  double amplitude() const { return 0.5 * (most_ - least_); }

 private:
  const double most_s_;
  double before_ = 0, now_s_ = 0, first_s_ = 0, last_s_ = 0;
  double most_ = 0, least_ = 0;
  uint32_t crossings_ = 0;
};

Predicted resonance(const LinkageDevice& of) {
  const LinkageDevice device = bare(of, false);
  DrivenLinkage linkage(device, middle_of(device));
  std::vector<uint32_t> sprung;
  std::vector<double> root;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    if (!(device.masses.joint[k].cable_N_m_per_rad > 0)) continue;
    sprung.push_back(k);
    root.push_back(std::sqrt(device.masses.joint[k].cable_N_m_per_rad));
  }
  if (sprung.empty()) return {};
  const size_t n = sprung.size();
  tools::Matrix square(n, std::vector<double>(n));
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j) {
      const double rotor = i == j ? 1 / device.masses.joint[sprung[i]].rotor_kg_m2 : 0;
      square[i][j] =
          root[i] * root[j] * (linkage.body().inverse_inertia(sprung[i], sprung[j]) + rotor);
    }
  const tools::Directions modes = tools::directions_of(square);
  const std::vector<double>& first = modes.way[n - 1];
  for (size_t i = 0; i < n; ++i) linkage.set_twist(sprung[i], 1e-4 * first[i] / root[i]);
  const double expected_Hz = std::sqrt(modes.value[n - 1]) / kTurn_rad;
  Oscillation oscillation(expected_Hz);
  double mode = 0;
  do {
    linkage.advance({}, {}, kStep_s);
    mode = 0;
    for (size_t i = 0; i < n; ++i) mode += first[i] * root[i] * linkage.twist_rad(sprung[i]);
  } while (!oscillation.add(mode));
  return {oscillation.frequency_Hz(), expected_Hz};
}

// Share of a cable's stiffness that a gap leaves to a twist of `excess` times its half: the
// describing function of a dead zone.
double share_of(double excess) {
  const double a = 1 / excess;
  return 1 - 4 / kTurn_rad * (std::asin(a) + a * std::sqrt(1 - a * a));
}

void add_cycle(const LinkageDevice& of, uint32_t joint, TransmissionCheck& to) {
  LinkageDevice device = bare(of, true);
  for (uint32_t k = 0; k < kJoints; ++k)
    if (k != joint) device.masses.joint[k] = {kHeld_kg_m2};
  const tools::JointFriction& drive = device.masses.joint[joint];
  const double stiffness = 0.5 * drive.cable_N_m_per_rad, half_rad = 0.5 * drive.backlash_rad;
  double low = 1, high = 100;  // of the twist over half the gap
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (share_of(middle) < 0.5 ? low : high) = middle;
  }
  const JointMotion start = middle_of(device);
  DrivenLinkage linkage(device, start);
  to.cycle_rad.closed_form = low * half_rad;
  to.cycle_Hz.closed_form =
      std::sqrt(stiffness * linkage.body().inverse_inertia(joint, joint)) / kTurn_rad;
  const double damping = std::sqrt(stiffness * drive.rotor_kg_m2);
  linkage.set_twist(joint, 3 * half_rad);
  Oscillation oscillation(to.cycle_Hz.closed_form);
  double off_rad = 0;
  do {
    double motor_Nm[kJoints] = {};
    motor_Nm[joint] = -stiffness * off_rad - damping * linkage.rotor_rad_per_s(joint);
    linkage.advance(motor_Nm, {}, kStep_s);
    off_rad = linkage.body().motion().angle_rad[joint] - start.angle_rad[joint];
  } while (!oscillation.add(off_rad));
  to.cycle_Hz.measured = oscillation.frequency_Hz();
  to.cycle_rad.measured = oscillation.amplitude();
}

bool is_within(const Predicted& it, double most) {
  return !(it.closed_form > 0) || it.error() <= most;
}

}  // namespace

double Predicted::error() const { return std::fabs(measured / closed_form - 1); }

bool assume_cables(LinkageDevice& device) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const tools::JointFriction& drive = device.masses.joint[k];
    if (drive.cable_N_m_per_rad > 0 || !(drive.rotor_kg_m2 > 0)) return false;
  }
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    tools::JointFriction& drive = device.masses.joint[k];
    drive.cable_N_m_per_rad = static_cast<double>(device.limits.max_torque_Nm[k]) / 0.02;
    drive.backlash_rad = 0.1 / 360 * kTurn_rad;
  }
  return true;
}

TransmissionCheck check_transmission(const LinkageDevice& device) {
  TransmissionCheck check;
  check.resonance_Hz = resonance(device);
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const tools::JointFriction& drive = device.masses.joint[k];
    if (!(drive.cable_N_m_per_rad > 0 && drive.backlash_rad > 0)) continue;
    add_cycle(device, k, check);
    break;
  }
  return check;
}

bool is_good(const TransmissionCheck& check) {
  return is_within(check.resonance_Hz, kMaxResonanceError) &&
         is_within(check.cycle_Hz, kMaxCycleError) && is_within(check.cycle_rad, kMaxCycleError);
}

}  // namespace firmtouch::host_sim
