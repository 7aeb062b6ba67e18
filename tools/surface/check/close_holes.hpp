#pragma once
#include "surface/check/check.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A hole of more edges is not closed: the search for its cap takes the cube of them (1,000: about
/// 3 s).
constexpr uint32_t kMaxHoleEdges = 1000;

/// Closes the holes of a surface whose pieces are wound alike, each with a cap of triangles between
/// the vertices of its border: of all such caps one whose worst bend is the least, of those one of
/// the least area; where that one passes through the surface or another cap, the one of the least
/// area. Caps are wound as their neighbours are, and `source` numbers them from `first_source` on.
/// Adds a line to report.mended for all caps and one for each place; what cannot be closed stands
/// in report.refused.
/// Bounds: O(edges of a hole ^ 3) time, O(^ 2) memory, no recursion.
/// Source: Barequet & Sharir 1995; Liepa 2003, section 3 (bend before area).
void close_holes(Surface& surface, uint32_t first_source, CheckReport& report);

}  // namespace firmtouch::tools
