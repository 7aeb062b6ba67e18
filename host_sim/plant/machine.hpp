#pragma once
#include <deque>
#include <optional>

#include "host_sim/device/driven_linkage.hpp"
#include "host_sim/plant/device.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// The machine of a run: three Cartesian axes, or the scenario's linkage. Positions are those of
/// the controller's device frame.
class Machine {
 public:
  /// `zero_m`: where the encoders of a Cartesian device count 0.
  /// Throws Refused if the linkage has no inertia, or cannot reach `start_m`.
  Machine(const Scenario& scenario, Vec start_m, Vec zero_m);

  /// Motor forces, or joint torques of a linkage, of this tick; they act after the output delay.
  void command(const float (&motor)[3]);
  /// Moves under motors and hand, both constant during `time_s`.
  void advance(Vec hand_N, double time_s);
  Vec position_m() const { return position_m_; }
  Vec velocity_mps() const { return velocity_mps_; }
  /// Of a linkage that is homed: from 0 where it was switched on.
  int32_t count(int joint) const;
  JointMotion joints() const { return linkage_ ? linkage_->body().motion() : JointMotion{}; }
  /// Of a linkage: the tip where each joint has gone `share` of its way from `from` to the start.
  Vec on_way_to_start_m(const JointMotion& from, double share) const;
  /// Null for a Cartesian device.
  const EnergyBook* energy() const { return linkage_ ? &linkage_->energy() : nullptr; }
  /// Integration steps in a tick of `period_s`, so that a linkage has 50,000 a second.
  uint32_t substeps(double period_s) const;

 private:
  void locate();

  Vec zero_m_;
  const tools::LinkageDevice* device_ = nullptr;
  JointMotion start_;
  int32_t zero_count_[3] = {};
  std::optional<Device> axes_;
  std::optional<DrivenLinkage> linkage_;
  std::deque<Vec> delayed_Nm_;  // torques of a linkage, the oldest first
  Vec motor_Nm_;
  Vec position_m_, velocity_mps_;
};

}  // namespace firmtouch::host_sim
