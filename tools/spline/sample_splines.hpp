#pragma once
#include <cstdint>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Curves and surfaces of about unit size, as the published examples are, and a path beside them,
/// for benches, tests and `firmtouch make`. The same for a seed on every machine.

/// A clamped cubic of `n` points that winds about, uneven knots.
SplineCurve winding_curve(uint64_t seed, size_t n, bool is_planar, bool weighs);

/// A bicubic surface of n by n points over the unit square.
SplineSurface hilly_surface(uint64_t seed, size_t n, double rise, bool weighs);

/// A wandering path of even steps over the unit square, up to 0.2 beyond, z between two values.
std::vector<Point> wandering_path(uint64_t seed, size_t positions, double step, double low_z,
                                  double high_z);

/// The same path about the box from `low` to `high`, by the extent of the box; in its plane where
/// it has no height.
std::vector<Point> path_about(const std::vector<Point>& path, Point low, Point high);

}  // namespace firmtouch::tools
