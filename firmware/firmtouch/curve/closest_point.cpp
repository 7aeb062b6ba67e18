#include "firmtouch/curve/closest_point.hpp"

#include <float.h>

#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/min_cost.hpp"
#include "firmtouch/curve/nearest_foot.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

// Nearer than this share of the diagonal plain floats lose no more than near the curve (answer.hpp:
// at most 5.6 u d + 3.3 u h against 10.5 u h, h half a segment: half the diagonal at most).
constexpr float kPlain = 0.25f;

// On average, between samples.
float spacing_m(const View& curve) {
  return curve.head().length_m / static_cast<float>(curve.segment_count());
}

// Everything except the safe subtree.
[[gnu::always_inline]] inline Closest finish(const View& curve, const Foot& best,
                                             const Traversal& traversal, bool compensated, Vec3 p_m,
                                             Hint& hint) {
  Closest closest = answer_at(curve, best);
  float lower_m = rounded_down(closest.distance_m, curve.head().longest_half_m, compensated);
  if (!traversal.complete && traversal.pending_m < lower_m) lower_m = traversal.pending_m;
  closest.certificate.lower_m = math::larger(lower_m, 0.0f);
  closest.certificate.steps = traversal.steps;
  closest.certificate.work = traversal.work;
  closest.certificate.exact = traversal.complete;
  hint.segment = closest.segment;
  hint.position_m.x = p_m.x;  // one by one: an aggregate would go through the stack
  hint.position_m.y = p_m.y;
  hint.position_m.z = p_m.z;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = 0;
  return closest;
}

// The last bound, less the motion, where the budget ended.
[[gnu::noinline, gnu::cold]] void carry_bound(const Hint& hint, Vec3 p_m, Traversal& traversal) {
  const float carried_m = query::carry(hint, p_m).lower_m;
  if (carried_m > traversal.pending_m) traversal.pending_m = carried_m;
}

// What a search that did not suffice leaves to the next one: units of the budget that are used, and
// the segment of its nearest point.
struct Before {
  uint32_t work = 0, segment = 0;
};

// Without a safe subtree. A warm search begins at the last segment, a cold one with the first
// sample. Rare, so for size.
[[gnu::noinline, gnu::cold]] Closest answer_straight(const View& curve, Vec3 p_m,
                                                     query::Budget budget, const Before& before,
                                                     Hint& hint) {
  const RunBound bound(curve.head(), p_m);
  const bool compensated = bound.is_compensated(curve);
  NearestFoot nearest(curve, p_m, compensated);
  uint32_t start = kNoRun;
  Steps steps(budget);
  bool has_begun = true;
  if (hint.segment < curve.segment_count()) {
    const uint32_t from =
        compensated ? nearest.follow<true>(hint.segment) : nearest.follow<false>(hint.segment);
    start = run_of(from, curve.run_levels());
    has_begun = nearest.begin<false>(start, kNoNode, steps.left) == Ascent::kRun;
  } else {
    nearest.begin_at_first();
  }
  Traversal traversal{steps.allowed, steps.allowed - nearest.charged(), false, 0.0f};
  if (has_begun)
    traversal = bound.is_far ? traverse_runs(curve, bound.far, start, steps, nearest)
                             : traverse_runs(curve, bound.near, start, steps, nearest);
  if (!traversal.complete) {
    carry_bound(hint, p_m, traversal);
    if (before.work != 0) nearest.look_compensated(before.segment);  // it was far
  }
  hint.safe_subtree = query::kNowhere;
  return finish(curve, nearest.best(), traversal, compensated, p_m, hint);
}

// From the last segment up to the last safe subtree if its bound still holds, else to the root,
// which yields the next safe subtree. Result: false if plain floats do not suffice or the query is
// not near.
bool search_near(const View& curve, Vec3 p_m, query::Budget budget, Hint& hint,
                 NearestFoot& nearest, Traversal& traversal) {
  const uint32_t run = run_of(nearest.follow<false>(hint.segment), curve.run_levels());
  const float radius_m = nearest.radius_m();
  traversal.work = 0;
  if (!(radius_m <= kPlain * curve.head().diagonal_m)) return false;
  // The certified distance outside the safe subtree, rounded down as in query::carry().
  const float motion_m = math::length(p_m - hint.position_m) * (1.0f + 8.0f * kUnit);
  const float left_m = (hint.safe_subtree_m - motion_m) * (1.0f - 4.0f * kUnit);
  Steps steps(budget);
  const uint32_t safe_subtree = radius_m <= left_m ? hint.safe_subtree : kNoNode;
  const Ascent ascent = nearest.begin<true>(run, safe_subtree, steps.left);
  traversal.work = steps.allowed - steps.left;
  traversal.steps = traversal.work - nearest.charged();
  traversal.complete = ascent == Ascent::kSafeSubtree;
  hint.safe_subtree_m = left_m;
  if (ascent == Ascent::kSafeSubtree) return true;
  hint.safe_subtree = kNoNode;
  traversal.pending_m = 0.0f;
  const Head& head = curve.head();
  NearBound bound;
  if (!bound.begin(head.grid_low_m, head.cell_m, p_m)) return false;
  if (ascent == Ascent::kSpent) return true;
  traversal = traverse_runs(curve, bound, run, steps, nearest);
  if (traversal.complete && traversal.pending_m > nearest.radius_m() && motion_m <= kBeyond_m)
    nearest.make_safe_subtree(run, motion_m, spacing_m(curve), traversal.pending_m, hint);
  return true;
}

// So far away that the first sample is as near as any other point, to 2^-28.
Closest answer_beyond(const View& curve, Vec3 p_m, Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate = {closest.distance_m * (1.0f - 6.0f * kUnit), 1, fits, 0, 1};
  hint = {{p_m, closest.certificate.lower_m, 0}, 0, query::kNowhere, 0};
  return closest;
}

Closest answer_nothing(const View& curve, Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  closest.distance_m = FLT_MAX;
  hint.lower_m = 0;
  hint.safe_subtree = query::kNowhere;
  return closest;
}

// A function of its own, for size: a query needs the frame of one of them only.
[[gnu::noinline, gnu::cold]] Closest answer_anywhere(const View& curve, Vec3 p_m,
                                                     query::Budget budget, const Before& before,
                                                     Hint& hint) {
  if (!math::is_finite(p_m)) return answer_nothing(curve, hint);
  if (!is_near(p_m)) return answer_beyond(curve, p_m, hint);
  const bool is_left = before.work < budget.work;
  const query::Budget rest{is_left ? budget.work - before.work : 1, budget.band_m};
  Closest closest = curve.is_smooth() ? min_cost(curve, p_m, kNoPenalty, rest, hint).closest
                                      : answer_straight(curve, p_m, rest, before, hint);
  uint32_t& work = closest.certificate.work;
  if (is_left)
    work += before.work;
  else if (work < before.work)
    work = before.work;
  return closest;
}

}  // namespace

Closest closest_point(const View& curve, Vec3 p_m, query::Budget budget, Hint& hint) {
  Before before;
  if (!curve.is_smooth() && hint.segment < curve.segment_count()) {
    NearestFoot nearest(curve, p_m, false);
    Traversal traversal;
    const bool is_answered = search_near(curve, p_m, budget, hint, nearest, traversal);
    if (is_answered && !traversal.complete) carry_bound(hint, p_m, traversal);
    if (is_answered) return finish(curve, nearest.best(), traversal, false, p_m, hint);
    before = {traversal.work, segment_of(nearest.best())};
  }
  return answer_anywhere(curve, p_m, budget, before, hint);
}

void Prober::answer(const View& curve, Vec3 p_m, const query::Budget& budget, core::Hash& hash) {
  const Closest c = closest_point(curve, p_m, budget, hint);
  const float values[] = {c.distance_m, c.point_m.x, c.point_m.y, c.point_m.z,          c.tangent.x,
                          c.tangent.y,  c.tangent.z, c.arc,       c.certificate.lower_m};
  for (const float value : values) hash.add(math::bits_of(value));
  hash.add(c.segment);
  hash.add(c.certificate.steps);
}

uint64_t probe_hash(const View& curve, core::Span<const query::ProbePoint> points,
                    query::Budget budget) {
  return query::hash_of_run<ProbeRun>(curve, points, budget);
}

}  // namespace firmtouch::curve
