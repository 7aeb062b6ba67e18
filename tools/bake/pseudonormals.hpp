#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmtouch/mesh/layout.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The stored pseudonormals of a closed surface, and what their encoding leaves of the margin by
/// which each may turn before it tells a wrong side (Baerentzen & Aanaes 2005, equation 15).
struct Pseudonormals {
  std::vector<uint32_t> vertices;
  std::vector<mesh::EdgeFolds> edges;  // of the faces, in their order
  double smallest_vertex_margin_rad = 0, smallest_edge_margin_rad = 0;
  uint32_t worst_vertex = 0, worst_face = 0;
};

/// Pre: every edge has two faces, wound alike.
Pseudonormals make_pseudonormals(const Surface& surface);

}  // namespace firmtouch::tools
