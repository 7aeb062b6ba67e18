#include "firmtouch/curve/nearest_constraint.hpp"

#include <float.h>

#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/arc_penalty.hpp"
#include "firmtouch/curve/piece.hpp"
#include "firmtouch/curve/tree_search.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

// Units of a node of the k-d tree with its sample.
constexpr uint32_t kVisitWork = 2;

/// The N nearest samples: a heap with the farthest on top, by (distance, sample).
class NearestSamples {
 public:
  explicit NearestSamples(core::Span<Neighbour> memory)
      : items_(memory.data()),
        capacity_(memory.size() < kMaxNearest ? memory.size() : kMaxNearest) {}

  uint32_t size() const { return size_; }
  Neighbour& operator[](uint32_t i) { return items_[i]; }
  bool is_full() const { return size_ == capacity_; }

  float radius_m() const { return radius_m_; }
  void take(uint32_t sample, Vec3, float distance2_m2) {
    const Neighbour found{distance2_m2, sample};
    if (size_ < capacity_) {
      rise(size_++, found);
    } else if (is_before(found, items_[0])) {
      sink(0, size_, found);
    }
    if (is_full()) radius_m_ = math::square_root(items_[0].distance2_m2) * (1.0f + 0x1p-20f);
  }

  float nearest_m() const {
    float min2_m2 = FLT_MAX;
    for (uint32_t i = 0; i < size_; ++i)
      min2_m2 = items_[i].distance2_m2 < min2_m2 ? items_[i].distance2_m2 : min2_m2;
    return math::square_root(min2_m2);
  }

  /// In the order of the curve, by the same heap: no recursion, no memory.
  void sort_by_sample() {
    for (uint32_t i = 0; i < size_; ++i) items_[i].distance2_m2 = 0.0f;  // ties: by sample
    for (uint32_t i = size_; i-- > 0;) sink(i, size_, items_[i]);
    for (uint32_t last = size_; last-- > 1;) {
      const Neighbour moved = items_[last];
      items_[last] = items_[0];
      sink(0, last, moved);
    }
  }

 private:
  static bool is_before(const Neighbour& a, const Neighbour& b) {
    if (a.distance2_m2 < b.distance2_m2) return true;
    return !(b.distance2_m2 < a.distance2_m2) && a.sample < b.sample;
  }
  void rise(uint32_t i, Neighbour item) {
    for (; i > 0 && is_before(items_[(i - 1) / 2], item); i = (i - 1) / 2)
      items_[i] = items_[(i - 1) / 2];
    items_[i] = item;
  }
  void sink(uint32_t i, uint32_t size, Neighbour item) {
    for (;;) {
      uint32_t child = 2 * i + 1;
      if (child >= size) break;
      if (child + 1 < size && is_before(items_[child], items_[child + 1])) ++child;
      if (!is_before(item, items_[child])) break;
      items_[i] = items_[child];
      i = child;
    }
    items_[i] = item;
  }

  Neighbour* items_;
  uint32_t capacity_;
  uint32_t size_ = 0;
  float radius_m_ = 0x1p62f;  // more than any distance that comes here
};

float penalty_m(const View& curve, const Foot& foot, const ArcPenalty& penalty) {
  if (!is_penalty(penalty)) return 0.0f;
  return penalty_at_m(penalty, arc_of(curve, foot), curve.is_closed());
}

/// The candidates in order; of equal costs the first.
class Choice {
 public:
  Choice(const View& curve, Vec3 p_m, const ArcPenalty& penalty, uint32_t work)
      : curve_(curve),
        p_m_(p_m),
        penalty_(penalty),
        compensated_(is_compensated(curve.head(), p_m)),
        work_{work, 0} {}

  bool compensated() const { return compensated_; }
  uint32_t charged() const { return work_.charged; }
  /// Whether the work sufficed so far. The first candidate is looked at without any.
  bool goes_on() {
    is_cut = is_cut || (work_.left == 0 && candidates != 0);
    return !is_cut;
  }

  void look_at(uint32_t segment) {
    const Foot foot = foot_on(segment);
    const float cost_m = math::square_root(foot.distance2_m2) + penalty_m(curve_, foot, penalty_);
    const float low_m = math::square_root(foot.distance2_m2) - doubt_m_;
    if (foot.distance2_m2 < min2_m2) min2_m2 = foot.distance2_m2;
    if (low_m < min_low_m) min_low_m = low_m;
    if (candidates++ == 0 || cost_m < best_cost_m) best = foot, best_cost_m = cost_m;
  }

  Foot foot_on(uint32_t segment) {
    const PieceFoot found = any_foot(curve_, p_m_, segment, compensated_, work_);
    doubt_m_ = found.doubt_m;
    is_cut = is_cut || !found.is_done;
    return found.foot;
  }

  Foot best{};
  float best_cost_m = 0;
  float min2_m2 = FLT_MAX;    // of all candidates, whatever their penalty
  float min_low_m = FLT_MAX;  // the same, less the doubt of feet on cubic pieces
  uint32_t candidates = 0;
  bool is_cut = false;  // candidates were left out

 private:
  const View& curve_;
  Vec3 p_m_;
  const ArcPenalty& penalty_;
  bool compensated_;
  PieceWork work_;
  float doubt_m_ = 0;
};

}  // namespace

Constraint nearest_constraint(const View& curve, Vec3 p_m, const ArcPenalty& penalty,
                              core::Span<Neighbour> memory, query::Budget budget) {
  Hint none;
  if (!is_near(p_m) || memory.empty() || curve.tree().empty()) {
    const Closest far = closest_point(curve, p_m, budget, none);
    return {far, far.distance_m, 0};
  }
  NearestSamples nearest(memory);
  TreeSearch<NearestSamples> search(curve, p_m, budget.work / kVisitWork, nearest);
  const bool complete = search.run();
  const uint32_t searched = kVisitWork * search.steps();
  const uint32_t left = budget.work > searched ? budget.work - searched : 0;
  const float farthest_m = nearest.is_full() ? math::square_root(nearest[0].distance2_m2) : FLT_MAX;
  const float nearest_m = nearest.nearest_m();
  nearest.sort_by_sample();

  Choice choice(curve, p_m, penalty, left);
  uint32_t next = 0;  // the first segment that was not looked at
  for (uint32_t i = 0; i < nearest.size() && choice.goes_on(); ++i) {
    const uint32_t sample = nearest[i].sample;
    if (sample > 0 && sample - 1 >= next) choice.look_at(sample - 1);
    if (sample < curve.segment_count()) choice.look_at(sample);
    next = sample + 1;
  }

  // A point of the curve that no candidate holds is within a reach of a sample that was not found.
  Constraint found;
  const bool is_smooth = curve.is_smooth();
  const float half_m = curve.head().longest_half_m;
  // A piece's Bezier points lie within a third of its length of its ends.
  const float reach_m = is_smooth ? 2.0f * half_m : half_m;
  found.closest = any_answer(curve, choice.best);
  const float min_m = math::square_root(choice.min2_m2);
  float lower_m = is_smooth ? choice.min_low_m - piece_loss_m(min_m, half_m)
                            : rounded_down(min_m, half_m, choice.compensated());
  const float pending_m = search.pending_m();
  const bool by_budget = !complete && pending_m < farthest_m;
  const float unseen_m = (by_budget ? pending_m : farthest_m) * (1.0f - 0x1p-20f) - reach_m;
  if (nearest.size() < curve.samples().size() && unseen_m < lower_m) lower_m = unseen_m;
  // Nor is any point farther than a reach from the sample that it is nearest to.
  const float left_out_m = nearest_m * (1.0f - 0x1p-20f) - reach_m;
  if (choice.is_cut && left_out_m < lower_m) lower_m = left_out_m;
  found.closest.certificate.lower_m = math::larger(lower_m, 0.0f);
  found.closest.certificate.steps = search.steps();
  const uint32_t used = searched + choice.charged();
  found.closest.certificate.work = used < budget.work ? used : budget.work;
  found.closest.certificate.exact =
      complete && !choice.is_cut &&
      min_m - choice.min_low_m <= 2.0f * piece_slack_m(curve.head(), min_m) &&
      !(choice.best.distance2_m2 > choice.min2_m2) &&
      (nearest.size() == curve.samples().size() || unseen_m >= min_m);
  found.cost_m = choice.best_cost_m;
  found.candidates = choice.candidates;
  return found;
}

}  // namespace firmtouch::curve
