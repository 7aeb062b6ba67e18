#include "firmtouch/curve/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/curve/derived.hpp"

namespace firmtouch::curve {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;
using math::Vec3;

constexpr uint64_t kWhole = uint64_t{1} << 62;  // the length of the curve, in units of travelled_

// How far a stored arc position may lie from the one that the samples say: a millionth of the
// length. The float sums of open() and the double sums of the baker differ by less than 2^-21.
constexpr uint64_t kArcSlack = kWhole >> 20;

bool same_bits(float a, float b) { return math::bits_of(a) == math::bits_of(b); }

// A fraction of 0 to 1 as an integer of 62 bits, rounded down: sums of it lose nothing.
uint64_t as_fixed(float fraction) {
  const uint32_t bits = math::bits_of(fraction) & 0x7FFFFFFFu;  // an asset may say -0
  const uint32_t exponent = bits >> 23;
  const uint64_t mantissa = (bits & 0x7FFFFFu) | 0x800000u;
  if (exponent >= 88) return mantissa << (exponent - 88);  // 2^-39 and more; 1 has exponent 127
  return exponent < 65 ? 0 : mantissa >> (88 - exponent);
}

uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }
float greatest(float a, float b) { return a < b ? b : a; }

// Whether a run's box holds a sample and, `slack` inside, the inner Bezier points of its piece.
bool holds(const Head& head, const Box& box, const Sample& sample, const Cubic* piece) {
  const float* at_m = &sample.x_m;
  for (uint32_t k = 0; k < 3; ++k) {
    const float low = static_cast<float>(low_of(box.side[k]));
    const float high = static_cast<float>(high_of(box.side[k]));
    const float cells = cells_of(head, at_m[k], k);
    if (!(cells >= low && cells <= high)) return false;
    if (piece == nullptr) continue;
    const float* const off_m[] = {&piece->c1.x, &piece->c2.x};
    for (const float* point : off_m) {
      const float at = cells_of(head, at_m[k], point[k], k);
      if (!(at >= low + kPointSlack_cells && at <= high - kPointSlack_cells)) return false;
    }
  }
  return true;
}

using Stage = query::StageOf<Proof>;

}  // namespace

const query::CheckStage Proof::kStages[6] = {
    Stage::of<&Proof::sample_count, &Proof::check_samples, &Proof::finish_samples>(1),
    Stage::of<&Proof::sample_count, &Proof::check_length, &Proof::finish_lengths>(3),
    Stage::of<&Proof::tree_count, &Proof::check_tree>(8),
    Stage::of<&Proof::box_count, &Proof::check_boxes>(1),
    Stage::of<&Proof::run_count, &Proof::check_runs>(1),
    Stage::of<&Proof::part_count, &Proof::check_part>(50)};

Verdict Proof::take(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  if (head.sample_count < 2 || head.sample_count > kMaxSamples) return reject(kRuleSampleCount);
  view.samples_ = core::as_whole_array<Sample>(s.samples);
  if (view.samples_.size() != head.sample_count)
    return reject(kRuleSamplesSize, view.samples_.size());
  view.arcs_ = core::as_whole_array<float>(s.arcs);
  if (view.arcs_.size() != head.sample_count) return reject(kRuleArcsSize, view.arcs_.size());
  view.tree_ = core::as_whole_array<uint32_t>(s.tree);
  if (!s.tree.empty() && view.tree_.size() != head.sample_count)
    return reject(kRuleTreeSize, view.tree_.size());
  if (head.run_levels < kMinRunLevels || head.run_levels > kMaxRunLevels)
    return reject(kRuleRunLevels);
  const uint32_t runs = run_count_of(head.sample_count, head.run_levels);
  view.boxes_ = core::as_whole_array<Box>(s.boxes);
  if (view.boxes_.size() != 2 * runs - 1) return reject(kRuleRunsSize, view.boxes_.size());
  view.runs_ = core::as_whole_array<Run>(s.runs);
  if (view.runs_.size() != runs) return reject(kRuleRunsSize, view.runs_.size());
  const core::Span<const uint16_t> radii = core::as_whole_array<uint16_t>(s.radii);
  if (radii.size() != runs * (parts_of(head.run_levels) + 1))
    return reject(kRuleRunsSize, radii.size());
  view.radii_ = radii.data();
  view.head_ = &head;
  return kPassed;
}

Verdict Proof::check_head() const {
  const Head& head = view.head();
  if (head.is_smooth > 1) return reject(kRuleSmoothFlag);
  if (head.is_closed > 1) return reject(kRuleClosedFlag);
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.low_m[k] >= -kMaxCoordinate_m && head.low_m[k] <= head.high_m[k] &&
          head.high_m[k] <= kMaxCoordinate_m))
      return reject(kRuleHeadBox, k);
  if (!same_bits(head.diagonal_m, diagonal_m(head)) || !(head.diagonal_m >= kMinDiagonal_m))
    return reject(kRuleDiagonal);
  if (!(head.length_m >= head.diagonal_m * 0.5f && head.length_m <= 0x1p60f))
    return reject(kRuleLength);
  const uint32_t grid = wrong_of_grid(head);
  return grid == 0 ? kPassed : reject(kRuleGrid, grid - 1);
}

Verdict Proof::check_samples(uint32_t first, uint32_t end) {
  const Head& head = view.head();
  const uint32_t inside =
      seen_.take(&view.samples_[first].x_m, end - first, head.low_m, head.high_m);
  return inside == end - first ? kPassed : reject(kRuleSampleOutside, first + inside);
}

Verdict Proof::finish_samples() {
  const Head& head = view.head();
  const uint32_t side = seen_.untouched_side(head.low_m, head.high_m);
  if (side < 6) return reject(kRuleLooseBox, side % 3);
  const float* first = &view.samples_[0].x_m;
  const float* last = &view.samples_[head.sample_count - 1].x_m;
  bool meet = true;
  for (uint32_t k = 0; k < 3; ++k)
    if (first[k] < last[k] || first[k] > last[k]) meet = false;
  return meet == view.is_closed() ? kPassed : reject(kRuleClosure);
}

Verdict Proof::check_length(uint32_t i) {
  const float arc = view.arcs_[i];
  if (!(arc >= 0.0f && arc <= 1.0f)) return reject(kRuleArcRange, i);
  if (i == 0) return arc > 0.0f ? reject(kRuleArcRange, i) : kPassed;
  const Sample& from = view.samples_[i - 1];
  const float spacing_m = math::length(vec(view.samples_[i]) - vec(from));
  if (!(spacing_m >= kMinSpacing_m)) return reject(kRuleSpacing, i);
  if (!(arc >= view.arcs_[i - 1])) return reject(kRuleArcOrder, i);
  const float half_m = half_segment_m(from, view.samples_[i]);
  if (half_m > longest_half_m_) longest_half_m_ = half_m;
  const float fraction = spacing_m / view.head_->length_m;
  travelled_ += fraction < 1.0f ? as_fixed(fraction) : kWhole;
  const uint64_t reported = as_fixed(arc);
  const uint64_t apart = travelled_ > reported ? travelled_ - reported : reported - travelled_;
  if (apart > kArcSlack) return reject(kRuleArcValue, i);
  if (i + 1 == view.samples_.size() && arc < 1.0f) return reject(kRuleArcRange, i);
  return kPassed;
}

Verdict Proof::finish_lengths() {
  return same_bits(longest_half_m_, view.head_->longest_half_m) ? kPassed
                                                                : reject(kRuleLongestHalf);
}

// The order by (coordinate, sample) is strict: a sample that stood in two nodes would have to come
// before itself where their ways part. So nodes in order, as many as samples, hold each once.
Verdict Proof::check_tree(uint32_t first_node, uint32_t end) {
  const uint32_t count = view.samples_.size();
  const Sample* samples = view.samples_.data();
  for (uint32_t i = first_node; i < end; ++i) {
    const uint32_t node = view.tree_[i];
    if (sample_of(node) >= count || axis_of(node) > 2) return reject(kRuleTreeNode, i);
    for (uint32_t at = i; at != 0; at = parent_of(at)) {  // ancestors have passed the line above
      const uint32_t above = view.tree_[parent_of(at)];
      const bool is_first = (at & 1u) != 0;
      const uint32_t first = is_first ? node : above, second = is_first ? above : node;
      if (!comes_before(samples, axis_of(above), sample_of(first), sample_of(second)))
        return reject(kRuleTreeOrder, i);
    }
  }
  return kPassed;
}

Verdict Proof::check_boxes(uint32_t first, uint32_t end) {
  for (uint32_t i = first; i < end; ++i) {
    const Box& box = view.boxes_[i];
    const Box& around = view.boxes_[i == 0 ? 0 : parent_of(i)];
    for (uint32_t k = 0; k < 3; ++k) {
      if (!query::is_axis(box.side[k])) return reject(kRuleBoxRange, i);
      if (!query::holds(around.side[k], box.side[k])) return reject(kRuleBoxNesting, i);
    }
    const uint32_t wrong = i > 0 || !view.is_smooth() ? 0 : wrong_of_root(*view.head_, box);
    if (wrong != 0) return reject(kRuleSmoothMargin, wrong - 1);
  }
  return kPassed;
}

// leaf -> run inverts run -> leaf, so each run is one leaf.
Verdict Proof::check_runs(uint32_t first, uint32_t end) {
  const core::Span<const Run> runs = view.runs_;
  for (uint32_t i = first; i < end; ++i) {
    if (runs[i].run >= runs.size() || runs[runs[i].run].leaf != i) return reject(kRuleRunOrder, i);
    if (runs[i].leaf >= runs.size() || runs[runs[i].leaf].run != i) return reject(kRuleRunOrder, i);
  }
  return kPassed;
}

// A smallest part: it lies in its run's box, and adds to the radii of the parts that hold it.
Verdict Proof::check_part(uint32_t i) {
  const uint32_t segments = view.segment_count(), levels = view.run_levels(), run = i >> levels;
  const uint32_t begin = i * kPartSegments;
  const uint32_t count = begin >= segments ? 0 : least(kPartSegments, segments - begin);
  Vec3 slope[kPartSegments + 1] = {};
  Cubic pieces[kPartSegments] = {};
  const Track track{view.samples_.data(), view.samples_.size(), view.is_closed()};
  for (uint32_t s = 0; view.is_smooth() && count > 0 && s <= count; ++s) {
    slope[s] = slope_at(track, begin + s);
    if (s > 0) pieces[s - 1] = cubic_between(step_m(track, begin + s - 1), slope[s - 1], slope[s]);
  }
  const Box& box = view.boxes_[view.runs_.size() - 1 + view.runs_[run].leaf];
  for (uint32_t s = 0; count > 0 && s <= count; ++s) {
    const Cubic* piece = view.is_smooth() && s < count ? &pieces[s] : nullptr;
    if (!holds(view.head(), box, view.samples_[begin + s], piece))
      return reject(kRuleRunBox, begin + s);
  }
  const uint16_t* radii = view.radii_ + size_t{run} * (parts_of(levels) + 1);
  for (uint32_t level = 0; level <= levels; ++level) {
    const uint32_t rest =
        (1u << (levels - level)) - 1;  // smallest parts in one of this level, less 1
    const uint32_t first = least((i & ~rest) * kPartSegments, segments);
    const uint32_t last = least(first + (rest + 1) * kPartSegments, segments);
    const Vec3 a = vec(view.samples_[first]), along = vec(view.samples_[last]) - a;
    float& max2_m2 = max2_m2_[level];
    for (uint32_t s = 0; s < count; ++s) {
      const Vec3 from = vec(view.samples_[begin + s]) - a;
      max2_m2 = greatest(max2_m2, line_distance2(from, along));
      if (!view.is_smooth()) continue;
      max2_m2 = greatest(max2_m2, line_distance2(from + pieces[s].c1, along));
      max2_m2 = greatest(max2_m2, line_distance2(from + pieces[s].c2, along));
    }
    if ((i & rest) != rest) continue;
    const uint32_t part = (1u << level) - 1 + ((i & ((1u << levels) - 1)) >> (levels - level));
    const uint16_t radius = last > first ? radius_of(max2_m2, along) : uint16_t{0};
    if (radii[part] != radius) return reject(kRuleRadius, run);
    max2_m2 = 0;
  }
  const bool is_end_of_run = ((i + 1) & ((1u << levels) - 1)) == 0;
  return is_end_of_run && radii[parts_of(levels)] != 0 ? reject(kRuleRadiusPadding, run) : kPassed;
}

}  // namespace firmtouch::curve

template class firmtouch::query::Opening<firmtouch::curve::Proof>;
