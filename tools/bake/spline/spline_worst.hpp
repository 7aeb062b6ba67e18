#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::tools {

/// The most expensive cold query that a search found.
struct WorstQuery {
  uint32_t steps = 0, evaluations = 0;
  math::Vec3 at_m;
};

/// Looks where many parts are about equally near (centres of curvature, half-way between points of
/// the shape) and anywhere in the workspace (a quarter of the extent about the box), then ascends
/// from the most expensive points that it saw. Deterministic. A figure, never a bound.
WorstQuery find_worst(const spline::View& model);

/// About how many instructions a Cortex-M7 takes for a query of so many steps, `evaluations` of
/// them leaves that are evaluated: fitted to counts (tools/bench/cortex-m7-spline), within a fifth
/// of expensive queries.
double cortex_m7_instructions(bool is_surface, double steps, double evaluations);

}  // namespace firmtouch::tools
