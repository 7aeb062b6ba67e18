#pragma once
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A point of a drawing on a grid of whole units: predicates are exact. |x|, |y| < 2^30.
struct DrawingPoint {
  int64_t x = 0, y = 0;
};
using Outline = std::vector<DrawingPoint>;

/// Triangles of the area inside loops[0] (counter-clockwise) and outside the others (holes,
/// clockwise). Corners are numbered through all loops in their order. Holes are joined to the outer
/// loop by cuts, then ears are cut off in the order of the loop, as simple CAD exporters do: the
/// faces are long and thin.
/// Pre: the loops are simple, disjoint and nested as said.
/// Bounds: O(n^2) for usual outlines.
/// Result: empty if the loops are not so, as far as it notices: a loop that crosses itself may get
///         triangles all the same; see is_simple().
/// Source: Eberly 2002, "Triangulation by ear clipping".
std::vector<Face> clip_ears(const std::vector<Outline>& loops);

/// Whether no two sides of the outline share a point other than the corner between them.
/// Bounds: O(n^2).
bool is_simple(const Outline& outline);

}  // namespace firmtouch::tools
