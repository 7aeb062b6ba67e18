#pragma once
#include <optional>
#include <vector>

#include "host_sim/device/driven_linkage.hpp"
#include "host_sim/device/motor.hpp"
#include "host_sim/plant/delay_line.hpp"
#include "host_sim/plant/device.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {

/// The machine of a run: three Cartesian axes, or the scenario's linkage. Positions are those of
/// the controller's device frame. It fails as the scenario's events say.
class Machine {
 public:
  /// `zero_m`: where the encoders of a Cartesian device count 0.
  /// Throws Refused if the linkage has no inertia, or cannot reach `start_m`, or if a joint is to
  /// fail that it does not have.
  Machine(const Scenario& scenario, Vec start_m, Vec zero_m);

  /// From now on what fails by this time of the scenario has failed.
  void fail_until(double time_s);
  /// Flags of a tick's input: an encoder or a driver that reports its failure, and index pulses
  /// since the last command or the counts of second encoders.
  uint32_t flags() const;
  /// Whether the hand has no hold of the machine any more.
  bool is_torn_off() const { return has_failed(FailureMode::kLinkBroken); }

  /// Motor forces, or joint torques of a linkage, of this tick; they act after the output delay,
  /// and `more_s` later: the time that the controller took.
  void command(const float (&motor)[3], double more_s = 0);
  /// Moves under motors and hand, both constant during `time_s`.
  void advance(Vec hand_N, double time_s);
  Vec position_m() const { return position_m_; }
  Vec velocity_mps() const { return velocity_mps_; }
  /// With the encoder's noise. Of a linkage that is homed: from 0 where it was switched on.
  int32_t count(int joint) const;
  /// The largest angle by which a joint's encoder has miscounted. 0 of a Cartesian device.
  double encoder_off_rad() const;
  JointMotion joints() const { return linkage_ ? linkage_->body().motion() : JointMotion{}; }
  /// Of a linkage: the tip where each joint has gone `share` of its way from `from` to the start.
  Vec on_way_to_start_m(const JointMotion& from, double share) const;
  /// The hottest that a winding of a linkage's motors with thermal limits was, from cold.
  struct Heat {
    uint32_t joint = 0;
    double share = 0, rise_K = 0;  // of its rated rise; 0: there is none
  };
  Heat hottest() const;
  /// Null for a Cartesian device.
  const EnergyBook* energy() const { return linkage_ ? &linkage_->energy() : nullptr; }
  /// Integration steps in a tick of `period_s`, so that a linkage has 50,000 a second.
  uint32_t substeps(double period_s) const;

 private:
  struct Failed {
    Failure what;
    uint32_t count = 0;  // of its encoder, then
  };
  void locate();
  void draw_noise();
  bool has_failed(FailureMode mode) const;
  bool has_failed(FailureMode mode, uint32_t joint) const;
  uint32_t joint_count() const { return device_ != nullptr ? device_->joints.joints : 3; }
  uint32_t true_count(uint32_t joint) const;
  uint32_t slip_counts(uint32_t joint) const;
  uint32_t second_counts() const;
  double index_turns(uint32_t joint) const;
  void pass_pulses();
  Vec after_failures(Vec motor) const;

  Vec zero_m_;
  const tools::LinkageDevice* device_ = nullptr;
  JointMotion start_;
  int32_t zero_count_[3] = {};
  double quantum_m_;
  std::vector<Event> to_fail_;
  size_t next_ = 0;
  std::vector<Failed> failed_;
  std::optional<Device> axes_;
  std::optional<DrivenLinkage> linkage_;
  DelayLine delay_;
  tools::Random random_;
  double noise_rad_[3] = {};  // of encoders, until the next command
  Motor motors_[tools::kJoints];
  double turns_[3] = {};  // whole index periods of a joint
  uint32_t pulses_ = 0;
  uint8_t latched_[3] = {};
  Vec position_m_, velocity_mps_;
};

}  // namespace firmtouch::host_sim
