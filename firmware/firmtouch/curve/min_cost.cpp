#include "firmtouch/curve/min_cost.hpp"

#include "firmtouch/core/bisect.hpp"
#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/arc_penalty.hpp"
#include "firmtouch/curve/piece.hpp"
#include "firmtouch/curve/run_search.hpp"

namespace firmtouch::curve {
namespace {

// What comparing and pruning lose beside a cost, and what arc positions lose beside the weight: a
// stored one 2^-25, one between two 2^-24 more, their difference 2^-25. A foot lies within 7 u h +
// 3 u d of its computed position along the segment (answer.hpp).
constexpr float kSlack = 0x1p-19f;
constexpr float kArcLoss = 0x1p-22f;
constexpr float kFootLoss = 0x1p-21f;

/// Keeps the segment whose closest point costs least. Parts are left out by distance and by the
/// least penalty of their arc positions together.
class LeastCost {
 public:
  LeastCost(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty, bool compensated)
      : curve_(curve), p_m_(p_m), penalty_(penalty), compensated_(compensated) {}

  const Foot& best() const { return best_; }
  uint32_t charged() const { return work_.charged; }
  float doubt_m() const { return doubt_m_; }
  float cost_m() const { return cost_m_; }
  float reach2_m2() const {
    const float reach_m = cost_m_ * (1.0f + kSlack);
    return reach_m * reach_m;
  }

  uint32_t best_at() const { return best_at_; }

  /// Begins with the nearest point, or with the foot on its segment if it is a sample: a foot next
  /// to one may be as near, to the last bit, at another arc position.
  /// Result: the arc position.
  float begin_at(const Closest& nearest) {
    work_.left = UINT32_MAX;
    const float* const arcs = curve_.arcs().data() + nearest.segment;
    if (!(nearest.arc > arcs[0] && nearest.arc < arcs[1])) {
      Foot foot;
      (void)look_at(nearest.segment, foot);
      return arc_of(curve_, foot);
    }
    best_at_ = nearest.segment;
    cost_m_ = nearest.distance_m + penalty_at_m(penalty_, nearest.arc, curve_.is_closed());
    beyond2_m2_ = reach2_m2();
    return nearest.arc;
  }

  /// The segments from there to `end_arc`. Result: false if they are too many.
  bool take_beside(float from_arc, float end_arc) {
    const uint32_t ahead = end_arc > from_arc ? 1 : 0;
    uint32_t segment = best_at_;
    Foot foot;
    for (uint32_t i = 0; i < kMaxBeside; ++i) {
      const uint32_t joint = segment + ahead;
      if (joint == 0 || joint == curve_.segment_count()) return true;
      const float arc = curve_.arcs()[joint];
      if (ahead == 1 ? arc > end_arc : arc < end_arc) return true;
      segment = joint - 1 + ahead;
      (void)look_at(segment, foot);
    }
    return false;
  }

  /// Result: the segment of the least cost so far, having gone along the curve while that helped.
  uint32_t approach(uint32_t segment, uint32_t& left) {
    work_.left = left;
    for (uint32_t i = 0; i < kMaxJumps; ++i) {
      const float before_m = cost_m_;
      Foot foot;
      if (!look_at(segment, foot) || !(cost_m_ < before_m)) break;
      const bool at_first = foot.sample == segment && !(foot.t > 0.0f);
      const bool at_last = foot.sample != segment && !(foot.t > 0.0f);
      if (at_first && segment > 0)
        --segment;
      else if (at_last && segment + 1 < curve_.segment_count())
        ++segment;
      else
        break;
    }
    left = work_.left;
    return segment_of(best_);
  }

  float others_m() const { return 0.0f; }

  /// Result: false where the budget ended.
  bool take(uint32_t run, uint32_t& left) {
    work_.left = left;
    const bool is_done = take(run);
    left = work_.left;
    return is_done;
  }

 private:
  static constexpr uint32_t kMaxJumps = 8;
  static constexpr uint32_t kMaxBeside = 8;  // segments

  bool take(uint32_t run) {
    struct Cut {
      uint32_t part, size, first;
    };
    const uint32_t levels = curve_.run_levels(), whole = run_segments_of(levels);
    const uint16_t* const radii = curve_.radii().data() + (run << (levels + 1));
    const uint32_t count = curve_.segment_count();
    Cut pending[kMaxRunLevels + 1];
    pending[0] = {0, whole, run * whole};
    for (uint32_t left = 1; left > 0;) {
      const Cut cut = pending[--left];
      const uint32_t first = cut.first;
      if (first >= count) continue;
      if (work_.left == 0) return false;
      if (cut.size < whole && cut.size >= kVisitSegments)
        --work_.left;
      else
        work_.charge(1);
      const uint32_t end = first + cut.size, last = end < count ? end : count;
      const bool has_best = best_at_ - first < cut.size;
      if (!has_best && !may_hold(first, last, radii[cut.part])) continue;
      if (cut.size == kPartSegments) {
        Foot foot;
        for (uint32_t segment = first; segment < last; ++segment)
          if (segment != best_at_ && !look_at(segment, foot)) return false;
        continue;
      }
      const uint32_t child = first_child(cut.part), half = cut.size / 2;
      const uint32_t middle = first + half < count ? first + half : count;
      const uint32_t later = penalty_.previous_arc > curve_.arcs()[middle] ? 0 : 1;
      pending[left++] = {child + later, half, first + later * half};
      pending[left++] = {child + 1 - later, half, first + half - later * half};  // taken first
    }
    return true;
  }

  /// Beyond this distance the segments from `first` to `last` cost more than the best.
  float reach_m(uint32_t first, uint32_t last) const {
    const float min_m =
        min_penalty_m(penalty_, curve_.arcs()[first], curve_.arcs()[last], curve_.is_closed());
    return (cost_m_ - min_m) + (cost_m_ + min_m + penalty_.weight_m * 0.125f) * kSlack;
  }

  bool may_hold(uint32_t first, uint32_t last, uint16_t radius) const {
    const float room_m = reach_m(first, last);
    if (!(room_m > 0.0f)) return false;
    const float limit_m = room_m + radius_m_of(radius);
    const float distance2_m2 =
        line_distance2(p_m_ - curve_.sample(first), curve_.sample(last) - curve_.sample(first));
    return distance2_m2 < limit_m * limit_m;
  }

  /// Result: false where the budget ended: what was found counts, and the segment is not done with.
  bool look_at(uint32_t segment, Foot& foot) {
    bool is_done = true;
    foot = foot_on(segment, is_done);
    if (foot.distance2_m2 > beyond2_m2_) return is_done;
    const float cost_m = math::square_root(foot.distance2_m2) +
                         penalty_at_m(penalty_, arc_of(curve_, foot), curve_.is_closed());
    if (cost_m < cost_m_) {
      best_ = foot;
      best_at_ = segment;
      cost_m_ = cost_m;
      beyond2_m2_ = reach2_m2();
    }
    return is_done;
  }

  Foot foot_on(uint32_t segment, bool& is_done) {
    if (curve_.is_smooth()) {
      const PieceFoot found =
          foot_on_piece(curve_, p_m_, segment, reach_m(segment, segment + 1), work_);
      if (found.doubt_m > doubt_m_) doubt_m_ = found.doubt_m;
      is_done = found.is_done;
      return found.foot;
    }
    work_.charge(segment_work(compensated_));
    return foot_on_segment(curve_, p_m_, segment, compensated_);
  }

  const View& curve_;
  math::Vec3 p_m_;
  const ArcPenalty penalty_;
  bool compensated_;
  PieceWork work_{0, 0};
  float doubt_m_ = 0;
  float cost_m_ = 0x1p62f;      // more than any cost
  float beyond2_m2_ = FLT_MAX;  // a foot at more costs more
  Foot best_{FLT_MAX, 0, 1, 0.0f};
  uint32_t best_at_ = UINT32_MAX;  // the segment on which it was found
};

// The segment that holds an arc position: what a cold query begins with.
uint32_t segment_at(const View& curve, float arc) {
  const float* arcs = curve.arcs().data();
  return core::last_that(curve.segment_count(), [=](uint32_t i) { return arcs[i] <= arc; });
}

// Lower bound of the true cost. `found`: the least that was computed; its distance loses `lost_m`.
float rounded_down(const Head& head, const Constraint& found, float weight_m, float lost_m) {
  const float along = kFootLoss * (found.cost_m + head.longest_half_m) / head.length_m;
  return found.cost_m * (1.0f - 0x1p-23f) - lost_m - weight_m * (kArcLoss + along);
}

}  // namespace

// What costs less than the nearest point is no nearer, so its arc position is nearer to the
// previous one, on this side of it or on the other.
bool min_cost_beside(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                     Constraint& found) {
  Closest& closest = found.closest;
  if (!closest.certificate.exact || closest.distance_m > curve.head().diagonal_m * 0.25f)
    return false;
  LeastCost least(curve, p_m, penalty, false);
  const float from_arc = least.begin_at(closest);
  const float end_arc = penalty.previous_arc + (penalty.previous_arc - from_arc);
  const bool is_done = (!curve.is_closed() || (end_arc >= 0.0f && end_arc <= 1.0f)) &&
                       least.take_beside(from_arc, end_arc);
  closest.certificate.work += least.charged();
  if (!is_done) return false;
  const query::Certificate certificate = closest.certificate;
  // Another segment, or on its own a foot beside the sample.
  if (least.best_at() != closest.segment || least.best().t > 0.0f)
    closest = any_answer(curve, least.best());
  found.cost_m = least.cost_m();
  closest.certificate = certificate;
  const Head& head = curve.head();
  const float lost_m =
      closest.distance_m - rounded_down(closest.distance_m, head.longest_half_m, false);
  const float lower_m = rounded_down(head, found, penalty.weight_m, lost_m);
  closest.certificate.lower_m = math::larger(lower_m, 0.0f);
  return true;
}

Constraint min_cost(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                    query::Budget budget, Hint& hint) {
  const RunBound bound(curve.head(), p_m);
  const bool compensated = bound.is_compensated(curve);
  LeastCost least(curve, p_m, penalty, compensated);
  const uint32_t from =
      hint.segment < curve.segment_count() ? hint.segment : segment_at(curve, penalty.previous_arc);
  Steps steps(budget);
  const uint32_t start = run_of(least.approach(from, steps.left), curve.run_levels());
  Traversal traversal{steps.allowed, 0, false, 0.0f};
  if (least.take(start, steps.left))
    traversal = traverse_runs(curve, bound, start, steps, least);
  else
    traversal.steps = steps.allowed - least.charged();

  Constraint found;
  found.closest = any_answer(curve, least.best());
  found.cost_m = least.cost_m();
  const float distance_m = found.closest.distance_m;
  const Head& head = curve.head();
  const float half_m = head.longest_half_m;
  float lost_m = distance_m - rounded_down(distance_m, half_m, compensated);
  // Where a foot is in doubt, so is its arc position, by its piece at most.
  if (curve.is_smooth())
    lost_m = least.doubt_m() + piece_loss_m(distance_m, half_m) +
             penalty.weight_m * (2.0f + 0x1p-18f) * half_m / head.length_m;
  float lower_m = rounded_down(head, found, penalty.weight_m, lost_m);
  if (!traversal.complete && traversal.pending_m < lower_m) lower_m = traversal.pending_m;
  found.closest.certificate.lower_m = math::larger(lower_m, 0.0f);
  found.closest.certificate.steps = traversal.steps;
  found.closest.certificate.work = traversal.work;
  found.closest.certificate.exact =
      traversal.complete && least.doubt_m() <= 2.0f * piece_slack_m(head, distance_m);
  hint.segment = found.closest.segment;
  hint.position_m = p_m;
  hint.lower_m = 0;  // a bound of the cost is none of the distance
  hint.sign = 0;
  hint.safe_subtree = query::kNowhere;
  return found;
}

}  // namespace firmtouch::curve
