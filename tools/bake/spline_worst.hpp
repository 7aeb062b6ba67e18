#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::tools {

/// The dearest cold query that a search found.
struct WorstQuery {
  uint32_t steps = 0, evaluations = 0;
  math::Vec3 at_m;
};

/// Looks where many parts are about equally near (centres of curvature, half-way between points of
/// the shape) and anywhere in the workspace (a quarter of the extent about the box), then climbs from
/// the dearest points that it saw. Deterministic. A figure, never a bound.
WorstQuery find_worst(const spline::View& model);

}  // namespace firmtouch::tools
