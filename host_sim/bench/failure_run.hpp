#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host_sim/bench/rig.hpp"

namespace firmtouch::host_sim {

/// A way to touch something, in which machines fail.
struct Touch {
  const char* name;
  Solid solid;
  Vec start_m;
  std::vector<std::string> script;
  Lines settings;
};
/// Six: in the air, pressing, knocking, sliding with friction, in a groove, and at two rates.
std::vector<Touch> touches(double radius_m);

/// What the motors did after a machine failed.
struct FailureRun {
  static constexpr int kNever = -1;
  int to_fault = kNever;  // ticks from the failure, with the motors on, to a latched fault
  int to_rest = 0;        // from there to the last torque
  uint32_t faults = 0;
  bool was_due = false;     // second encoders must have seen an encoder that miscounts
  uint32_t overdue = 0;     // ticks in which they must have, without a fault
  uint32_t not_finite = 0;  // words of outputs
  double torque_share = 0;  // the largest torque, over the joint's largest
  double rise_share = 0;    // the same over what the tick before leaves it to rise to
  double tip_mps = 0;       // the largest speed
  double given_J = 0;       // the most work done on the hand
};

/// Watches the ticks of a linkage at 1 kHz that fails at `from_tick`; torques from the first on.
/// Second encoders must see an encoder that is off, in the simulation, by more than they
/// tolerate, three ticks in a row or six of 32.
class FailureWatch {
 public:
  FailureWatch(const tools::LinkageDevice& device, uint32_t from_tick);
  /// Result: whether a fault was latched and the motors rest, so that no more is to be seen.
  bool add(const RunTick& tick);
  const FailureRun& result() const { return run_; }

 private:
  void add_torques(const record::TickOutput& out);
  void add_miscount(double off_rad, bool may_go_on);
  void add_words(const record::TickRecord& record);

  const tools::LinkageDevice& device_;
  uint32_t from_tick_;
  FailureRun run_;
  double tolerated_rad_ = 0;  // 0: there are no second encoders
  uint32_t off_history_ = 0;  // bit k: k ticks ago an encoder was off by more
  double before_Nm_[3] = {}, begin_J_ = 0;
  bool is_pushing_ = false;
};

/// One machine in one of the touches, again and again.
class FailureRig {
 public:
  static constexpr uint32_t kTicksAfter = 150;  // that a run goes on for

  /// `machine`: a linkage's name or file. `touch`: from 0. Throws Refused.
  FailureRig(const std::string& machine, uint32_t touch);
  ~FailureRig();
  const Touch& touch() const { return touch_; }
  uint32_t joints() const { return device_.joints.joints; }
  bool has_index() const { return device_.has_index_pulses; }
  /// Of the touch, in which the machine may fail: behind a homing, if there is one.
  uint32_t ticks() const { return ticks_; }
  FailureRun run(const Failure& failure, uint32_t of_touch);

 private:
  tools::LinkageDevice device_;
  Rig rig_;
  Touch touch_;
  std::unique_ptr<Session> session_;
  uint32_t ticks_ = 0, homed_tick_ = 0, first_tick_ = 0;
};

}  // namespace firmtouch::host_sim
