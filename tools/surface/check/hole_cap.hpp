#pragma once
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The border of a hole: vertices in the order in which its cap winds, and on the other side of
/// each edge (from its vertex to the next) the third vertex of the face there.
struct Hole {
  std::vector<uint32_t> border, beyond;
};

enum class CapRule { kMinBend, kMinArea };

/// Faces between the vertices of the border, none a sliver, none folded back onto its neighbour,
/// none along an edge that the surface already has between two other vertices of the border
/// (`taken`: pairs of vertices, lower first, sorted). Result: empty where there are none.
std::vector<Face> cap_of(const Surface& surface, const Hole& hole,
                         const std::vector<std::pair<uint32_t, uint32_t>>& taken, CapRule rule);

}  // namespace firmtouch::tools
