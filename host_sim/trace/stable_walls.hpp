#pragma once
#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// Up to where the firmware enables walls on a linkage (controller/any_device.hpp).
struct StableWalls {
  double contact_N_per_m = 0, guide_N_per_m = 0;
  double both_N_per_m = 0;                  // their sum: where the guide pulls into a surface
  double contact_beside_guide_N_per_m = 0;  // with the scenario's guide_stiffness
  double texture_N = 0;  // the force up to which its textures are stable; 0: it has none
};

/// With the scenario's settings.
/// Pre: scenario.linkage.
StableWalls stable_walls(const Scenario& scenario, const Environment& environment);

}  // namespace firmtouch::host_sim
