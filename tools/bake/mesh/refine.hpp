#pragma once
#include <cstdint>

#include "bake/tree/principal_axes.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Faces of a refined surface, over those given: 36 bytes a face become 60 at most.
constexpr double kMaxGrowth = 1.65;

struct Refined {
  uint32_t flips = 0, splits = 0;
  double moved_m = 0;  // every point of either surface lies so near to the other

  bool any() const { return flips + splits != 0; }
};

/// Whether the surface has 256 faces or more, and edges from about which on float32 alone does not
/// keep the promised error (firmware/firmtouch/mesh/loss.hpp).
bool has_long_edges(const Surface& surface);

/// Makes the long thin triangles of machined parts compact, because a query reads all boxes within
/// its distance. Edges inside flat faces are flipped where that makes the boxes of their two faces,
/// along the axes of `boxes`, smaller; and the longest edges are split in the middle. Splits that
/// do not halve the longest edge are dropped: they made trees deeper and queries no cheaper. The
/// surface stays closed and manifold, and moves by `max_move_m` at most. Edges without exactly two
/// faces wound alike stay.
/// Faces of two materials are never joined.
/// Result: a face made from others has the `source` of one of them.
/// Bounds: O(n log n) splits and flips, the same on every machine.
/// Source: Rivara 1984 (longest edge first); Lawson 1977 (flips, for another aim).
Refined refine(Surface& surface, double max_move_m, double max_growth = kMaxGrowth,
               const Frame& boxes = {});

}  // namespace firmtouch::tools
