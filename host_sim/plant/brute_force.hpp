#pragma once
#include "firmtouch/mesh/view.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Distance of `p_m` (mesh frame) to the surface by looking at every triangle, in double: the judge
/// of what the controller answered. Shares no code with it.
double brute_force_distance_m(const mesh::View& mesh, Vec p_m);

}  // namespace firmtouch::host_sim
