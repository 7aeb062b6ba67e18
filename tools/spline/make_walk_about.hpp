#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/math/vec3.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// A path of query points for splines, in even steps of 0.002 of the extent of their box. It runs
/// through the box and a fifth of its extent beyond, so it is as often near the middle of a shape,
/// where many pieces are equally near, as outside. For curves in a plane of one z it stays in it.
/// The same points for a seed on every machine.
/// Pre: the model is usable.
std::vector<math::Vec3> make_walk_about(const SplineModel& model, uint64_t seed, uint32_t points);

}  // namespace firmtouch::tools
