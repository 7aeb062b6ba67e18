#pragma once
#include <string>
#include <vector>

#include "device/device_file.hpp"
#include "host_sim/plant/environment.hpp"

namespace firmtouch::host_sim {

/// The linkage that a planned hand moves; none: straight axes.
struct PlannedDevice {
  std::string file;  // as the scenario names it
  const tools::LinkageDevice* linkage = nullptr;
  // Up to these the firmware enables walls on it; 0: no limit.
  double stable_contact_N_per_m = 0, stable_guide_N_per_m = 0, stable_texture_N = 0;
  bool is_planar() const { return linkage != nullptr && linkage->joints.joints == 2; }
};

/// Where a planned hand begins: above the guide's start or the surface, of a planar linkage before
/// it in its plane.
Vec planned_start_m(const Environment& environment, const PlannedDevice& device);

/// Text of a scenario scaled to the asset: press on the surface, follow the guide once without and
/// once with pressing, if a linkage reaches it, emergency stop in contact. Walls are no stiffer
/// than the linkage renders. `asset`: path to write into the scenario.
std::string plan_scenario(const Environment& environment, const std::string& asset,
                          const PlannedDevice& device = {});

/// A closed line around the mesh, to be baked as a guide: the longest loop in which the mid plane
/// across the bounding box's shortest side cuts the mesh, raised by `height_m`.
/// Result: evenly spaced points, the last equals the first; empty if there is no such loop.
std::vector<Vec> outline(const Environment& environment, double height_m);

/// Diagonal of the bounding box of surface and guide.
double diagonal_m(const Environment& environment);

}  // namespace firmtouch::host_sim
