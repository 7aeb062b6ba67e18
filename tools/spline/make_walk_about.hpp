#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/math/vec3.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// A walk to ask splines along, in even steps of 0.002 of the extent of their box: all through it and a
/// fifth of its extent beyond, so near the middle of a shape, where much of it is about as near, as often
/// as beside it. About curves in a plane of one z it stays there. The same for a seed on every machine.
/// Pre: the model is usable.
std::vector<math::Vec3> make_walk_about(const SplineModel& model, uint64_t seed, uint32_t points);

}  // namespace firmtouch::tools
