#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/headed_view.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::field {

/// The bytes of a distance field's sections, as the container returns them.
struct Sections {
  core::Bytes head, distances, seeds;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kHeadSection, head), take(kDistancesSection, distances), take(kSeedsSection, seeds);
  }
};

/// A distance field that Opening has proven against its mesh: every cell's bounds and sign.
/// Immutable; share it between any number of tools.
class View : public query::HeadedView<Head, Sections> {
 public:
  bool is_signed() const { return head_->is_signed != 0; }
  core::Span<const int16_t> distances() const { return distances_; }
  core::Span<const uint32_t> seeds() const { return seeds_; }

 private:
  friend class Proof;
  core::Span<const int16_t> distances_;
  core::Span<const uint32_t> seeds_;
};

/// What Opening proves of a distance field: rules R301 to R310 of tools/FORMAT.md. Each cell's
/// bounds are compared with a query of the proven mesh at its centre, which starts at the cell's
/// seed. A field that passes is as accurate as its mesh.
class Proof {
 public:
  static const query::CheckStage kStages[1];
  /// `mesh` is open and outlives the proof; else rule R305.
  core::Verdict take(const Sections& sections, const mesh::View& mesh);
  core::Verdict check_head() const;
  View view;

 private:
  uint32_t cell_count() const { return view.distances_.size(); }
  core::Verdict check_cell(uint32_t i);

  const mesh::View* mesh_ = nullptr;
};

using Opening = query::Opening<Proof>;

/// All at once.
inline core::Verdict open(const Sections& sections, const mesh::View& mesh, View& view) {
  return query::open_at_once<Opening>(view, sections, mesh);
}

}  // namespace firmtouch::field

extern template class firmtouch::query::Opening<firmtouch::field::Proof>;
