#pragma once
#include "firmtouch/mesh/view.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Unsigned distance of `p_m` (mesh frame) to the surface, over every triangle, in double.
/// An oracle for the controller's answers; shares no code with its search.
double brute_force_distance_m(const mesh::View& mesh, Vec p_m);

}  // namespace firmtouch::host_sim
