#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::field {

/// The bytes of a distance field's sections, as the container returns them.
struct Sections {
  core::Bytes head, distances, seeds;
};

/// A distance field that Opening has proven against its mesh: every cell's bounds and sign.
/// Immutable; share it between any number of tools.
class View {
 public:
  View() = default;

  bool is_open() const { return head_ != nullptr; }
  bool is_signed() const { return head_->is_signed != 0; }
  const Head& head() const { return *head_; }
  core::Span<const int16_t> distances() const { return distances_; }
  core::Span<const uint32_t> seeds() const { return seeds_; }

 private:
  friend class Opening;
  const Head* head_ = nullptr;
  core::Span<const int16_t> distances_;
  core::Span<const uint32_t> seeds_;
};

/// Proves a distance field in slices: rules R301 to R310 of tools/FORMAT.md. Each cell's bounds are
/// compared with a query of the proven mesh at its centre, which starts at the cell's seed. A field
/// that passes is as accurate as its mesh.
class Opening {
 public:
  /// `mesh` is open and outlives the opening; else rule R305.
  Opening(const Sections& sections, const mesh::View& mesh);

  /// Checks up to `cells` cells more.
  /// Bounds: one query of the mesh a cell (some thousand instructions where the seed is right); no
  ///         recursion; reads only inside the sections.
  void work(uint32_t cells);
  bool done() const { return check_.done(); }
  core::Verdict verdict() const { return check_.verdict(); }
  /// The proven field; one that is not open unless done() and verdict().ok().
  View view() const { return check_.has_passed() ? view_ : View{}; }

 private:
  static const query::CheckStage<Opening> kStages[1];
  core::Verdict open_head(const Sections& sections);
  uint32_t cell_count() const { return view_.distances_.size(); }
  core::Verdict check_cell(uint32_t i);

  View view_;
  const mesh::View* mesh_;
  query::StagedCheck check_;
};

/// All at once.
core::Verdict open(const Sections& sections, const mesh::View& mesh, View& view);

}  // namespace firmtouch::field
