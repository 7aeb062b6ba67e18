#pragma once
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Faces that lie in one plane, except for the rounding of their corners. Any triangulation of a
/// region is at most `thickness_m` from any other: both lie between the same two planes.
struct FlatRegions {
  std::vector<uint32_t> of_face;    // kNone: of none
  std::vector<double> thickness_m;  // of each region
};

/// Regions of two faces or more, up to `max_m` thick, about the largest faces first.
/// `mates`: of the half-edges, or kNone.
FlatRegions flat_regions(const Surface& surface, const std::vector<uint32_t>& mates, double max_m);

}  // namespace firmtouch::tools
