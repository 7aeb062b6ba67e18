#pragma once
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Rotates every face so that its longest edge comes first, by the firmware's own arithmetic, which
/// open() repeats.
void longest_edge_first(Surface& surface);

/// How far the surface moves where edge a b of the faces a b c and b a d is flipped to c d. Seen
/// along the normal of both, the faces before and after fill the same quadrilateral; nowhere do
/// they lie farther apart than where the diagonals cross.
/// Result: infinite where they do not cross, or a corner is NaN.
double moved_by_flip_m(Point a, Point b, Point c, Point d);

/// Over the longest edge.
double height_m(Point a, Point b, Point c);

/// Slivers without a usable normal, removed by edge flips.
struct TurnedSlivers {
  uint32_t flips = 0;
  double moved_m = 0;  // every point of either surface lies so near to the other
};

/// Flips the longest edges of `slivers`: the two faces about it become those about the other
/// diagonal. Vertices keep their places, the surface stays closed and manifold. An edge stays if
/// its flip would move the surface by more than `max_m` or leave a face of at most `min_height_m`,
/// or if a flip of this call has changed a face at one of its corners.
/// Pre: `mates` of the faces (surface/edges.hpp), no kNone; each longest edge is the first.
/// Bounds: O(sum of valences of the slivers).
/// Source: Botsch et al. 2010, "Polygon Mesh Processing", section 8.
TurnedSlivers turn_slivers(Surface& surface, const std::vector<uint32_t>& mates,
                           const std::vector<uint32_t>& slivers, double max_m, double min_height_m);

}  // namespace firmtouch::tools
