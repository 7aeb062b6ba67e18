#pragma once
#include <string>
#include <vector>

#include "host_sim/plant/environment.hpp"

namespace firmtouch::host_sim {

/// A scenario that suits what is there, whatever its size: press on the part, follow the guide once
/// freely and once pressing, then an emergency stop while touching. `asset`: as the scenario shall
/// name it.
std::string plan_scenario(const World& world, const std::string& asset);

/// A closed line around the part for parts without a guide of their own: where a plane through the
/// middle of its bounding box, across its longest side, cuts it (the longest loop), a little above
/// the surface. Evenly spaced points, the last repeats the first. Result: nothing where no such
/// loop is found.
std::vector<Vec> outline(const World& world, double height_m);

/// Diagonal of the bounding box of what there is.
double diagonal_m(const World& world);

}  // namespace firmtouch::host_sim
