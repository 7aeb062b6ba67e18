#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Where a closed surface crosses itself. There the sign by the pseudonormal of the nearest
/// feature and the sign by the winding number can differ, and neither is wrong. Indices are
/// those of the surface given.
struct Crossings {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;  // of faces that cross, lower first, in order
  bool has_more_pairs = false;                       // the search stopped at kMaxCrossings

  /// Features whose two sides differ, wholly or in part.
  struct Place {
    std::vector<uint32_t> vertices, faces;
    std::vector<std::pair<uint32_t, uint32_t>> edges;  // by their vertices, lower first
  };
  std::vector<Place> places;  // features that hang together, in the order of their lowest face
};

constexpr uint32_t kMaxCrossings = 100000;

/// Finds all pairs of faces that pass through each other (a vertex in common or none), then the
/// features around them whose sides differ.
/// Bounds: O(n log n + pairs) for surfaces of even triangles.
/// Result: sheets that touch at an edge or a corner do not cross; faces that lie on one another are
///         not looked for.
Crossings find_crossings(const Surface& surface);

/// One line a place, with indices of the file (`vertex_source`: CheckReport; faces by `source`).
std::vector<std::string> describe(const Crossings& crossings, const Surface& surface,
                                  const std::vector<uint32_t>& vertex_source);

}  // namespace firmtouch::tools
