#pragma once
#include <string>

#include "firmtouch/mesh/layout.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

struct WrapReport {
  std::string problem;  // empty: wrapped
  double cell_m = 0;
  size_t voids = 0;  // grid nodes in hollows that the outside cannot reach: they are solid now
};

/// A surface about `distance_m` from the triangles of `soup`, which may be open, cross themselves,
/// lie anywhere, or be points (all three corners one vertex). Hollows that a ball of this radius
/// cannot reach from outside are filled.
/// Bounds: a grid of at most 2^27 cells of 0.55 distances; distances only near the surface. More
///         than `max_triangles` are refused before one is made.
/// Result: closed, manifold, and without self-crossings except those of rounding, as each triangle
///         lies in a tetrahedron of its own. Every point of the soup lies inside: the corners of
///         its cell are at most 0.96 distances away, so all are inside.
/// Error: its vertices lie within 5 % of a cell's edge of the distance.
/// Source: marching tetrahedra: Doi & Koide 1991; six tetrahedra along the diagonal of a cell:
///         Freudenthal 1942.
Surface wrap_surface(const Surface& soup, double distance_m, WrapReport& report,
                     size_t max_triangles = mesh::kMaxTriangles);

}  // namespace firmtouch::tools
