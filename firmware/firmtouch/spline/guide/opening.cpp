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

}  // namespace

GuideOpening::GuideOpening(const View& model, const GuideSections& sections) {
  verdict_ = take_sections(model, sections);
  if (verdict_.ok()) verdict_ = check_chains();
  is_done_ = !verdict_.ok();
}

Verdict GuideOpening::take_sections(const View& model, const GuideSections& sections) {
  view_.arcs_ = core::as_whole_array<float>(sections.arcs);
  view_.chains_ = core::as_whole_array<Chain>(sections.chains);
  const uint32_t pieces = model.pieces().size();
  uint32_t parts = 1;
  while (parts < kMaxArcParts && parts * pieces + 1 < view_.arcs_.size()) parts *= 2;
  if (model.is_surface() || parts * pieces + 1 != view_.arcs_.size())
    return reject(kRuleGuideArcsSize);
  view_.model_ = model;
  view_.parts_ = parts;
  return kPassed;
}

Verdict GuideOpening::check_chains() const {
  if (view_.chains_.empty() || view_.chains_[0].first_piece != 0)
    return reject(kRuleGuideChains, 0);
  for (uint32_t i = 0; i < view_.chains_.size(); ++i) {
    const Chain& chain = view_.chains_[i];
    if (chain.first_piece >= view_.model_.pieces().size() || chain.is_closed > 1 ||
        (i > 0 && chain.first_piece <= view_.chains_[i - 1].first_piece))
      return reject(kRuleGuideChains, i);
  }
  return kPassed;
}

void GuideOpening::work(uint32_t elements) {
  const uint32_t count = view_.arcs_.size() - 1;
  for (uint32_t used = 0; used < elements && !is_done_; ++used) {
    verdict_ = check_part(next_);
    if (verdict_.ok() && next_ % view_.parts_ == 0) verdict_ = check_joint(next_ / view_.parts_);
    ++next_;
    is_done_ = !verdict_.ok() || next_ == count;
  }
}

Verdict GuideOpening::check_part(uint32_t i) const {
  const float from_m = view_.arcs_[i], to_m = view_.arcs_[i + 1];
  const bool is_first_sound = i > 0 || (from_m >= 0.0f && from_m <= 0.0f);
  if (!is_first_sound || !(to_m >= from_m) || !(to_m <= kMaxLength_m))
    return reject(kRuleGuideArcs, i);
  if (i + 2 == view_.arcs_.size() && !(to_m > 0.0f)) return reject(kRuleGuideArcs, i);
  const float step = 2.0f / static_cast<float>(view_.parts_);
  const float low = step * static_cast<float>(i % view_.parts_) - 1.0f;
  const float by_points_m = part_length_m(view_.model_, i / view_.parts_, low, low + step);
  const float off_m = to_m - from_m - by_points_m;
  const float max_m = kShare * by_points_m + kBeside * (to_m + view_.model_.head().extent_m);
  return off_m <= max_m && -off_m <= max_m ? kPassed : reject(kRuleGuideArcLength, i);
}

// The end before a piece, of its own chain.
Verdict GuideOpening::check_joint(uint32_t piece) {
  const core::Span<const Chain> chains = view_.chains_;
  if (chain_ + 1 < chains.size() && chains[chain_ + 1].first_piece == piece) ++chain_;
  uint32_t before = piece - 1;
  if (chains[chain_].first_piece == piece) {
    if (chains[chain_].is_closed == 0) return kPassed;
    before = (chain_ + 1 < chains.size() ? chains[chain_ + 1].first_piece
                                         : view_.model_.pieces().size()) -
             1u;
  }
  const math::Vec3 gap_m =
      position_of(view_.model_, piece, -1.0f) - position_of(view_.model_, before, 1.0f);
  return math::length(gap_m) <= kJoint * view_.model_.head().extent_m
             ? kPassed
             : reject(kRuleGuideJoint, piece);
}

core::Verdict open_guide(const View& model, const GuideSections& sections, GuideView& view) {
  GuideOpening opening(model, sections);
  while (!opening.done()) opening.work(1u << 20);
  view = opening.view();
  return opening.verdict();
}

}  // namespace firmtouch::spline
