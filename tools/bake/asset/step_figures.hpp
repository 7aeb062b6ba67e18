#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "bake/asset/provenance.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::tools {

constexpr uint32_t kFigureQueries = 2000;

/// Steps that queries were seen to need. A figure, never a bound: the bound of a tick is its
/// budget.
struct StepFigures {
  uint32_t random_worst = 0, path_worst = 0;
  double random_mean = 0, path_mean = 0;
};

/// Steps that `steps_of(point, cold)` needs for kFigureQueries random points within 1.5 times the
/// box, each on its own, and for the points of a path, each warm-started by the one before.
/// Deterministic.
StepFigures measure_steps(const float (&low_m)[3], const float (&high_m)[3],
                          const std::vector<math::Vec3>& path_m,
                          const std::function<uint32_t(math::Vec3, bool)>& steps_of);

void add_steps(const StepFigures& steps, Facts& facts);

/// A path along a polyline, beside it by 0.5 % of `diagonal_m`: what a guided hand does.
std::vector<math::Vec3> path_along(const std::vector<math::Vec3>& polyline_m, float diagonal_m);

}  // namespace firmtouch::tools
