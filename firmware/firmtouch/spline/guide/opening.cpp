#include "firmtouch/spline/guide/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/spline/guide/arc.hpp"

namespace firmtouch::spline {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

constexpr float kMaxLength_m = 1e9f;
constexpr float kJoint = 0x1p-19f;  // of the extent: what two ends of one place may differ by
// A stored length against one by three points: a cusp inside a part costs that much.
constexpr float kShare = 0.0625f, kBeside = 0x1p-18f;

using Stage = query::StageOf<GuideProof>;

}  // namespace

// By three points of a piece, or by many for the first part of one.
const query::CheckStage GuideProof::kStages[1] = {
    Stage::of<&GuideProof::interval_count, &GuideProof::check_interval>(100)};

Verdict GuideProof::take(const View& model, const GuideSections& sections) {
  view.arcs_ = core::as_whole_array<float>(sections.arcs);
  view.chains_ = core::as_whole_array<Chain>(sections.chains);
  const uint32_t pieces = model.pieces().size();
  uint32_t intervals = 1;
  while (intervals < kMaxArcIntervals && intervals * pieces + 1 < view.arcs_.size()) intervals *= 2;
  if (model.is_surface() || intervals * pieces + 1 != view.arcs_.size())
    return reject(kRuleGuideArcsSize);
  view.model_ = model;
  view.intervals_ = intervals;
  return kPassed;
}

Verdict GuideProof::check_head() const {
  if (view.chains_.empty() || view.chains_[0].first_piece != 0) return reject(kRuleGuideChains, 0);
  for (uint32_t i = 0; i < view.chains_.size(); ++i) {
    const Chain& chain = view.chains_[i];
    if (chain.first_piece >= view.model_.pieces().size() || chain.is_closed > 1 ||
        (i > 0 && chain.first_piece <= view.chains_[i - 1].first_piece))
      return reject(kRuleGuideChains, i);
  }
  return kPassed;
}

Verdict GuideProof::check_interval(uint32_t i) {
  const float from_m = view.arcs_[i], to_m = view.arcs_[i + 1];
  const bool is_first_sound = i > 0 || (from_m >= 0.0f && from_m <= 0.0f);
  if (!is_first_sound || !(to_m >= from_m) || !(to_m <= kMaxLength_m))
    return reject(kRuleGuideArcs, i);
  if (i + 2 == view.arcs_.size() && !(to_m > 0.0f)) return reject(kRuleGuideArcs, i);
  const float step = 2.0f / static_cast<float>(view.intervals_);
  const float low = step * static_cast<float>(i % view.intervals_) - 1.0f;
  const float by_points_m = interval_length_m(view.model_, i / view.intervals_, low, low + step);
  const float off_m = to_m - from_m - by_points_m;
  const float max_m = kShare * by_points_m + kBeside * (to_m + view.model_.head().extent_m);
  if (!(off_m <= max_m && -off_m <= max_m)) return reject(kRuleGuideArcLength, i);
  return i % view.intervals_ == 0 ? check_joint(i / view.intervals_) : kPassed;
}

// The end before a piece, of its own chain.
Verdict GuideProof::check_joint(uint32_t piece) {
  const core::Span<const Chain> chains = view.chains_;
  if (chain_ + 1 < chains.size() && chains[chain_ + 1].first_piece == piece) ++chain_;
  uint32_t before = piece - 1;
  if (chains[chain_].first_piece == piece) {
    if (chains[chain_].is_closed == 0) return kPassed;
    before = (chain_ + 1 < chains.size() ? chains[chain_ + 1].first_piece
                                         : view.model_.pieces().size()) -
             1u;
  }
  const math::Vec3 gap_m =
      position_of(view.model_, piece, -1.0f) - position_of(view.model_, before, 1.0f);
  return math::length(gap_m) <= kJoint * view.model_.head().extent_m
             ? kPassed
             : reject(kRuleGuideJoint, piece);
}

}  // namespace firmtouch::spline

template class firmtouch::query::Opening<firmtouch::spline::GuideProof>;
