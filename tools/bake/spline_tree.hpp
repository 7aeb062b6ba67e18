#pragma once
#include <vector>

#include "bake/spline_pieces.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::tools {

/// Curves: leaves in the order of the tree, the tree's nodes, and where each part of each piece is.
struct SplineTree {
  std::vector<spline::Leaf> leaves;
  std::vector<spline::Bend> bends;
  std::vector<uint16_t> places;
  std::vector<spline::Capsule> capsules;
  std::vector<spline::Point> points;
};

/// Pre: the pieces' levels are set; at most spline::kMaxLeaves parts in all.
/// Result: without leaves where a bound is beyond what a leaf can store.
SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces);

/// Surfaces: how each piece is cut, and boxes around pieces.
struct SplineGrids {
  std::vector<spline::Grid> grids;
  std::vector<spline::Corner> corners;
  std::vector<uint8_t> radii;  // and the overlaps behind them
  std::vector<spline::PatchBend> bends;
  std::vector<spline::Box> boxes;
};

/// Puts the pieces into the order of the tree over them; cells are `cell_level` halvings of them. Pre and
/// result as above (grids).
SplineGrids build_spline_grids(std::vector<StoredPiece>& pieces, uint32_t cell_level);

}  // namespace firmtouch::tools
