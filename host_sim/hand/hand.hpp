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
  double end_s() const { return phases_.empty() ? 0 : phases_.back().end_s; }
  Vec start_m() const { return start_m_; }
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

  HandModel model_;
  const Environment* environment_;
  double tool_radius_m_;
  Vec start_m_;
  std::vector<Phase> phases_;
  bool lets_go_ = false;
};

}  // namespace firmtouch::host_sim
