#include "host_sim/plant/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {
namespace {

// With a grip of 2,000 N/m on 75 g at 1 kHz the hand's piecewise constant force differs from a
// continuous one by less than 1e-3.
constexpr uint32_t kMinSubsteps = 16;
constexpr double kLinkageStep_s = 2e-5;

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
  if (!linkage.body().has_inertia())
    throw Refused(scenario.device_file +
                  ": its inertia is not positive definite; give each joint a rotor_ or its links "
                  "masses");
  return linkage;
}

}  // namespace

Machine::Machine(const Scenario& scenario, Vec start_m, Vec zero_m) : zero_m_(zero_m) {
  if (scenario.linkage) {
    linkage_.emplace(linkage_at(scenario, start_m, start_));
    device_ = &*scenario.linkage;
    delayed_Nm_.resize(scenario.device.output_delay_samples);
    for (uint32_t k = 0; k < 3 && scenario.linkage->is_homed; ++k)
      zero_count_[k] = linkage_->count(k);
  } else {
    axes_.emplace(scenario.device, start_m - zero_m);
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

void Machine::command(const float (&motor)[3]) {
  const Vec wanted{static_cast<double>(motor[0]), static_cast<double>(motor[1]),
                   static_cast<double>(motor[2])};
  if (axes_) return axes_->command(wanted);
  delayed_Nm_.push_back(wanted);
  motor_Nm_ = delayed_Nm_.front();
  delayed_Nm_.pop_front();
}

void Machine::advance(Vec hand_N, double time_s) {
  if (axes_) {
    axes_->advance(hand_N, time_s);
  } else {
    linkage_->advance({motor_Nm_.x, motor_Nm_.y, motor_Nm_.z}, hand_N, time_s);
  }
  locate();
}

Vec Machine::on_way_to_start_m(const JointMotion& from, double share) const {
  JointMotion at;
  for (uint32_t k = 0; k < tools::kJoints; ++k)
    at.angle_rad[k] = from.angle_rad[k] + (start_.angle_rad[k] - from.angle_rad[k]) * share;
  return device_ != nullptr ? points_of(*device_, at).tip.at_m : position_m_;
}

int32_t Machine::count(int joint) const {
  if (axes_) return axes_->count(joint);
  const uint32_t k = static_cast<uint32_t>(joint);
  return linkage_->count(k) - zero_count_[k];
}

uint32_t Machine::substeps(double period_s) const {
  if (axes_) return kMinSubsteps;
  return std::max(kMinSubsteps, static_cast<uint32_t>(std::ceil(period_s / kLinkageStep_s - 1e-9)));
}

}  // namespace firmtouch::host_sim
