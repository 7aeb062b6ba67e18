#include "firmtouch/curve/view.hpp"

#include <float.h>

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
  if (head.reserved[0] != 0 || head.reserved[1] != 0) return reject(203);
  if (head.is_closed > 1) return reject(204);
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.low_m[k] >= -kMaxCoordinate_m && head.low_m[k] <= head.high_m[k] &&
          head.high_m[k] <= kMaxCoordinate_m))
      return reject(208, k);
  if (!same_bits(head.diagonal_m, diagonal_m(head)) || !(head.diagonal_m >= kMinDiagonal_m))
    return reject(209);
  if (!(head.length_m >= head.diagonal_m * 0.5f && head.length_m <= 0x1p60f)) return reject(210);
  return kPassed;
}

}  // namespace

Opening::Opening(const Sections& sections) { open_head(sections); }

void Opening::fail(uint16_t rule, uint32_t element) {
  verdict_ = reject(rule, element);
  stage_ = Stage::kDone;
}

void Opening::open_head(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return fail(201, 0);
  const Head& head = heads[0];
  if (head.sample_count < 2 || head.sample_count > kMaxSamples) return fail(202, 0);
  view_.samples_ = core::as_whole_array<Sample>(s.samples);
  if (view_.samples_.size() != head.sample_count) return fail(205, view_.samples_.size());
  view_.arcs_ = core::as_whole_array<float>(s.arcs);
  if (view_.arcs_.size() != head.sample_count) return fail(206, view_.arcs_.size());
  view_.nodes_ = core::as_whole_array<Node>(s.nodes);
  if (view_.nodes_.size() != head.sample_count) return fail(207, view_.nodes_.size());
  verdict_ = check_head(head);
  if (!verdict_.ok()) return;
  view_.head_ = &head;
  low_ = {FLT_MAX, FLT_MAX, FLT_MAX};
  high_ = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
  stage_ = Stage::kSamples;
}

void Opening::work(uint32_t elements) {
  for (; elements > 0 && stage_ != Stage::kDone; --elements) {
    const Verdict found = stage_ == Stage::kSamples  ? check_sample(next_)
                          : stage_ == Stage::kLength ? check_length(next_)
                                                     : check_node(next_);
    if (!found.ok()) return fail(found.rule, found.element);
    if (++next_ == view_.samples_.size()) next_stage();
  }
}

void Opening::next_stage() {
  next_ = 0;
  if (stage_ == Stage::kSamples) {
    const Verdict ends = check_ends();
    if (!ends.ok()) return fail(ends.rule, ends.element);
    stage_ = Stage::kLength;
  } else {
    stage_ = stage_ == Stage::kLength ? Stage::kNodes : Stage::kDone;
  }
}

Verdict Opening::check_sample(uint32_t i) {
  const float* values = &view_.samples_[i].x_m;
  float* low = &low_.x_m;
  float* high = &high_.x_m;
  for (uint32_t k = 0; k < 3; ++k) {
    if (!(values[k] >= view_.head_->low_m[k] && values[k] <= view_.head_->high_m[k]))
      return reject(211, i);
    if (values[k] < low[k]) low[k] = values[k];
    if (values[k] > high[k]) high[k] = values[k];
  }
  return kPassed;
}

Verdict Opening::check_ends() const {
  const Head& head = *view_.head_;
  const float* low = &low_.x_m;
  const float* high = &high_.x_m;
  for (uint32_t k = 0; k < 3; ++k)
    if (low[k] > head.low_m[k] || high[k] < head.high_m[k]) return reject(212, k);
  const float* first = &view_.samples_[0].x_m;
  const float* last = &view_.samples_[head.sample_count - 1].x_m;
  bool meet = true;
  for (uint32_t k = 0; k < 3; ++k)
    if (first[k] < last[k] || first[k] > last[k]) meet = false;
  return meet == view_.is_closed() ? kPassed : reject(213);
}

Verdict Opening::check_length(uint32_t i) {
  const float arc = view_.arcs_[i];
  if (!(arc >= 0.0f && arc <= 1.0f)) return reject(214, i);
  if (i == 0) return arc > 0.0f ? reject(214, i) : kPassed;
  const Sample& from = view_.samples_[i - 1];
  const float spacing_m = math::length(vec(view_.samples_[i]) - vec(from));
  if (!(spacing_m >= kMinSpacing_m)) return reject(215, i);
  if (!(arc >= view_.arcs_[i - 1])) return reject(216, i);
  const float fraction = spacing_m / view_.head_->length_m;
  travelled_ += fraction < 1.0f ? as_fixed(fraction) : kWhole;
  const uint64_t told = as_fixed(arc);
  const uint64_t apart = travelled_ > told ? travelled_ - told : told - travelled_;
  if (apart > kArcSlack) return reject(217, i);
  if (i + 1 == view_.samples_.size() && arc < 1.0f) return reject(214, i);
  return kPassed;
}

// The order by (coordinate, sample) is strict: a sample that stood in two nodes would have to come
// before itself where their ways part. So nodes in order, as many as samples, hold each once.
Verdict Opening::check_node(uint32_t i) const {
  const uint32_t count = view_.samples_.size(), place = view_.nodes_[i].place;
  const Sample* samples = view_.samples_.data();
  if (sample_of(place) >= count || axis_of(place) > 2) return reject(218, i);
  for (uint32_t at = i; at != 0; at = parent_of(at)) {  // ancestors have passed the line above
    const uint32_t above = view_.nodes_[parent_of(at)].place;
    const bool is_first = (at & 1u) != 0;
    const uint32_t first = is_first ? place : above, second = is_first ? above : place;
    if (!comes_before(samples, axis_of(above), sample_of(first), sample_of(second)))
      return reject(219, i);
  }
  float reach_m = own_reach_m(samples, count, sample_of(place));
  for (uint32_t child = first_child(i); child < first_child(i) + 2 && child < count; ++child)
    if (!(view_.nodes_[child].reach_m <= reach_m)) reach_m = view_.nodes_[child].reach_m;
  return same_bits(view_.nodes_[i].reach_m, reach_m) ? kPassed : reject(220, i);
}

Verdict open(const Sections& sections, View& view) {
  Opening opening(sections);
  while (!opening.done()) opening.work(UINT32_MAX);
  view = opening.view();
  return opening.verdict();
}

}  // namespace firmtouch::curve
