#pragma once
#include <vector>

#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// A hand: a spring and damper from the device to a target that a script moves.
class Hand {
 public:
  /// Throws Refused where the script follows a guide that the asset does not have.
  Hand(const Scenario& scenario, const World& world, double tool_radius_m);

  /// When the script ends; the target then rests.
  double end_s() const { return stretches_.empty() ? 0 : stretches_.back().end_s; }
  Vec start_m() const { return start_m_; }
  Vec target_m(double time_s) const;
  Vec force_N(Vec target_m, Vec target_mps, Vec position_m, Vec velocity_mps) const;

 private:
  struct Stretch {
    Move move;
    double begin_s = 0, end_s = 0;
    Vec from_m;
    double arc_m = 0;  // where on the guide it begins
  };
  Vec along(const Stretch& stretch, double time_s) const;
  Vec on_guide(const Stretch& stretch, double time_s) const;

  HandModel model_;
  const World* world_;
  double tool_radius_m_;
  Vec start_m_;
  std::vector<Stretch> stretches_;
};

}  // namespace firmtouch::host_sim
