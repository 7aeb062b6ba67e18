#include "firmtouch/curve/guided_point.hpp"

#include <float.h>

#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/arc_penalty.hpp"
#include "firmtouch/curve/run_search.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

// What comparing and pruning lose beside a cost, and what arc positions lose beside the weight: a
// stored one 2^-25, one between two 2^-24 more, their difference 2^-25. A foot lies within 7 u h +
// 3 u d of where it is told along its segment (answer.hpp).
constexpr float kSlack = 0x1p-19f;
constexpr float kArcLoss = 0x1p-22f;
constexpr float kFootLoss = 0x1p-21f;

/// Keeps the segment whose closest point costs least. Parts are left out by distance and by the
/// least penalty of their arc positions together.
class LeastCost {
 public:
  LeastCost(const View& curve, Vec3 p_m, const ArcPenalty& penalty, bool carefully)
      : curve_(curve), p_m_(p_m), penalty_(penalty), carefully_(carefully) {}

  const Foot& best() const { return best_; }
  float cost_m() const { return cost_m_; }
  float reach2_m2() const {
    const float reach_m = cost_m_ * (1.0f + kSlack);
    return reach_m * reach_m;
  }

  /// Result: the segment of the least cost so far, having gone along the curve while that helped.
  uint32_t approach(uint32_t segment) {
    for (uint32_t i = 0; i < kMostJumps; ++i) {
      const float before_m = cost_m_;
      const Foot foot = look_at(segment);
      if (!(cost_m_ < before_m)) break;
      const bool at_first = foot.sample == segment && !(foot.t > 0.0f);
      const bool at_last = foot.sample != segment && !(foot.t > 0.0f);
      if (at_first && segment > 0)
        --segment;
      else if (at_last && segment + 1 < curve_.segment_count())
        ++segment;
      else
        break;
    }
    return segment_of(best_);
  }

  void begin(uint32_t run) { take(run); }

  void take(uint32_t run) {
    struct Cut {
      uint32_t part, size;
    };
    Cut pending[kRunLevels + 2] = {{0, kRunSegments}};
    const uint32_t first_of_run = run * kRunSegments, count = curve_.segment_count();
    for (uint32_t left = 1; left > 0;) {
      const Cut cut = pending[--left];
      const uint32_t level_first = kRunSegments / cut.size - 1;
      const uint32_t first = first_of_run + (cut.part - level_first) * cut.size;
      if (first >= count) continue;
      const uint32_t end = first + cut.size, last = end < count ? end : count;
      if (!may_hold(first, last, curve_.runs()[run].radius[cut.part])) continue;
      if (cut.size == kPartSegments) {
        for (uint32_t segment = first; segment < last; ++segment) (void)look_at(segment);
        continue;
      }
      const uint32_t child = first_child(cut.part), half = cut.size / 2;
      const bool is_second =
          penalty_.previous_arc > curve_.arcs()[first + half < count ? first + half : count];
      pending[left++] = {is_second ? child : child + 1, half};  // the last is taken first
      pending[left++] = {is_second ? child + 1 : child, half};
    }
  }

 private:
  static constexpr uint32_t kMostJumps = 8;

  bool may_hold(uint32_t first, uint32_t last, uint16_t radius) const {
    const float least_m =
        least_penalty_m(penalty_, curve_.arcs()[first], curve_.arcs()[last], curve_.is_closed());
    const float room_m =
        (cost_m_ - least_m) + (cost_m_ + least_m + penalty_.weight_m * 0.125f) * kSlack;
    if (!(room_m > 0.0f)) return false;
    const float limit_m = room_m + radius_m_of(radius);
    const float distance2_m2 =
        chord_distance2(p_m_, vec(curve_.samples()[first]), vec(curve_.samples()[last]));
    return distance2_m2 < limit_m * limit_m;
  }

  Foot look_at(uint32_t segment) {
    const Foot foot = foot_on_segment(curve_, p_m_, segment, carefully_);
    const float cost_m = math::square_root(foot.distance2_m2) +
                         penalty_at_m(penalty_, arc_of(curve_, foot), curve_.is_closed());
    if (cost_m < cost_m_) {
      best_ = foot;
      cost_m_ = cost_m;
    }
    return foot;
  }

  const View& curve_;
  Vec3 p_m_;
  const ArcPenalty penalty_;
  bool carefully_;
  float cost_m_ = 0x1p62f;  // more than any cost that is told
  Foot best_{FLT_MAX, 0, 1, 0.0f};
};

// The segment that holds an arc position: what a cold query begins with.
uint32_t segment_at(const View& curve, float arc) {
  uint32_t first = 0, last = curve.segment_count();
  while (last - first > 1) {
    const uint32_t middle = first + (last - first) / 2;
    if (curve.arcs()[middle] <= arc)
      first = middle;
    else
      last = middle;
  }
  return first;
}

template <class Bound>
Constraint answer(const View& curve, const Bound& bound, Vec3 p_m, const ArcPenalty& penalty,
                  bool carefully, query::Budget budget, query::Hint& hint) {
  LeastCost least(curve, p_m, penalty, carefully);
  const uint32_t from =
      hint.place < curve.segment_count() ? hint.place : segment_at(curve, penalty.previous_arc);
  const uint32_t start = least.approach(from) / kRunSegments;
  const Walk walk = walk_runs(curve, bound, budget.steps, start, least);

  Constraint found;
  found.closest = answer_at(curve, least.best());
  found.cost_m = least.cost_m();
  const float distance_m = found.closest.distance_m;
  const float lost_m =
      distance_m - rounded_down(distance_m, curve.head().longest_half_m, carefully);
  const Head& head = curve.head();
  const float along = kFootLoss * (found.cost_m + head.longest_half_m) / head.length_m;
  float lower_m = found.cost_m * (1.0f - 0x1p-23f) - lost_m - penalty.weight_m * (kArcLoss + along);
  if (!walk.complete && walk.pending_m < lower_m) lower_m = walk.pending_m;
  found.closest.certificate.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  found.closest.certificate.steps = walk.steps;
  found.closest.certificate.exact = walk.complete;
  hint.place = found.closest.segment;
  hint.position_m = p_m;
  hint.lower_m = 0;  // a bound of the cost is none of the distance
  hint.sign = 0;
  return found;
}

// The segment that goes on from the end at which the foot lies; the same where there is none.
uint32_t beyond(const View& curve, const Foot& foot) {
  const uint32_t segment = segment_of(foot), last = curve.segment_count() - 1;
  if (foot.t > 0.0f) return segment;
  if (foot.sample == segment) return segment > 0 ? segment - 1 : curve.is_closed() ? last : 0;
  return segment < last ? segment + 1 : curve.is_closed() ? 0 : last;
}

// Along the curve from the point found, while the distance falls.
void slide(const View& curve, Vec3 p_m, const ArcPenalty& penalty, Closest& closest,
           query::Hint& hint) {
  if (!is_near(p_m)) return;
  const bool carefully = needs_care(curve.head(), p_m);
  Foot best = foot_on_segment(curve, p_m, closest.segment, carefully);
  for (uint32_t i = 0; i < kMostSlides; ++i) {
    const uint32_t segment = beyond(curve, best);
    if (segment == segment_of(best)) break;
    const Foot foot = foot_on_segment(curve, p_m, segment, carefully);
    if (!(foot.distance2_m2 < best.distance2_m2)) break;
    best = foot;
  }
  query::Certificate certificate = closest.certificate;
  // The cost of no point is less: at most this much of it is penalty.
  const float previous = penalty.previous_arc;
  const float most_change = curve.is_closed() ? 0.5f : previous > 0.5f ? previous : 1.0f - previous;
  const float lower_m = certificate.lower_m - penalty.weight_m * most_change * (1.0f + 0x1p-20f);
  certificate.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  closest = answer_at(curve, best);
  closest.certificate = certificate;
  hint.place = closest.segment;
}

}  // namespace

Constraint guided_point(const View& curve, Vec3 p_m, const ArcPenalty& penalty,
                        query::Budget budget, query::Hint& hint) {
  NearBound near_bound;
  if (is_penalty(penalty) && penalty.weight_m <= 0x1p60f) {
    if (near_bound.begin(curve.head(), p_m))
      return answer(curve, near_bound, p_m, penalty, near_bound.needs_care(curve), budget, hint);
    if (is_near(p_m)) {
      FarBound far_bound;
      far_bound.begin(curve.head(), p_m);
      return answer(curve, far_bound, p_m, penalty, true, budget, hint);
    }
  }
  Constraint found;
  found.closest = closest_point(curve, p_m, budget, hint);
  found.cost_m = found.closest.distance_m;
  return found;
}

Followed follow(const View& curve, Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following) {
  Followed followed;
  const ArcPenalty penalty{hold.weight_m, following.arc, following.is_following};
  const query::Budget first{budget.steps > 1 ? budget.steps - 1 : 1, budget.band_m};
  followed.constraint = guided_point(curve, p_m, penalty, first, following.hint);
  followed.closest = followed.constraint.closest;
  if (is_penalty(penalty)) slide(curve, p_m, penalty, followed.closest, following.hint);
  followed.is_held = followed.closest.distance_m <= hold.release_m;
  followed.is_new = !following.is_following;
  if (!followed.is_held && following.is_following) {
    const uint32_t steps = followed.closest.certificate.steps;
    const query::Budget rest{budget.steps > steps ? budget.steps - steps : 1, budget.band_m};
    followed.constraint = guided_point(curve, p_m, {}, rest, following.hint);
    followed.closest = followed.constraint.closest;
    followed.closest.certificate.steps += steps;
    followed.is_held = followed.closest.distance_m <= hold.release_m;
    followed.is_new = true;
  }
  const float arc = followed.closest.arc;
  if (!followed.is_new)
    followed.change_of_arc = change_of_arc(following.arc, arc, curve.is_closed());
  following.arc = arc;
  following.is_following = followed.is_held;
  return followed;
}

}  // namespace firmtouch::curve
