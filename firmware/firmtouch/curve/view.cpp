#include "firmtouch/curve/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/curve/derived.hpp"

namespace firmtouch::curve {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

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

Verdict check_head(const Head& head) {
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
  if (head.run_levels < kMinRunLevels || head.run_levels > kMaxRunLevels)
    return reject(kRuleRunLevels);
  const uint32_t grid = wrong_of_grid(head);
  return grid == 0 ? kPassed : reject(kRuleGrid, grid - 1);
}

// Whether a run's box holds the inner Bezier points of a piece.
bool holds_piece(const Head& head, const Track& track, uint32_t segment, const Box& box) {
  const Cubic c = cubic_of(track, segment);
  const float* at_m = &track.samples[segment].x_m;
  const float* first_m = &c.c1.x;
  const float* second_m = &c.c2.x;
  for (uint32_t k = 0; k < 3; ++k) {
    const float low = static_cast<float>(low_of(box.side[k])) + kPointSlack_cells;
    const float high = static_cast<float>(high_of(box.side[k])) - kPointSlack_cells;
    const float first = cells_of(head, at_m[k], first_m[k], k);
    const float second = cells_of(head, at_m[k], second_m[k], k);
    if (!(first >= low && first <= high && second >= low && second <= high)) return false;
  }
  return true;
}

}  // namespace

const query::CheckStage<Opening> Opening::kStages[6] = {
    {&Opening::sample_count, &Opening::check_sample, &Opening::finish_samples},
    {&Opening::sample_count, &Opening::check_length, &Opening::finish_length},
    {&Opening::tree_count, &Opening::check_tree},
    {&Opening::box_count, &Opening::check_box},
    {&Opening::run_count, &Opening::check_run, nullptr, &Opening::run_cost},
    {&Opening::radius_count, &Opening::check_part, nullptr, &Opening::part_cost}};

Opening::Opening(const Sections& sections) { check_.begin(open_head(sections)); }

void Opening::work(uint32_t elements) { check_.work(*this, kStages, elements); }

Verdict Opening::open_head(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  if (head.sample_count < 2 || head.sample_count > kMaxSamples) return reject(kRuleSampleCount);
  view_.samples_ = core::as_whole_array<Sample>(s.samples);
  if (view_.samples_.size() != head.sample_count)
    return reject(kRuleSamplesSize, view_.samples_.size());
  view_.arcs_ = core::as_whole_array<float>(s.arcs);
  if (view_.arcs_.size() != head.sample_count) return reject(kRuleArcsSize, view_.arcs_.size());
  view_.tree_ = core::as_whole_array<uint32_t>(s.tree);
  if (!s.tree.empty() && view_.tree_.size() != head.sample_count)
    return reject(kRuleTreeSize, view_.tree_.size());
  const Verdict of_head = check_head(head);
  if (!of_head.ok()) return of_head;
  const uint32_t runs = run_count_of(head.sample_count, head.run_levels);
  view_.boxes_ = core::as_whole_array<Box>(s.boxes);
  if (view_.boxes_.size() != 2 * runs - 1) return reject(kRuleRunsSize, view_.boxes_.size());
  view_.runs_ = core::as_whole_array<Run>(s.runs);
  if (view_.runs_.size() != runs) return reject(kRuleRunsSize, view_.runs_.size());
  const core::Span<const uint16_t> radii = core::as_whole_array<uint16_t>(s.radii);
  if (radii.size() != runs * (parts_of(head.run_levels) + 1))
    return reject(kRuleRunsSize, radii.size());
  view_.radii_ = radii.data();
  view_.head_ = &head;
  return kPassed;
}

uint32_t Opening::run_cost(uint32_t) const { return part_cost(0); }

// Its segments; a cubic piece costs as much as four straight ones.
uint32_t Opening::part_cost(uint32_t i) const {
  const uint32_t levels = view_.run_levels();
  uint32_t size = run_segments_of(levels);
  for (uint32_t above = i & parts_of(levels); above != 0; above = parent_of(above)) size /= 2;
  return view_.is_smooth() ? 4 * size : size;
}

Verdict Opening::check_sample(uint32_t i) {
  const Head& head = view_.head();
  return seen_.take(&view_.samples_[i].x_m, head.low_m, head.high_m)
             ? kPassed
             : reject(kRuleSampleOutside, i);
}

Verdict Opening::finish_samples() {
  const Head& head = view_.head();
  for (uint32_t k = 0; k < 3; ++k)
    if (!seen_.touches_low(k, head.low_m[k]) || !seen_.touches_high(k, head.high_m[k]))
      return reject(kRuleLooseBox, k);
  const float* first = &view_.samples_[0].x_m;
  const float* last = &view_.samples_[head.sample_count - 1].x_m;
  bool meet = true;
  for (uint32_t k = 0; k < 3; ++k)
    if (first[k] < last[k] || first[k] > last[k]) meet = false;
  return meet == view_.is_closed() ? kPassed : reject(kRuleClosure);
}

Verdict Opening::check_length(uint32_t i) {
  const float arc = view_.arcs_[i];
  if (!(arc >= 0.0f && arc <= 1.0f)) return reject(kRuleArcRange, i);
  if (i == 0) return arc > 0.0f ? reject(kRuleArcRange, i) : kPassed;
  const Sample& from = view_.samples_[i - 1];
  const float spacing_m = math::length(vec(view_.samples_[i]) - vec(from));
  if (!(spacing_m >= kMinSpacing_m)) return reject(kRuleSpacing, i);
  if (!(arc >= view_.arcs_[i - 1])) return reject(kRuleArcOrder, i);
  const float half_m = half_segment_m(from, view_.samples_[i]);
  if (half_m > longest_half_m_) longest_half_m_ = half_m;
  const float fraction = spacing_m / view_.head_->length_m;
  travelled_ += fraction < 1.0f ? as_fixed(fraction) : kWhole;
  const uint64_t reported = as_fixed(arc);
  const uint64_t apart = travelled_ > reported ? travelled_ - reported : reported - travelled_;
  if (apart > kArcSlack) return reject(kRuleArcValue, i);
  if (i + 1 == view_.samples_.size() && arc < 1.0f) return reject(kRuleArcRange, i);
  return kPassed;
}

Verdict Opening::finish_length() {
  return same_bits(longest_half_m_, view_.head_->longest_half_m) ? kPassed
                                                                 : reject(kRuleLongestHalf);
}

// The order by (coordinate, sample) is strict: a sample that stood in two nodes would have to come
// before itself where their ways part. So nodes in order, as many as samples, hold each once.
Verdict Opening::check_tree(uint32_t i) {
  const uint32_t count = view_.samples_.size(), node = view_.tree_[i];
  const Sample* samples = view_.samples_.data();
  if (sample_of(node) >= count || axis_of(node) > 2) return reject(kRuleTreeNode, i);
  for (uint32_t at = i; at != 0; at = parent_of(at)) {  // ancestors have passed the line above
    const uint32_t above = view_.tree_[parent_of(at)];
    const bool is_first = (at & 1u) != 0;
    const uint32_t first = is_first ? node : above, second = is_first ? above : node;
    if (!comes_before(samples, axis_of(above), sample_of(first), sample_of(second)))
      return reject(kRuleTreeOrder, i);
  }
  return kPassed;
}

Verdict Opening::check_box(uint32_t i) {
  const Box& box = view_.boxes_[i];
  const Box& around = view_.boxes_[i == 0 ? 0 : parent_of(i)];
  for (uint32_t k = 0; k < 3; ++k) {
    if (!query::is_axis(box.side[k])) return reject(kRuleBoxRange, i);
    if (!query::holds(around.side[k], box.side[k])) return reject(kRuleBoxNesting, i);
  }
  if (i > 0 || !view_.is_smooth()) return kPassed;
  const uint32_t wrong = wrong_of_root(*view_.head_, box);
  return wrong == 0 ? kPassed : reject(kRuleSmoothMargin, wrong - 1);
}

// leaf -> run inverts run -> leaf, so each run is one leaf.
Verdict Opening::check_run(uint32_t i) {
  const core::Span<const Run> runs = view_.runs_;
  const Run& run = runs[i];
  if (run.run >= runs.size() || runs[run.run].leaf != i) return reject(kRuleRunOrder, i);
  if (run.leaf >= runs.size() || runs[run.leaf].run != i) return reject(kRuleRunOrder, i);
  const uint32_t segments = view_.segment_count();
  const Part whole = part_of(view_.run_levels(), i, 0, segments);
  const Box& box = view_.boxes_[runs.size() - 1 + run.leaf];
  for (uint32_t s = whole.first; s <= whole.last; ++s) {
    const float* at_m = &view_.samples_[s].x_m;
    for (uint32_t k = 0; k < 3; ++k) {
      const float cells = cells_of(*view_.head_, at_m[k], k);
      if (!(cells >= static_cast<float>(low_of(box.side[k])) &&
            cells <= static_cast<float>(high_of(box.side[k]))))
        return reject(kRuleRunBox, s);
    }
  }
  const Track track{view_.samples_.data(), view_.samples_.size(), view_.is_closed()};
  for (uint32_t s = whole.first; view_.is_smooth() && s < whole.last; ++s)
    if (!holds_piece(*view_.head_, track, s, box)) return reject(kRuleRunBox, s);
  return kPassed;
}

Verdict Opening::check_part(uint32_t i) {
  const uint32_t levels = view_.run_levels(), parts = parts_of(levels);
  const uint32_t run = i >> (levels + 1), k = i & parts;
  if (k == parts) return view_.radii_[i] == 0 ? kPassed : reject(kRuleRadiusPadding, run);
  const Part part = part_of(levels, run, k, view_.segment_count());
  const Track track{view_.samples_.data(), view_.samples_.size(), view_.is_closed()};
  const uint16_t radius = part_radius(track, view_.is_smooth(), part.first, part.last);
  return view_.radii_[i] == radius ? kPassed : reject(kRuleRadius, run);
}

Verdict open(const Sections& sections, View& view) {
  Opening opening(sections);
  return query::open_at_once(opening, view);
}

}  // namespace firmtouch::curve
