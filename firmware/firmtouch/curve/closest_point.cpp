#include "firmtouch/curve/closest_point.hpp"

#include <float.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/curve/answer.hpp"
#include "firmtouch/curve/nearest_foot.hpp"
#include "firmtouch/curve/smooth_point.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

// A warm search begins at the last segment; a cold one knows a point of the curve at once: its
// first sample.
template <bool kCareful, class Bound>
Closest answer(const View& curve, const Bound& bound, Vec3 p_m, query::Budget budget,
               query::Hint& hint) {
  NearestFoot<kCareful> nearest(curve, p_m);
  uint32_t start = kNoRun;
  if (hint.place < curve.segment_count())
    start = nearest.follow(hint.place) / kRunSegments;
  else
    nearest.begin_at_first();
  const Walk walk = walk_runs(curve, bound, budget.steps, start, nearest);

  Closest closest = answer_at(curve, nearest.best());
  float lower_m = rounded_down(closest.distance_m, curve.head().longest_half_m, kCareful);
  if (!walk.complete) {
    const float carried_m = query::carry(hint, p_m).lower_m;
    const float known_m = walk.pending_m > carried_m ? walk.pending_m : carried_m;
    if (known_m < lower_m) lower_m = known_m;
  }
  closest.certificate.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  closest.certificate.steps = walk.steps;
  closest.certificate.exact = walk.complete;
  hint.place = closest.segment;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = 0;
  return closest;
}

// So far away that the first sample is as near as any other point, to 2^-28.
Closest answer_beyond(const View& curve, Vec3 p_m, query::Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate = {closest.distance_m * (1.0f - 6.0f * kUnit), 1, fits, 0};
  hint = {0, p_m, closest.certificate.lower_m, 0};
  return closest;
}

Closest answer_nothing(const View& curve, query::Hint& hint) {
  Closest closest = answer_at(curve, {0.0f, 0, 1, 0.0f});
  closest.distance_m = FLT_MAX;
  hint.lower_m = 0;
  return closest;
}

}  // namespace

Closest closest_point(const View& curve, Vec3 p_m, query::Budget budget, query::Hint& hint) {
  if (curve.is_smooth() && is_near(p_m)) return smooth_point(curve, p_m, {}, budget, hint).closest;
  NearBound near_bound;
  if (near_bound.begin(curve.head(), p_m)) {
    if (!near_bound.needs_care(curve)) return answer<false>(curve, near_bound, p_m, budget, hint);
    return answer<true>(curve, near_bound, p_m, budget, hint);
  }
  if (!math::is_finite(p_m)) return answer_nothing(curve, hint);
  if (!is_near(p_m)) return answer_beyond(curve, p_m, hint);
  FarBound far_bound;
  far_bound.begin(curve.head(), p_m);
  return answer<true>(curve, far_bound, p_m, budget, hint);
}

uint64_t probe_hash(const View& curve, core::Span<const query::ProbePoint> points) {
  core::Hash hash;
  query::Hint hint;
  for (const query::ProbePoint& p : points) {
    const Closest c = closest_point(curve, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint);
    const float values[] = {c.distance_m, c.point_m.x, c.point_m.y,
                            c.point_m.z,  c.tangent.x, c.tangent.y,
                            c.tangent.z,  c.arc,       c.certificate.lower_m};
    for (const float value : values) hash.add(math::bits_of(value));
    hash.add(c.segment);
    hash.add(c.certificate.steps);
  }
  return hash.value();
}

}  // namespace firmtouch::curve
