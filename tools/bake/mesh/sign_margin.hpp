#pragma once
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

// By how much a pseudonormal may turn before it gives a wrong sign for some point whose closest
// point lies on its feature (Baerentzen & Aanaes 2005, equation 15). All in double.

/// An edge that leaves a vertex: its unit direction and its own pseudonormal, the sum of the unit
/// normals of its two faces (any length).
struct StarEdge {
  Point direction, normal;
};

/// A direction from a vertex to points of which it may be the closest, and their side: +1 outside.
struct SideRay {
  Point direction;  // unit
  int side;
};

/// The extreme rays of the cone of directions r from which the vertex may be the closest point,
/// those with r . e <= 0 for every edge e: what holds for the rays holds for the cone. None: the
/// vertex is never the closest point.
///
/// Each extreme ray is square to an edge and lies in the wedge that this edge alone would see, so
/// that its side is that edge's: no property of vertex pseudonormals is used.
/// Bounds: O(m^2 log m + m n) a round for n edges, m of them on the cone; from m = 1,000 on
///         some are left out, which widens the cone.
std::vector<SideRay> extreme_rays(const std::vector<StarEdge>& star);

/// Sine of the margin of `normal` (unit) over the rays; 1 where there are none, -1 where the normal
/// is NaN.
double vertex_margin(const std::vector<SideRay>& rays, Point normal);

/// The same for an edge between faces of unit normals `one` and `other`: its points lie in the
/// wedge between the two normals, or between their opposites.
double edge_margin(Point one, Point other, Point normal);

}  // namespace firmtouch::tools
