#pragma once
#include <cstdint>
#include <vector>

#include "footpoint/footpoints.hpp"

namespace firmtouch::tools {

/// Space about a model in 2^levels cells along each side (one along z for planar curves), each with
/// the pieces whose foot-points appear or disappear where a point crosses the cell: those with a
/// place where equation (1) and its derivative by t, (2), vanish for a point of the cell; of
/// patches (3), (4) and their Jacobian's determinant, (5). Certified: where no bound of the
/// Bernstein coefficients over the cell proves that one of them cannot vanish, the piece is listed.
/// Smooth joints where curvature jumps are listed with both pieces.
/// Source: Seong, Johnson, Cohen, sections 3.4 and 4.3.
class CriticalGrid {
 public:
  /// `margin`: how far the grid reaches beyond the model's box, of its extent.
  CriticalGrid(const Footpoints& feet, int levels, double margin);

  /// Of the cell about p_m; false where p_m is outside of the grid.
  bool cell_of(Point p_m, size_t& cell) const;
  /// The cells that the box about two points touches. Result: false where it leaves the grid.
  bool cells_between(Point a_m, Point b_m, std::vector<size_t>& cells) const;
  /// Curve pieces first, patches after them: index - curves.
  const std::vector<uint32_t>& pieces_in(size_t cell) const { return lists_[cell]; }
  size_t cells() const { return lists_.size(); }
  size_t marked() const;
  Point low_m() const { return low_; }
  double side_m() const { return side_; }
  void box_of(size_t cell, Point& low, Point& high) const;

 private:
  struct Work;
  void mark_curve(size_t piece, const CurveSystem& system);
  void mark_joint(size_t from, size_t to, const Footpoints& feet);
  void mark_patch(size_t index, const SurfaceSystem& system);
  void descend(Work& work, int level, size_t x, size_t y, size_t z);
  void descend_patch(Work& work, int level, size_t x, size_t y, size_t z);
  void mark(size_t x, size_t y, size_t z, uint32_t piece);
  Point middle_of(int level, size_t x, size_t y, size_t z, Point& half) const;

  Point low_;
  double side_ = 0;
  int levels_ = 0;
  bool is_flat_ = false;
  size_t count_ = 0;  // of cells along x and y
  std::vector<std::vector<uint32_t>> lists_;
};

}  // namespace firmtouch::tools
