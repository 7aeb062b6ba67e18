#pragma once
#include <vector>

#include "bake/spline/spline_pieces.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::tools {

/// Curves: leaves, of each its piece, the points between them and the radii of all nodes.
struct SplineTree {
  std::vector<uint16_t> leaves;
  std::vector<spline::CurveBend> bends;  // of the pieces
  std::vector<math::Vec3> points_m;
  std::vector<uint8_t> radii;
  float radius_unit_m = 0;
};

/// All but its first leaf; infinite where a weight may fall to half of its middle's on a sixteenth
/// of it.
spline::CurveBend curve_bend_of(const StoredPiece& stored);

/// Pre: the pieces' levels are set; at most spline::kMaxLeaves parts in all.
/// Result: without leaves where a bound is beyond what can be stored, or there are too many leaves.
SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces);

/// Surfaces: how each piece is cut, and boxes around pieces.
struct SplineGrids {
  std::vector<spline::Grid> grids;
  std::vector<spline::Corner> corners;
  std::vector<uint8_t> radii;  // and the overlaps behind them
  std::vector<spline::PatchBend> bends;
  std::vector<spline::Box> boxes;
};

/// Puts the pieces into the order of the tree over them; cells are `cell_level` halvings of them,
/// of a piece with a pole its leaves. Pre and result as above (grids).
SplineGrids build_spline_grids(std::vector<StoredPiece>& pieces, uint32_t cell_level);

}  // namespace firmtouch::tools
