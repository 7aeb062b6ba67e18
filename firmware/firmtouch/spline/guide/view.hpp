#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/query/staged_check.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Pieces from `first_piece` on, up to the next chain's: each begins where the one before ends.
struct Chain {
  uint16_t first_piece;
  uint16_t is_closed;  // 1: the last ends where the first begins
};
static_assert(sizeof(Chain) == 4);

constexpr uint32_t kMaxArcIntervals = 64;  // of a piece

struct GuideSections {
  core::Bytes arcs, chains;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kArcsSection, arcs), take(kChainsSection, chains);
  }
};

/// A proven model of curves with the lengths along it.
class GuideView {
 public:
  using Sections = GuideSections;
  GuideView() = default;
  bool is_open() const { return model_.is_open(); }
  const View& model() const { return model_; }
  float length_m() const { return arcs_[arcs_.size() - 1]; }  // of all chains together
  uint32_t intervals() const { return intervals_; }           // of a piece, of equal steps of its s
  /// From the first piece's beginning to each part's.
  core::Span<const float> arcs() const { return arcs_; }
  core::Span<const Chain> chains() const { return chains_; }

 private:
  friend class GuideProof;
  View model_;
  core::Span<const float> arcs_;
  core::Span<const Chain> chains_;
  uint32_t intervals_ = 0;
};

/// What GuideOpening proves of the lengths along curves: rules R641 to R645 of tools/FORMAT.md.
class GuideProof {
 public:
  static const query::CheckStage kStages[1];
  /// Pre: `model` is open.
  core::Verdict take(const View& model, const GuideSections& sections);
  core::Verdict check_head() const;
  GuideView view;

 private:
  uint32_t interval_count() const { return view.arcs_.size() - 1; }
  core::Verdict check_interval(uint32_t i);
  core::Verdict check_joint(uint32_t piece);

  uint32_t chain_ = 0;  // of the piece that is next
};

using GuideOpening = query::Opening<GuideProof>;

/// All at once.
inline core::Verdict open_guide(const View& model, const GuideSections& sections, GuideView& view) {
  return query::open_at_once<GuideOpening>(view, model, sections);
}

}  // namespace firmtouch::spline

extern template class firmtouch::query::Opening<firmtouch::spline::GuideProof>;
