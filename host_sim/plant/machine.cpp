#include "host_sim/plant/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {
namespace {

// With a grip of 2,000 N/m on 75 g at 1 kHz the hand's piecewise constant force differs from a
// continuous one by less than 1e-3.
constexpr uint32_t kMinSubsteps = 16;
constexpr double kLinkageStep_s = 2e-5;
// A tooth of a belt.
constexpr double kSlip_rad = 0.05, kSlip_m = 5e-4;

DrivenLinkage linkage_at(const Scenario& scenario, Vec start_m, JointMotion& start) {
  if (!find_angles(*scenario.linkage, start_m, start)) {
    char text[200];
    std::snprintf(text, sizeof text,
                  ": the linkage cannot reach the start at %.4g %.4g %.4g m; move `start` or the "
                  "scene",
                  start_m.x, start_m.y, start_m.z);
    throw Refused(scenario.file + text);
  }
  DrivenLinkage linkage(*scenario.linkage, start);
  if (!linkage.body().is_closed())
    throw Refused(scenario.file +
                  ": at the start the linkage is singular; move `start` or the scene");
  check_inertia(linkage.body(), scenario.device_file);
  return linkage;
}

double* joint_of(Vec& v, uint32_t joint) { return joint == 0 ? &v.x : joint == 1 ? &v.y : &v.z; }

}  // namespace

Machine::Machine(const Scenario& scenario, Vec start_m, Vec zero_m)
    : zero_m_(zero_m),
      quantum_m_(scenario.device.encoder_quantum_m),
      delay_(scenario.device.output_delay_samples, scenario.device.output_delay_part,
             1 / scenario.rate_Hz),
      random_(static_cast<uint64_t>(scenario.seed)) {
  if (scenario.linkage) {
    linkage_.emplace(linkage_at(scenario, start_m, start_));
    device_ = &*scenario.linkage;
    for (uint32_t k = 0; k < joint_count(); ++k) {
      turns_[k] = index_turns(k);
      const tools::JointFriction& joint = device_->masses.joint[k];
      motors_[k] = Motor(joint, {static_cast<double>(device_->continuous_Nm[k]),
                                 static_cast<double>(device_->thermal_time_s[k]),
                                 joint.winding_rise_K, joint.magnet_rise_K, joint.magnet_time_s});
    }
    for (uint32_t k = 0; k < 3 && scenario.linkage->is_homed; ++k)
      zero_count_[k] = linkage_->count(k);
    draw_noise();
  } else {
    DeviceModel prompt = scenario.device;
    prompt.output_delay_samples = 0;
    axes_.emplace(prompt, start_m - zero_m);
  }
  for (const Event& event : scenario.events) {
    if (event.kind != Event::Kind::kFail) continue;
    if (event.failure.joint >= joint_count())
      throw Refused(scenario.file + ": `fail " + failure_name(event.failure.mode) + " " +
                    std::to_string(event.failure.joint) + "`: the device has the joints 0 to " +
                    std::to_string(joint_count() - 1));
    to_fail_.push_back(event);
  }
  locate();
}

void Machine::locate() {
  if (axes_) {
    position_m_ = axes_->position_m() + zero_m_;
    velocity_mps_ = axes_->velocity_mps();
  } else {
    const MovingPoint& tip = linkage_->body().tip();
    position_m_ = tip.at_m;
    velocity_mps_ = tip.velocity_mps;
  }
}

void Machine::draw_noise() {
  for (uint32_t k = 0; k < joint_count() && device_ != nullptr; ++k) {
    const double counts = device_->masses.joint[k].noise_counts;
    if (counts > 0)
      noise_rad_[k] =
          random_.bell() * counts / static_cast<double>(device_->joints.joint[k].counts_per_rad);
  }
}

void Machine::command(const float (&motor)[3], double more_s) {
  pulses_ = 0;
  const Vec wanted{static_cast<double>(motor[0]), static_cast<double>(motor[1]),
                   static_cast<double>(motor[2])};
  const Vec made = after_failures(wanted);
  draw_noise();
  delay_.command(axes_ ? axes_->limited(made) : made, more_s);
}

void Machine::advance(Vec hand_N, double time_s) {
  const Vec mean = delay_.mean(time_s);
  if (axes_) {
    axes_->command(mean);
    axes_->advance(hand_N, time_s);
  } else {
    const double wanted_Nm[] = {mean.x, mean.y, mean.z};
    double torque_Nm[tools::kJoints] = {};
    for (uint32_t k = 0; k < joint_count(); ++k)
      torque_Nm[k] = motors_[k].torque_Nm(wanted_Nm[k], linkage_->rotor_rad(k), time_s);
    linkage_->advance(torque_Nm, hand_N, time_s);
    pass_pulses();
  }
  locate();
}

Machine::Heat Machine::hottest() const {
  Heat most;
  for (uint32_t k = 0; k < joint_count() && linkage_; ++k) {
    const Winding& winding = motors_[k].winding();
    if (winding.largest_rise() > most.share)
      most = {k, winding.largest_rise(), winding.largest_rise() * winding.rated_K()};
  }
  return most;
}

Vec Machine::on_way_to_start_m(const JointMotion& from, double share) const {
  JointMotion at;
  for (uint32_t k = 0; k < tools::kJoints; ++k)
    at.angle_rad[k] = from.angle_rad[k] + (start_.angle_rad[k] - from.angle_rad[k]) * share;
  return device_ != nullptr ? points_of(*device_, at).tip.at_m : position_m_;
}

uint32_t Machine::true_count(uint32_t joint) const {
  if (axes_) return static_cast<uint32_t>(axes_->count(static_cast<int>(joint)));
  return static_cast<uint32_t>(linkage_->count(joint, noise_rad_[joint])) -
         static_cast<uint32_t>(zero_count_[joint]);
}

uint32_t Machine::slip_counts(uint32_t joint) const {
  const double counts =
      axes_ ? kSlip_m / quantum_m_
            : kSlip_rad * static_cast<double>(device_->joints.joint[joint].counts_per_rad);
  return static_cast<uint32_t>(static_cast<int32_t>(std::lround(counts)));
}

void Machine::fail_until(double time_s) {
  for (; next_ < to_fail_.size() && to_fail_[next_].time_s <= time_s; ++next_) {
    const Failure& failure = to_fail_[next_].failure;
    failed_.push_back({failure, true_count(failure.joint)});
  }
}

bool Machine::has_failed(FailureMode mode) const {
  return std::any_of(failed_.begin(), failed_.end(),
                     [&](const Failed& failed) { return failed.what.mode == mode; });
}

bool Machine::has_failed(FailureMode mode, uint32_t joint) const {
  return std::any_of(failed_.begin(), failed_.end(), [&](const Failed& failed) {
    return failed.what.mode == mode && failed.what.joint == joint;
  });
}

uint32_t Machine::flags() const {
  return (has_failed(FailureMode::kEncoderLost) ? record::kFlagEncoderFault : 0) |
         (has_failed(FailureMode::kMotorHot) ? record::kFlagDriveFault : 0) |
         (device_ != nullptr && device_->has_index_pulses
              ? record::flags_of_index(pulses_, latched_)
              : second_counts());
}

int32_t Machine::count(int axis) const {
  const uint32_t joint = static_cast<uint32_t>(axis);
  uint32_t count = true_count(joint);
  for (const Failed& failed : failed_) {
    const uint32_t first = failed.what.joint, second = (first + 1) % joint_count();
    const FailureMode mode = failed.what.mode;
    if (mode == FailureMode::kEncodersSwapped && (joint == first || joint == second))
      count = true_count(joint == first ? second : first);
    if (joint != first) continue;
    if (mode == FailureMode::kEncoderStuck) count = failed.count;
    if (mode == FailureMode::kEncoderLost) count = 0;
    if (mode == FailureMode::kEncoderReversed) count = 2 * failed.count - count;
    if (mode == FailureMode::kEncoderSlipped) count += slip_counts(joint);
  }
  return static_cast<int32_t>(count);
}

double Machine::index_turns(uint32_t joint) const {
  if (!device_->has_index_pulses) return 0;
  const double from_rad = linkage_->body().motion().angle_rad[joint] -
                          static_cast<double>(device_->homing.index_rad[joint]);
  return std::floor(from_rad / static_cast<double>(device_->homing.index_period_rad[joint]));
}

// Index pulses sit on the joints, behind cables, and latch the encoders, which may have failed.
void Machine::pass_pulses() {
  for (uint32_t k = 0; k < joint_count(); ++k) {
    const double turns = index_turns(k);
    if (!(turns > turns_[k] || turns < turns_[k])) continue;
    turns_[k] = turns;
    if (has_failed(FailureMode::kIndexAbsent, k)) continue;
    pulses_ |= 1u << k;
    latched_[k] = static_cast<uint8_t>(count(static_cast<int>(k)));
  }
}

// Second encoders sit on the joints, behind cables, and do not fail.
uint32_t Machine::second_counts() const {
  uint8_t low[record::kAxes] = {};
  for (uint32_t k = 0; k < joint_count() && linkage_; ++k) {
    const double counts = linkage_->body().motion().angle_rad[k] *
                          static_cast<double>(device_->second_counts_per_rad[k]);
    low[k] = static_cast<uint8_t>(static_cast<int64_t>(std::floor(counts)));
  }
  return record::flags_of_second(low);
}

double Machine::encoder_off_rad() const {
  double most_rad = 0;
  for (uint32_t k = 0; k < joint_count() && linkage_; ++k) {
    const uint32_t off = static_cast<uint32_t>(count(static_cast<int>(k))) - true_count(k);
    const double counts_per_rad = static_cast<double>(device_->joints.joint[k].counts_per_rad);
    most_rad = std::max(most_rad, std::fabs(static_cast<int32_t>(off) / counts_per_rad));
  }
  return most_rad;
}

Vec Machine::after_failures(Vec motor) const {
  for (const Failed& failed : failed_) {
    double* const of_joint = joint_of(motor, failed.what.joint);
    if (failed.what.mode == FailureMode::kMotorDead) *of_joint = 0;
    if (failed.what.mode == FailureMode::kMotorReversed) *of_joint = -*of_joint;
  }
  return motor;
}

uint32_t Machine::substeps(double period_s) const {
  if (axes_) return kMinSubsteps;
  return std::max(kMinSubsteps, static_cast<uint32_t>(std::ceil(period_s / kLinkageStep_s - 1e-9)));
}

}  // namespace firmtouch::host_sim
