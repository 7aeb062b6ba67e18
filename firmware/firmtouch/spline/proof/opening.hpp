#pragma once
#include "firmtouch/core/status.hpp"
#include "firmtouch/query/staged_check.hpp"
#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// What Opening proves of a spline model: rules R601 to R625 of tools/FORMAT.md. An element is a
/// piece, point, node, part of a cell or leaf; 3 KB of stack.
class Proof {
 public:
  static const query::CheckStage kStages[5];
  core::Verdict take(const Sections& sections);
  core::Verdict check_head() const;
  View view;

 private:
  core::Verdict take_curves(const Sections& sections, const Head& head);
  core::Verdict take_surfaces(const Sections& sections, const Head& head);
  uint32_t piece_count() const { return view.pieces_.size(); }
  uint32_t point_count() const { return view.points_.size(); }
  uint32_t node_count() const;
  uint32_t cell_count() const;
  uint32_t leaf_count() const { return view.leaf_count(); }
  core::Verdict check_piece(uint32_t i);
  core::Verdict finish_pieces();
  core::Verdict check_grid(uint32_t i);
  core::Verdict check_point(uint32_t i);
  core::Verdict check_node(uint32_t i);
  core::Verdict check_curve(uint32_t i);
  core::Verdict check_cell(uint32_t i);
  core::Verdict finish_cells();
  core::Verdict check_leaf(uint32_t i);

  uint32_t coefficients_used_ = 0, corners_used_ = 0, leaves_used_ = 0, cells_used_ = 0;
  uint32_t piece_ = 0, in_piece_ = 0;  // of the cell or leaf that is next
  CellBends bends_;
  CurveBends curve_bends_;
};

using Opening = query::Opening<Proof>;

/// All at once.
inline core::Verdict open(const Sections& sections, View& view) {
  return query::open_at_once<Opening>(view, sections);
}

}  // namespace firmtouch::spline

extern template class firmtouch::query::Opening<firmtouch::spline::Proof>;
