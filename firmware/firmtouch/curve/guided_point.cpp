#include "firmtouch/curve/guided_point.hpp"

#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/arc_penalty.hpp"
#include "firmtouch/curve/min_cost.hpp"
#include "firmtouch/curve/piece.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

// For the nearest point, near which the least cost usually is. Where that takes more, as at the
// centre of a ring, the penalty excludes more.
constexpr uint32_t kNearestWork = 64;

// The segment that goes on from the end at which the foot lies; the same where there is none.
uint32_t beyond(const View& curve, const Foot& foot) {
  const uint32_t segment = segment_of(foot), last = curve.segment_count() - 1;
  if (foot.t > 0.0f) return segment;
  if (foot.sample == segment) return segment > 0 ? segment - 1 : curve.is_closed() ? last : 0;
  return segment < last ? segment + 1 : curve.is_closed() ? 0 : last;
}

// Along the curve from the point found, while the distance falls.
void slide(const View& curve, Vec3 p_m, const ArcPenalty& penalty, uint32_t most_work,
           Closest& closest, Hint& hint) {
  if (!is_near(p_m)) return;
  // It is the nearest point of the whole curve, whose certificate the hint has.
  if (hint.lower_m > 0.0f && closest.segment == hint.segment) {
    closest.certificate.lower_m = hint.lower_m;
    return;
  }
  const bool compensated = is_compensated(curve.head(), p_m);
  PieceWork work{most_work, 0};
  const PieceFoot from = any_foot(curve, p_m, closest.segment, compensated, work);
  Foot best = from.foot;
  bool goes_on = from.is_done, has_moved = curve.is_smooth();  // else it is the foot of `closest`
  const uint32_t most = curve.is_smooth() ? kMaxSmoothSlides : kMaxSlides;
  for (uint32_t i = 0; i < most && goes_on; ++i) {
    const uint32_t segment = beyond(curve, best);
    if (segment == segment_of(best) || work.left == 0) break;
    const PieceFoot next = any_foot(curve, p_m, segment, compensated, work);
    if (!(next.foot.distance2_m2 < best.distance2_m2)) break;
    best = next.foot;
    has_moved = true;
    goes_on = next.is_done;
  }
  query::Certificate certificate = closest.certificate;
  certificate.work += work.charged;
  // The cost of no point is less: at most this much of it is penalty.
  const float previous = penalty.previous_arc;
  const float max_change = curve.is_closed() ? 0.5f : previous > 0.5f ? previous : 1.0f - previous;
  const float lower_m = certificate.lower_m - penalty.weight_m * max_change * (1.0f + 0x1p-20f);
  certificate.lower_m = lower_m > hint.lower_m ? lower_m : hint.lower_m;
  if (from.is_done && has_moved) closest = any_answer(curve, best);
  closest.certificate = certificate;
  hint.segment = closest.segment;
}

// The point of least distance, without a penalty.
[[gnu::noinline]] Constraint nearest_point(const View& curve, Vec3 p_m, query::Budget budget,
                                           Hint& hint) {
  Constraint found;
  found.closest = closest_point(curve, p_m, budget, hint);
  found.cost_m = found.closest.distance_m;
  return found;
}

}  // namespace

Constraint guided_point(const View& curve, Vec3 p_m, const ArcPenalty& penalty,
                        query::Budget budget, Hint& hint) {
  const bool counts = is_penalty(penalty) && penalty.weight_m <= 0x1p60f;
  if ((!counts && !curve.is_smooth()) || !is_near(p_m))
    return nearest_point(curve, p_m, budget, hint);
  query::Certificate before;
  if (!curve.is_smooth() && hint.segment < curve.segment_count() &&
      budget.work > 2 * kNearestWork) {
    Constraint found = nearest_point(curve, p_m, {kNearestWork, budget.band_m}, hint);
    if (min_cost_beside(curve, p_m, penalty, found)) return found;
    before = found.closest.certificate;
    budget.work -= before.work;
  }
  Constraint found = min_cost(curve, p_m, counts ? penalty : kNoPenalty, budget, hint);
  found.closest.certificate.steps += before.steps;
  found.closest.certificate.work += before.work;
  return found;
}

Followed follow(const View& curve, Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following) {
  Followed followed;
  const ArcPenalty penalty{hold.weight_m, following.arc, following.is_following};
  // A quarter is for the way along the curve.
  const bool has_penalty = is_penalty(penalty);
  const uint32_t search = has_penalty ? budget.work - budget.work / 4 : budget.work;
  const query::Budget first{search > 1 ? search - 1 : 1, budget.band_m};
  followed.constraint = guided_point(curve, p_m, penalty, first, following.hint);
  followed.closest = followed.constraint.closest;
  if (has_penalty) {
    // One unit is for the search where it lets go.
    const uint32_t used = followed.closest.certificate.work + 1;
    slide(curve, p_m, penalty, budget.work > used ? budget.work - used : 0, followed.closest,
          following.hint);
  }
  followed.is_held = followed.closest.distance_m <= hold.release_m;
  followed.is_new = !following.is_following;
  if (!followed.is_held && following.is_following) {
    const query::Certificate before = followed.closest.certificate;
    const query::Budget rest{budget.work > before.work ? budget.work - before.work : 1,
                             budget.band_m};
    followed.constraint = guided_point(curve, p_m, {}, rest, following.hint);
    followed.closest = followed.constraint.closest;
    followed.closest.certificate.steps += before.steps;
    followed.closest.certificate.work += before.work;
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
