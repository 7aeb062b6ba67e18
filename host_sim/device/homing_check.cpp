#include "host_sim/device/homing_check.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {
namespace {

using device::HomingFault;

constexpr double kTick_s = 1e-3;
constexpr uint32_t kSubsteps = 4;
constexpr double kTorqueShare = 0.2;  // of the largest torque, at least
constexpr double kWeights = 1.6;      // torque over that which holds the joint's weight, at least
constexpr double kIndexShare = 0.4;   // of the range is an index period
constexpr double kFinger_N_per_m = 2000;
constexpr double kStopDamping = 0.3, kStoppedMass_kg = 0.1;  // of critical, at the link's end
constexpr uint32_t kMaxTicks = 2100;

double wide(float a) { return static_cast<double>(a); }

class Rig {
 public:
  Rig(const tools::LinkageDevice& device, HomingCase what, uint32_t seed, double from_s)
      : device_(device),
        what_(what),
        from_s_(from_s),
        engine_(seed),
        body_(loosened(), anywhere()) {
    joint_ = any_of(joints());
    other_ = (joint_ + 1 + any_of(joints() - 1)) % joints();
    is_invalid_ = any_of(4) == 0;
    finger_s_ = any_of(2) == 0 ? 10 : 0.7 * share();
    double heaviest_Nm[kJoints] = {};
    add_weight(0, {}, heaviest_Nm);
    settings_.margin_rad = 100;
    for (uint32_t k = 0; k < joints(); ++k) {
      const device::JointSetting& joint = device_.joints.joint[k];
      const double range = wide(joint.high_rad) - wide(joint.low_rad);
      settings_.torque_Nm[k] = static_cast<float>(std::max(
          kTorqueShare * wide(device_.limits.max_torque_Nm[k]), kWeights * heaviest_Nm[k]));
      settings_.index_period_rad[k] = static_cast<float>(kIndexShare * range);
      settings_.index_rad[k] = static_cast<float>(wide(joint.low_rad) + range * share());
      settings_.margin_rad = std::min(settings_.margin_rad, 0.5f * settings_.index_period_rad[k]);
      // Unsigned: wraps.
      base_[k] = any_of(2) == 0 ? any_of(0xffffffffu) : 0x80000000u + any_of(4000) - 2000u;
      before_rad_[k] = body_.motion().angle_rad[k];
    }
    settings_.by = device::HomeBy::kIndex;
    finger_rad_ = before_rad_[joint_];
    failed_at_ = static_cast<uint32_t>(body_.count(joint_));
    is_finger_below_ = any_of(2) == 0;
  }

  HomingRun run() {
    HomingRun result;
    device::HomingState state;
    for (uint32_t tick = 0; tick < kMaxTicks; ++tick) {
      const device::HomingTorques out = home(state, settings_, device_.joints, sample());
      for (uint32_t k = 0; k < joints(); ++k)
        result.torque_share = std::max(
            result.torque_share, std::fabs(wide(out.torque_Nm[k])) / wide(settings_.torque_Nm[k]));
      result.seconds = tick * kTick_s;
      if (state.is_done || state.fault != HomingFault::kNone) break;
      advance(out);
    }
    result.is_done = state.is_done;
    result.fault = state.fault;
    for (uint32_t k = 0; k < joints() && state.is_done; ++k) {
      // Of a sound encoder: what fails after the check is not homing's.
      const int64_t off = static_cast<int32_t>(base_[k] + static_cast<uint32_t>(state.offset[k]));
      result.error_counts = std::max(result.error_counts, off < 0 ? -off : off);
    }
    return result;
  }

 private:
  bool fails(HomingCase as) const { return what_ == as && time_s_ >= from_s_; }
  uint32_t joints() const { return device_.joints.joints; }
  uint32_t any_of(uint32_t count) { return static_cast<uint32_t>(engine_() % count); }
  double share() { return static_cast<double>(engine_()) / 4294967296.0; }

  // The largest torques that hold the weight, at the ends and the middles of the ranges.
  void add_weight(uint32_t from, JointMotion at, double (&heaviest_Nm)[kJoints]) const {
    if (from < joints()) {
      const device::JointSetting& joint = device_.joints.joint[from];
      for (const double share : {0.0, 0.5, 1.0}) {
        at.angle_rad[from] =
            wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * share;
        add_weight(from + 1, at, heaviest_Nm);
      }
      return;
    }
    double holding_Nm[kJoints];
    LinkageBody(device_, at).holding_torques_Nm(holding_Nm);
    for (uint32_t k = 0; k < joints(); ++k)
      heaviest_Nm[k] = std::max(heaviest_Nm[k], std::fabs(holding_Nm[k]));
  }

  tools::LinkageDevice loosened() {
    tools::LinkageDevice loose = device_;
    const double length_m = tools::links_of(device_)[0].length_m;
    const double stiffness_N_per_m = 50 * std::pow(100.0, share());
    for (tools::JointFriction& drive : loose.masses.joint) drive.cable_N_m_per_rad = 0;
    loose.masses.stop_N_m_per_rad = stiffness_N_per_m * length_m * length_m;
    loose.masses.stop_N_m_s =
        2 * kStopDamping * std::sqrt(stiffness_N_per_m * kStoppedMass_kg) * length_m * length_m;
    if (what_ == HomingCase::kNoStop) {
      device::JointSetting& joint = loose.joints.joint[any_of(joints())];
      joint.low_rad -= 50, joint.high_rad += 50;
    }
    return loose;
  }
  JointMotion anywhere() {
    JointMotion at;
    for (uint32_t k = 0; k < joints(); ++k) {
      const device::JointSetting& joint = device_.joints.joint[k];
      at.angle_rad[k] =
          wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * share();
    }
    return at;
  }

  int32_t raw(uint32_t k) const {
    uint32_t from = k;
    if (fails(HomingCase::kSwapped) && k == joint_) from = other_;
    if (fails(HomingCase::kSwapped) && k == other_) from = joint_;
    uint32_t counts = static_cast<uint32_t>(body_.count(from));
    if (fails(HomingCase::kReversed) && k == joint_) counts = 2 * failed_at_ - counts;
    if (fails(HomingCase::kDead) && k == joint_) counts = failed_at_;
    return static_cast<int32_t>(counts + base_[k]);
  }

  device::HomingSample sample() {
    device::HomingSample sample;
    sample.encoders.dt_s = static_cast<float>(kTick_s);
    sample.encoders.trusted = !(what_ == HomingCase::kDead && is_invalid_ && time_s_ > 0.1);
    for (uint32_t k = 0; k < joints(); ++k) {
      sample.encoders.counts[k] = raw(k);
      sample.latched[k] = latched_[k];
    }
    sample.pulses = pulses_;
    pulses_ = 0;
    return sample;
  }

  // An index pulse latches the count of its angle.
  void see_pulses() {
    for (uint32_t k = 0; k < joints(); ++k) {
      const double period_rad = wide(settings_.index_period_rad[k]);
      const double now_rad = body_.motion().angle_rad[k];
      const auto number = [&](double angle_rad) {
        return std::floor((angle_rad - wide(settings_.index_rad[k])) / period_rad);
      };
      const double number_now = number(now_rad), number_before = number(before_rad_[k]);
      before_rad_[k] = now_rad;
      if (fails(HomingCase::kNoIndex) && k == joint_) continue;
      const bool is_noise = what_ == HomingCase::kNoise && k == joint_ && any_of(100) == 0;
      if (!(number_now < number_before || number_now > number_before) && !is_noise) continue;
      const double at_rad = is_noise ? now_rad
                                     : wide(settings_.index_rad[k]) +
                                           period_rad * std::max(number_now, number_before);
      const device::JointSetting& joint = device_.joints.joint[k];
      const double counts =
          std::floor((at_rad - wide(joint.zero_rad)) * wide(joint.counts_per_rad));
      uint32_t count = static_cast<uint32_t>(static_cast<int64_t>(counts));
      if (fails(HomingCase::kReversed) && k == joint_) count = 2 * failed_at_ - count;
      latched_[k] = static_cast<int32_t>(count + base_[k]);
      pulses_ |= 1u << k;
    }
  }

  double finger_Nm() const {
    if (what_ != HomingCase::kFinger || time_s_ > finger_s_) return 0;
    const double off_rad = finger_rad_ - body_.motion().angle_rad[joint_];
    if (is_finger_below_ != (off_rad > 0)) return 0;
    const double length_m = tools::links_of(device_)[0].length_m;
    return kFinger_N_per_m * length_m * length_m * off_rad -
           0.02 * body_.motion().rate_rad_per_s[joint_];
  }

  void advance(const device::HomingTorques& out) {
    for (uint32_t step = 0; step < kSubsteps; ++step) {
      double torque_Nm[kJoints] = {};
      for (uint32_t k = 0; k < joints(); ++k) torque_Nm[k] = wide(out.torque_Nm[k]);
      if (fails(HomingCase::kMotorDead)) torque_Nm[joint_] = 0;
      if (fails(HomingCase::kMotorReversed)) torque_Nm[joint_] = -torque_Nm[joint_];
      torque_Nm[joint_] += finger_Nm();
      body_.advance(torque_Nm, {}, kTick_s / kSubsteps);
      if (time_s_ < from_s_) failed_at_ = static_cast<uint32_t>(body_.count(joint_));
      time_s_ += kTick_s / kSubsteps;
      see_pulses();
    }
  }

  const tools::LinkageDevice& device_;
  HomingCase what_;
  double from_s_;
  std::mt19937 engine_;
  LinkageBody body_;
  device::HomingSettings settings_;
  uint32_t joint_ = 0, other_ = 0;
  bool is_invalid_ = false, is_finger_below_ = false;
  double finger_s_ = 0, finger_rad_ = 0, time_s_ = 0;
  uint32_t base_[kJoints] = {}, pulses_ = 0, failed_at_ = 0;  // failed_at_: count of joint_
  int32_t latched_[kJoints] = {};
  double before_rad_[kJoints] = {};
};

}  // namespace

const char* case_name(HomingCase it) {
  static const char* const kNames[] = {"good",       "finger",        "no stop",  "dead encoder",
                                       "reversed",   "swapped",       "no index", "false pulses",
                                       "dead motor", "reversed motor"};
  return kNames[static_cast<uint32_t>(it)];
}

HomingRun simulate_homing(const tools::LinkageDevice& device, HomingCase what, uint32_t seed,
                          double from_s) {
  return Rig(device, what, seed, from_s).run();
}

void add(const HomingRun& run, HomingTally& to) {
  ++to.runs;
  to.homed += run.is_done ? 1 : 0;
  ++to.faults[static_cast<uint32_t>(run.fault) % 16];
  to.worst_counts = std::max(to.worst_counts, run.error_counts);
  to.slowest_s = std::max(to.slowest_s, run.seconds);
  to.torque_share = std::max(to.torque_share, run.torque_share);
  const bool is_over = !run.is_done && run.fault == HomingFault::kNone;
  if (run.error_counts > 1 || !(run.seconds <= 2.001) || !(run.torque_share <= 1) || is_over)
    ++to.wrong;
}

std::string causes(const HomingTally& tally) {
  std::string text;
  for (uint32_t i = 1; i < 16; ++i) {
    if (tally.faults[i] == 0) continue;
    const std::string name = device::fault_name(static_cast<HomingFault>(i));
    text += (text.empty() ? "" : "; ") + std::to_string(tally.faults[i]) + " " +
            name.substr(0, name.find_first_of(":,"));
  }
  return text;
}

}  // namespace firmtouch::host_sim
