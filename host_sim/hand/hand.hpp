#pragma once
#include <vector>

#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// Simulated hand: a spring and damper between the device and a scripted target, with tremor. It
/// may let go.
class Hand {
 public:
  /// Throws Refused if the script follows a guide and the asset has none.
  Hand(const Scenario& scenario, const Environment& environment, double tool_radius_m);

  /// End of the script; afterwards the target rests.
  double end_s() const;
  Vec start_m() const { return start_m_; }
  /// Of a recorded hand: what holds the grip where the tool was against the force that was rendered
  /// there, mass and damping apart. It is ahead by the arm's two lags.
  Vec target_m(double time_s) const;
  /// At a time of the script, with the target where the arm has it.
  Vec force_N(double time_s, Vec target_m, Vec target_mps, Vec position_m, Vec velocity_mps) const;

 private:
  struct Phase {
    Move move;
    double begin_s = 0, end_s = 0;
    Vec from_m;
    double arc_m = 0;  // arc length of the guide at the phase's begin
  };
  Vec along(const Phase& phase, double time_s) const;
  Vec on_guide(const Phase& phase, double time_s) const;
  double grip(double time_s) const;  // 0: open, 1: closed

  Vec recorded_m(double time_s) const;

  HandModel model_;
  std::vector<HandSample> recorded_;
  const Environment* environment_;
  double tool_radius_m_;
  Vec start_m_;
  std::vector<Phase> phases_;
  bool lets_go_ = false;
};

}  // namespace firmtouch::host_sim
