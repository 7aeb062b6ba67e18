#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Pieces from `first_piece` on, up to the next chain's: each begins where the one before ends.
struct Chain {
  uint16_t first_piece;
  uint16_t is_closed;  // 1: the last ends where the first begins
};
static_assert(sizeof(Chain) == 4);

constexpr uint32_t kMaxArcParts = 64;  // of a piece

struct GuideSections {
  core::Bytes arcs, chains;
};

/// A proven model of curves with the lengths along it.
class GuideView {
 public:
  GuideView() = default;
  bool is_open() const { return model_.is_open(); }
  const View& model() const { return model_; }
  float length_m() const { return arcs_[arcs_.size() - 1]; }  // of all chains together
  uint32_t parts() const { return parts_; }                   // of a piece, of equal steps of its s
  /// From the first piece's beginning to each part's.
  core::Span<const float> arcs() const { return arcs_; }
  core::Span<const Chain> chains() const { return chains_; }

 private:
  friend class GuideOpening;
  View model_;
  core::Span<const float> arcs_;
  core::Span<const Chain> chains_;
  uint32_t parts_ = 0;
};

/// Proves in slices: rules R641 to R645 of tools/FORMAT.md.
class GuideOpening {
 public:
  GuideOpening() = default;  // of nothing: done, and no view
  /// Pre: `model` is open.
  GuideOpening(const View& model, const GuideSections& sections);

  /// Checks up to `elements` parts more.
  /// Bounds: about 1,500 instructions an element, the first of each piece at most 10,000; 1 KB of
  /// stack; reads only inside the sections.
  void work(uint32_t elements);
  bool done() const { return is_done_; }
  core::Verdict verdict() const { return verdict_; }
  /// One that is not open unless done() and verdict().ok().
  GuideView view() const { return done() && verdict_.ok() ? view_ : GuideView{}; }

 private:
  core::Verdict take_sections(const View& model, const GuideSections& sections);
  core::Verdict check_chains() const;
  core::Verdict check_part(uint32_t i) const;
  core::Verdict check_joint(uint32_t piece);

  GuideView view_;
  core::Verdict verdict_;
  uint32_t next_ = 0;
  uint32_t chain_ = 0;  // of the piece that is next
  bool is_done_ = true;
};

/// All at once.
core::Verdict open_guide(const View& model, const GuideSections& sections, GuideView& view);

}  // namespace firmtouch::spline
