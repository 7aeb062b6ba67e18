#include "firmtouch/spline/closest_point.hpp"

#include <float.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/query/coherence.hpp"
#include "firmtouch/query/motion.hpp"
#include "firmtouch/spline/curve_search.hpp"
#include "firmtouch/spline/surface_search.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// By how much a part may be nearer than the best and is not looked at, of the extent: what is left of
// 4e-7 and 1e-6 when the losses are taken off.
constexpr float kGap = 1.5f * kUnit, kRationalGap = 4.0f * kUnit;
// A new front of a surface reaches this many of the last motions beyond the nearest point, or so much of the extent.
constexpr float kFrontierMotions = 8.0f, kMinReach = 0x1p-10f;
// Of a curve: so much of the extent beyond it. Of 0.01, 0.015, 0.02 and 0.03 ten planar cubics' paths of
// 0.002 a query took 1,742, 1,726, 1,734 and 1,760 instructions.
constexpr float kSafeSubtreeReach = 0.015f;
// Farther than so many extents all points of a model are as near as any other, to 2^-28.
constexpr float kBeyond = 0x1p28f;

// Where the search knows nothing: the middle of the first piece, which takes no evaluation.
void begin_at_first(const View& model, Vec3 p_m, Best& best) {
  const Piece& piece = model.pieces()[0];
  const float* c = model.coefficients().data() + piece.coefficients;
  best.x = vec3_at(c) * (piece.is_rational != 0 ? 1.0f / c[3] : 1.0f);
  const Vec3 r_m = best.x - (p_m - vec3_at(piece.origin_m));
  (void)best.take(dot(r_m, r_m));
  best.node = query::kNowhere;
}

// Distance to the model's box, rounded down: float32 loses 5 roundings of the sizes involved.
float outside_m(const Head& head, Vec3 p_m) {
  const float at_m[3] = {p_m.x, p_m.y, p_m.z};
  float sum_m2 = 0, size_m = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const float below_m = head.low_m[k] - at_m[k], above_m = at_m[k] - head.high_m[k];
    const float off_m = below_m > above_m ? below_m : above_m;
    if (off_m > 0.0f) sum_m2 += off_m * off_m;
    size_m += head.high_m[k] - head.low_m[k];
  }
  const float off_m = math::square_root(sum_m2) * (1.0f - 0x1p-20f) - size_m * 0x1p-20f;
  return off_m > 0.0f ? off_m : 0.0f;
}

float size_of(float value) { return value < 0.0f ? -value : value; }

// Not of what is no number.
bool is_near(const Head& head, Vec3 p_m) {
  const float max_m = head.extent_m * kBeyond;
  return size_of(p_m.x - head.low_m[0]) <= max_m && size_of(p_m.y - head.low_m[1]) <= max_m &&
         size_of(p_m.z - head.low_m[2]) <= max_m;
}

Vec3 unit_of(Vec3 v) {
  const float most = [&] {
    const float x = v.x < 0.0f ? -v.x : v.x, y = v.y < 0.0f ? -v.y : v.y,
                z = v.z < 0.0f ? -v.z : v.z;
    return x > y ? (x > z ? x : z) : (y > z ? y : z);
  }();
  if (!(most >= 0x1p-100f && most <= 0x1p100f)) return {};
  const Vec3 scaled = v * (1.0f / most);
  return scaled * (1.0f / math::length(scaled));
}

// Along a curve: mostly the short way.
Vec3 tangent_of(Vec3 v) {
  const float length2 = dot(v, v);
  if (!(length2 >= 0x1p-80f && length2 <= 0x1p80f)) return unit_of(v);
  return v * (1.0f / math::square_root(length2));
}

// All but the certificate.
Closest answer_at(const View& model, const Best& best, uint32_t piece_index) {
  const Piece& piece = model.pieces()[piece_index];
  Closest closest;
  closest.distance_m = best.distance_m;
  closest.point_m = vec3_at(piece.origin_m) + best.x;
  closest.direction =
      model.is_surface() ? unit_of(cross(best.along[0], best.along[1])) : tangent_of(best.along[0]);
  closest.piece = piece.entity;
  closest.u = piece.middle_u + piece.half_u * best.s;
  closest.v = piece.middle_v + piece.half_v * best.t;
  closest.bezier = piece_index;
  closest.s = best.s;
  closest.t = best.t;
  closest.evaluations = best.evaluations;
  return closest;
}

// What float32 loses of a distance: two roundings of the query's differences, three of the squares'
// sum (halved by the root) and one each of root and result; the rest is the model's own.
float lost_m(const Head& head, float distance_m) { return head.loss_m + 5.5f * kUnit * distance_m; }

Best best_of(const Head& head) {
  Best best;
  best.gap_m = head.extent_m * (head.is_rational != 0 ? kRationalGap : kGap);
  return best;
}

// What a search leaves: the answer with its certificate, and the hint but for place and fence.
template <class Search>
Closest certified(const View& model, Vec3 p_m, const Search& search, const Best& best,
                  uint32_t piece, const query::Carried& carried, CurveHint& hint) {
  const Head& head = model.head();
  Closest closest = answer_at(model, best, piece);
  float lower_m = best.limit_m < closest.distance_m ? best.limit_m : closest.distance_m;
  const bool is_complete = search.is_complete();
  if (!is_complete) {
    const float pending_m = search.pending_m(outside_m(head, p_m));
    if (pending_m < lower_m) lower_m = pending_m;
  }
  lower_m -= lost_m(head, closest.distance_m);
  if (!is_complete && carried.lower_m > lower_m) lower_m = carried.lower_m;
  closest.certificate.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  closest.certificate.steps = search.steps();
  closest.certificate.exact = is_complete;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = 0;
  return closest;
}

// All of a front is nearer by the motion at most. Four roundings, of what is not larger than either.
void move(const Vec3& p_m, const CurveHint& hint, Frontier& frontier) {
  const float motion_m = query::motion_m(hint, p_m);
  if (!(motion_m <= query::kMaxMotion_m)) {
    FrontierUse(frontier).clear();
    return;
  }
  const float lost_m = __builtin_fabsf(frontier.base_m) + motion_m;
  frontier.base_m = frontier.base_m - motion_m - lost_m * (4.0f * kUnit);
}

// `fence`: what is left in the hint, kWithFrontier where the front is kept too.
Closest answer_surface(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint,
                       Frontier& frontier, uint32_t safe_subtree) {
  const query::Carried carried = query::carry(hint, p_m);
  Best best = best_of(model.head());
  SurfaceSearch search(model, p_m, budget.steps, best);
  if (hint.safe_subtree != kWithFrontier) FrontierUse(frontier).clear();
  move(p_m, hint, frontier);
  uint32_t leaf;
  Rectangle range;
  const bool is_warm = search.resume(hint, leaf, range);
  if (is_warm) {
    const float min_m = kMinReach * model.head().extent_m;
    search.run_warm(leaf, range, math::larger(kFrontierMotions * carried.motion_m, min_m),
                    frontier);
  } else {
    begin_at_first(model, p_m, best);
    search.run_cold(outside_m(model.head(), p_m));
    FrontierUse(frontier).clear();
  }
  const bool is_first = best.node == query::kNowhere;
  const Vec3 motion_m = is_warm ? p_m - hint.position_m : Vec3{};
  const Closest closest =
      certified(model, p_m, search, best, is_first ? 0 : search.piece_of(best.node), carried, hint);
  hint.place = query::kNowhere;
  if (!is_first) search.leave(motion_m, hint);
  hint.safe_subtree = safe_subtree;
  hint.safe_subtree_m = 0.0f;
  return closest;
}

template <bool kFlat>
Closest answer_curve(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  const query::Carried carried = query::carry(hint, p_m);
  Best best = best_of(model.head());
  CurveSearch<kFlat> search(model, p_m, budget.steps, best);
  LeafSafeSubtree safe_subtree{
      {hint.safe_subtree & 0xFFFFu, hint.safe_subtree >> 16},
      carried.is_finite ? query::left_of(hint.safe_subtree_m, carried.motion_m) : 0.0f};
  uint32_t piece;
  float s;
  const bool is_warm = search.resume(hint.place, piece, s);
  if (is_warm) {
    search.run_warm(piece, s, kSafeSubtreeReach * model.head().extent_m, safe_subtree);
  } else {
    begin_at_first(model, p_m, best);
    search.run_cold(outside_m(model.head(), p_m));
    safe_subtree = {{0xFFFFu, 0xFFFFu}, 0.0f};
  }
  const bool is_first = best.node == query::kNowhere;
  const Vec3 motion_m = is_warm ? p_m - hint.position_m : Vec3{};
  const Closest closest =
      certified(model, p_m, search, best, is_first ? 0 : best.node, carried, hint);
  hint.place = is_first ? query::kNowhere : search.place_after(motion_m);
  hint.safe_subtree = safe_subtree.row.first | safe_subtree.row.last << 16;
  hint.safe_subtree_m = safe_subtree.distance_m;
  return closest;
}

Closest answer_beyond(const View& model, Vec3 p_m, CurveHint& hint) {
  Best best;
  begin_at_first(model, p_m, best);
  Closest closest = answer_at(model, best, 0);
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate = {closest.distance_m * (1.0f - 8.0f * kUnit), 1, fits, 0};
  hint = CurveHint{};
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  return closest;
}

Closest answer_nothing(const View& model, CurveHint& hint) {
  Best best;
  begin_at_first(model, {}, best);
  Closest closest = answer_at(model, best, 0);
  closest.distance_m = FLT_MAX;
  hint.lower_m = 0;
  hint.safe_subtree = query::kNowhere;
  hint.safe_subtree_m = 0;
  return closest;
}

[[gnu::always_inline]] inline Closest answer(const View& model, Vec3 p_m, query::Budget budget,
                                             CurveHint& hint, Frontier& frontier,
                                             uint32_t safe_subtree) {
  if (!is_near(model.head(), p_m)) {
    FrontierUse(frontier).clear();
    return math::is_finite(p_m) ? answer_beyond(model, p_m, hint) : answer_nothing(model, hint);
  }
  if (model.is_surface()) return answer_surface(model, p_m, budget, hint, frontier, safe_subtree);
  return model.is_flat() ? answer_curve<true>(model, p_m, budget, hint)
                         : answer_curve<false>(model, p_m, budget, hint);
}

}  // namespace

Closest closest_point(const View& model, Vec3 p_m, query::Budget budget, Hint& hint) {
  return answer(model, p_m, budget, hint, hint.frontier, kWithFrontier);
}

Closest closest_on_curve(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  if (!is_near(model.head(), p_m))
    return math::is_finite(p_m) ? answer_beyond(model, p_m, hint) : answer_nothing(model, hint);
  return model.is_flat() ? answer_curve<true>(model, p_m, budget, hint)
                         : answer_curve<false>(model, p_m, budget, hint);
}

Closest closest_point(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  Frontier frontier;
  return answer(model, p_m, budget, hint, frontier, query::kNowhere);
}

namespace {

void add_answer(const View& model, const query::ProbePoint& p, CurveHint& hint, core::Hash& hash) {
  const Closest c = closest_point(model, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint);
  const float values[] = {c.distance_m,  c.point_m.x,          c.point_m.y,   c.point_m.z,
                          c.direction.x, c.direction.y,        c.direction.z, c.u,
                          c.v,           c.certificate.lower_m};
  for (const float value : values) hash.add(math::bits_of(value));
  hash.add(c.piece);
  hash.add(c.certificate.steps);
}

}  // namespace

void ProbeRun::work(const View& model) {
  if (!done()) add_answer(model, probes_.points[next_++], hint_, hash_);
}

uint64_t probe_hash(const View& model, core::Span<const query::ProbePoint> points) {
  core::Hash hash;
  CurveHint hint;
  for (const query::ProbePoint& p : points) add_answer(model, p, hint, hash);
  return hash.value();
}

}  // namespace firmtouch::spline
