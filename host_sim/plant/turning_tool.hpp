#pragma once
#include <vector>

#include "firmtouch/record/tick.hpp"
#include "firmtouch/scene/tool.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// A sphere of the tool, at its place.
struct PlacedSphere {
  Vec centre_m;
  double radius_m = 0;
};

/// The spheres of an asset's tool as commands turn its handle, by the ticks of a run. The
/// arithmetic of the turn is the controller's.
class TurningTool {
 public:
  TurningTool(std::vector<scene::SphereLayout> spheres, float tick_period_s)
      : spheres_(std::move(spheres)), tick_period_s_(tick_period_s) {}
  /// Once for each tick, in order.
  void take(const record::TickRecord& record);
  bool is_empty() const { return spheres_.empty(); }
  Vec turn_rad() const;  // rotation vector
  std::vector<PlacedSphere> placed(Vec handle_m) const;
  /// The sphere with the least room, which the record names, where it is for a free handle.
  Vec nearest_m(const record::TickOutput& out, Vec handle_m) const;

 private:
  Vec centre_m(const scene::SphereLayout& sphere, Vec handle_m) const;

  std::vector<scene::SphereLayout> spheres_;
  scene::ToolTurn turn_;
  float tick_period_s_;
};

}  // namespace firmtouch::host_sim
