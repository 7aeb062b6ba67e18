#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/mesh/layout.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Unit normals of the faces, edges that leave each vertex, and angle-weighted sums of the face
/// normals about each vertex, in double.
/// Source: Baerentzen & Aanaes 2005, equation 7.
struct ExactNormals {
  std::vector<Point> faces;     // unit
  std::vector<Point> vertices;  // unit; (0, 0, 1) where the sum vanishes
  std::vector<uint32_t> mates;  // of each half-edge (surface/edges.hpp)

  /// Pre: every edge has two faces, wound alike.
  explicit ExactNormals(const Surface& surface);
  /// Sum of the normals of the two faces of half-edge `h`: its pseudonormal, not of unit length.
  Point of_edge(uint32_t h) const { return faces[h / 3] + faces[mates[h] / 3]; }
};

/// The pseudonormals as an asset stores them.
struct Pseudonormals {
  std::vector<uint32_t> vertices;
  std::vector<mesh::EdgeFolds> edges;  // of the faces, in their order
};

/// The nearest codes; where those leave less than a degree of the margin, the best of the codes
/// beside them.
/// Pre: every edge has two faces, wound alike; the longest edge of each face is its first.
Pseudonormals make_pseudonormals(const Surface& surface, const ExactNormals& exact);

}  // namespace firmtouch::tools
