#pragma once
#include <optional>

#include "bake/tree/principal_axes.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// By this part of the diagonal boxes count as wider, for a query near the surface reads those
/// within its distance. A touching path lies 0.001 diagonals off.
constexpr double kBoxMargin = 0.004;

/// The frame in which the boxes of the faces have the least area, of those along the largest faces
/// and their edges; none where the axes do about as well.
/// Bounds: O(n log n). The same on every machine.
std::optional<Frame> best_box_frame(const Surface& surface);

/// Half the area of the box of three corners, wider by `margin_m`.
double half_box_area(Point a, Point b, Point c, double margin_m);

/// As it is stored.
mesh::BoxFrame stored(const Frame& frame, const Surface& surface);

/// The surface as mesh::turned() has it.
Surface in_box_frame(const Surface& surface, const mesh::BoxFrame& frame);

}  // namespace firmtouch::tools
