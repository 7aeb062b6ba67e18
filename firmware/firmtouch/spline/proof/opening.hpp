#pragma once
#include "firmtouch/core/status.hpp"
#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Proves a spline model in slices, so that a main loop stays alive while it opens a large one:
/// rules R601 to R625 of tools/FORMAT.md.
class Opening {
 public:
  explicit Opening(const Sections& sections);

  /// Checks up to `elements` pieces, points, nodes, parts of cells or leaves more; one of the last
  /// two counts as 64.
  /// Bounds: about 1,000 instructions an element, 3 KB of stack; no recursion; reads only inside
  /// the sections.
  void work(uint32_t elements);
  bool done() const { return stage_ == Stage::kDone; }
  core::Verdict verdict() const { return verdict_; }
  /// The proven model; one that is not open unless done() and verdict().ok().
  View view() const { return done() && verdict_.ok() ? view_ : View{}; }

 private:
  enum class Stage : uint8_t { kPieces, kPoints, kNodes, kCells, kLeaves, kDone };
  void fail(uint16_t rule, uint32_t element);
  void open_head(const Sections& sections);
  core::Verdict take_sections(const Sections& sections, const Head& head);
  core::Verdict take_curves(const Sections& sections, const Head& head);
  core::Verdict take_surfaces(const Sections& sections, const Head& head);
  uint32_t elements() const;
  void next_stage();
  core::Verdict check(uint32_t i);
  core::Verdict check_piece(uint32_t i);
  core::Verdict check_grid(uint32_t i);
  core::Verdict check_point(uint32_t i);
  core::Verdict check_node(uint32_t i) const;
  core::Verdict check_curve(uint32_t i);
  core::Verdict check_cell(uint32_t i);
  core::Verdict check_leaf(uint32_t i);

  View view_;
  core::Verdict verdict_;
  Stage stage_ = Stage::kDone;
  uint32_t next_ = 0;
  uint32_t coefficients_used_ = 0, corners_used_ = 0, leaves_used_ = 0, cells_used_ = 0;
  uint32_t piece_ = 0, in_piece_ = 0;  // of the cell or leaf that is next
  CellBends bends_;
  CurveBends curve_bends_;
};

/// All at once.
core::Verdict open(const Sections& sections, View& view);

}  // namespace firmtouch::spline
