#pragma once
#include <vector>

#include "bake/spline_pieces.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::tools {

/// Leaves in the order of the tree, the tree's nodes, and where each part of each piece is.
struct SplineTree {
  std::vector<spline::Leaf> leaves;
  std::vector<spline::Bend> bends;
  std::vector<uint16_t> places;
  std::vector<spline::Capsule> capsules;  // curves
  std::vector<spline::Point> points;      // curves
  std::vector<spline::Box> boxes;         // surfaces
};

/// Pre: the pieces' levels are set; at most spline::kMaxLeaves parts in all.
/// Result: without leaves where a bound is beyond what a leaf can store.
SplineTree build_spline_tree(const std::vector<StoredPiece>& pieces, bool is_surface);

}  // namespace firmtouch::tools
