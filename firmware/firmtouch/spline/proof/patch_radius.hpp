#pragma once
// How far a surface is from the quads that stand for its parts: for the proof at open, and for the
// baker, which stores it.
#include "firmtouch/spline/proof/leaf_shape.hpp"

namespace firmtouch::spline {

/// What is stored of a part of a surface.
Quad stored_quad(const Piece& piece, const Grid& grid, const Corner* corners, const Patch& patch);

/// Of a quad the x and y that belong to a part of it.
struct RegionOfQuad {
  float low[2] = {-1.0f, -1.0f}, high[2] = {1.0f, 1.0f};
};
/// Of a part of a surface what one of its leaves is, and the leaf's half of it by the part's
/// overlap.
RegionOfQuad own_of(const Piece& piece, const Patch& above, const Patch& leaf);
RegionOfQuad half_of(const Piece& piece, const Patch& above, const Patch& leaf, uint32_t overlap);

/// A leaf by points on a grid over it, from the piece's origin: by y, then by x.
struct LeafPoints {
  static constexpr uint32_t kSide = 7;
  explicit LeafPoints(const LeafShape& shape);
  math::Vec3 at_m[kSide][kSide];
  float bent_m;            // its second derivatives by x and by y, at most, added
  float reach_m, noise_m;  // as LeafShape
};

/// What the radius of a part must at least be, what float32 loses when a query measures against it
/// included, so that each point of that leaf is within it of some point of its quad, or of what is
/// `within` of it. own: where on the quad the leaf is thought to be; any would do.
float radius_for(const LeafPoints& leaf, const Quad& around, const RegionOfQuad& own,
                 const RegionOfQuad& within = {});

}  // namespace firmtouch::spline
