#include "firmtouch/spline/guide/guided_point.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/curve/expansion.hpp"
#include "firmtouch/spline/guide/arc.hpp"
#include "firmtouch/spline/guide/chain.hpp"
#include "firmtouch/spline/guide/min_cost.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// Less bounds no cost.
constexpr uint32_t kMinWork = 16;
// Units of a point along the curve.
constexpr uint32_t kSlideWork = 4;
// Beyond that squares may overflow, and no guide holds.
constexpr float kMaxPolished_m = 1e9f;
struct Foot {
  uint32_t piece;
  float s;
  CurvePoint at;
  Vec3 r_m;
  float distance2_m2, slope;
};

Foot foot_at(const View& model, Vec3 p_m, uint32_t piece, float s) {
  Foot foot;
  foot.piece = piece;
  foot.s = s;
  foot.at = evaluate_on(model, piece, s);
  foot.r_m = foot.at.x - (p_m - vec3_at(model.pieces()[piece].origin_m));
  foot.distance2_m2 = dot(foot.r_m, foot.r_m);
  foot.slope = dot(foot.r_m, foot.at.d1);
  return foot;
}

// The way down from a foot, by Newton where the curve is nearest there and not farthest.
float way_down(const Foot& foot) {
  const float bend = dot(foot.at.d1, foot.at.d1) + dot(foot.r_m, foot.at.d2);
  float step = bend > 0.0f ? -foot.slope / bend : foot.slope > 0.0f ? -0.5f : 0.5f;
  if (!(step <= 1.0f)) step = 1.0f;
  return step >= -1.0f ? step : -1.0f;
}

// From a place along the curve, while the distance falls.
Foot slide(const GuideView& guide, Vec3 p_m, uint32_t from_piece, float from_s, uint32_t most,
           uint32_t& used) {
  const View& model = guide.model();
  constexpr float kStill = 0x1p-21f;  // shorter steps along the curve end a slide
  const float still_m = kStill * model.head().extent_m;
  Foot best = foot_at(model, p_m, from_piece, from_s);
  used = 1;
  float step = way_down(best);
  while (used < most && best.distance2_m2 < FLT_MAX && (best.slope > 0.0f || best.slope < 0.0f)) {
    float to = best.s + step;
    const bool is_forward = step > 0.0f;
    const float end = is_forward ? 1.0f : -1.0f;
    uint32_t piece = best.piece;
    bool is_over = false;
    if (is_forward ? !(to < 1.0f) : !(to > -1.0f)) {
      to = end;
      if (is_forward ? !(best.s < 1.0f) : !(best.s > -1.0f)) {
        piece = beyond(guide, best.piece, is_forward);
        if (piece == kNoPiece) break;
        to = -end;
        is_over = true;
      }
    }
    ++used;
    const Foot next = foot_at(model, p_m, piece, to);
    if (is_over) {  // over a joint: only where it leads on
      if (!(is_forward ? next.slope < 0.0f : next.slope > 0.0f)) break;
      best = next;
      step = way_down(best);
      continue;
    }
    if (next.distance2_m2 < best.distance2_m2) {
      const float moved = to - best.s, moved_m = moved * math::length(best.at.d1);
      best = next;
      step = way_down(best);
      const bool is_at_end = !(best.s < 1.0f && best.s > -1.0f);
      if (moved_m <= still_m && moved_m >= -still_m && !is_at_end) break;
    } else {  // too far
      step = 0.25f * (to - best.s);
      const float left_m = step * math::length(best.at.d1);
      if (left_m <= still_m && left_m >= -still_m) break;
    }
  }
  return best;
}

// A certified point need not be the foot-point to the last digit: near it the distance hardly
// changes, but the way along the curve does. Newton by the slope alone, which keeps its digits.
Foot polished(const View& model, Vec3 p_m, const Foot& from) {
  constexpr uint32_t kPolishings = 2;
  Foot best = from;
  for (uint32_t turn = 0; turn < kPolishings; ++turn) {
    const float bend = dot(best.at.d1, best.at.d1) + dot(best.r_m, best.at.d2);
    const float to = bend > 0.0f ? best.s - best.slope / bend : best.s;
    const float step = to - best.s;
    const bool is_small = (step > 0.0f && step < 0.125f) || (step < 0.0f && step > -0.125f);
    if (!is_small || !(to > -1.0f && to < 1.0f)) break;
    const Foot next = foot_at(model, p_m, best.piece, to);
    const bool is_better = next.slope * next.slope < best.slope * best.slope;
    if (!is_better || !(next.distance2_m2 <= from.distance2_m2 * (1.0f + 0x1p-20f))) break;
    best = next;
  }
  return best;
}

float clamped(float s) { return s > -1.0f ? (s < 1.0f ? s : 1.0f) : -1.0f; }

Closest as_closest(const View& model, const Foot& foot, const Closest& nearest) {
  const Piece& piece = model.pieces()[foot.piece];
  Closest closest = nearest;  // and its certificate
  closest.distance_m = math::square_root(foot.distance2_m2);
  closest.point_m = vec3_at(piece.origin_m) + foot.at.x;
  const float speed = math::length(foot.at.d1);
  closest.direction = speed > 0.0f ? foot.at.d1 * (1.0f / speed) : Vec3{};
  closest.piece = piece.entity;
  closest.u = piece.middle_u + piece.half_u * foot.s;
  closest.bezier = foot.piece;
  closest.s = foot.s;
  return closest;
}

void put_ends(const GuideView& guide, Vec3 p_m, float arc_m, Followed& followed) {
  const uint32_t chain = chain_of(guide, followed.closest.bezier);
  const uint32_t first = guide.chains()[chain].first_piece, last = end_of(guide, chain) - 1;
  followed.behind_m = arc_m - guide.arcs()[first * guide.intervals()];
  followed.ahead_m = guide.arcs()[(last + 1) * guide.intervals()] - arc_m;
  followed.is_chain_closed = guide.chains()[chain].is_closed != 0;
  if (followed.is_chain_closed) return;
  const float beyond_m = dot(p_m - followed.closest.point_m, followed.closest.direction);
  if (followed.closest.bezier == first && !(followed.closest.s > -1.0f) && beyond_m < 0.0f)
    followed.end = -1;
  if (followed.closest.bezier == last && !(followed.closest.s < 1.0f) && beyond_m > 0.0f)
    followed.end = 1;
}

// Whether the guide comes to the closest point for certain, without a search: what costs less than
// that lies no farther along the curve, before or behind, and there is one point in all that
// stretch to which the distance falls, for its square is convex there. (Of a part of one piece.)
bool comes_to(const GuideView& guide, const Foot& nearest, float lower_m, float weight_m,
              const Following& following, Arcs& arcs) {
  const View& model = guide.model();
  if (following.piece != nearest.piece) return false;
  const float was_m = arcs.at_m(following.piece, following.s);
  const uint32_t interval = arcs.interval();
  const float way_m = arcs.at_m(nearest.piece, nearest.s) - was_m;
  if (arcs.interval() != interval) return false;
  const float beside_m = (math::square_root(nearest.distance2_m2) - lower_m) *
                             (guide.length_m() / weight_m) * (1.0f + 0x1p-18f) +
                         guide.length_m() * 0x1p-22f;
  const float reach_m = ((way_m < 0.0f ? -way_m : way_m) + beside_m) * (1.0f + 0x1p-18f);
  const float off = following.s - nearest.s, size = off < 0.0f ? -off : off;
  const float speed2 = dot(nearest.at.d1, nearest.at.d1);
  if (!(speed2 > 0.0f)) return false;
  const float margin = size + 2.0f * beside_m / math::square_root(speed2);
  float low = (off < 0.0f ? following.s : nearest.s) - margin;
  float high = (off < 0.0f ? nearest.s : following.s) + margin;
  const bool is_first = !(low > -1.0f) && beyond(guide, nearest.piece, false) == kNoPiece;
  const bool is_last = !(high < 1.0f) && beyond(guide, nearest.piece, true) == kNoPiece;
  if (is_first) low = -1.0f;
  if (is_last) high = 1.0f;
  if (!(low >= -1.0f && high <= 1.0f)) return false;
  const bool is_below = is_first || arcs.at_m(nearest.piece, low) <= was_m - reach_m;
  const bool is_above = is_last || arcs.at_m(nearest.piece, high) >= was_m + reach_m;
  if (!is_below || !is_above) return false;
  const CurvePoint at =
      evaluate(model.pieces()[nearest.piece], model.coefficients().data(), nearest.s);
  const Expansion f = expand(at, nearest.r_m, nearest.distance2_m2, nearest.slope, speed2,
                             speed2 + dot(nearest.r_m, nearest.at.d2),
                             model.curve_bends()[nearest.piece], model.head().loss_m);
  return f.min_bend_over(-1.0f, nearest.s - low) > 0.0f &&
         f.min_bend_over(1.0f, high - nearest.s) > 0.0f;
}

// The part of the least cost, and on it where the distance falls no further.
void keep_near(const GuideView& guide, Vec3 p_m, const Hold& hold, uint32_t work,
               const Following& following, Followed& followed) {
  const View& model = guide.model();
  const Closest nearest = followed.closest;
  const uint32_t third = work / (3 * kSlideWork), most = third < kMaxSlides ? third : kMaxSlides;
  const LeastCost least = min_cost(guide, p_m, {hold.weight_m, following.piece, following.s},
                                   nearest, {work - most * kSlideWork});
  query::Certificate& certificate = followed.closest.certificate;
  certificate.steps += least.certificate.steps;
  certificate.work += least.certificate.work;
  certificate.exact = certificate.exact && least.certificate.exact;
  if (!least.is_found) return;
  uint32_t slid = 0;
  const Foot foot = polished(model, p_m, slide(guide, p_m, least.piece, least.s, most, slid));
  certificate.steps += slid;
  certificate.work += kSlideWork * (slid < most ? slid : most);
  const query::Certificate all = certificate;
  const Closest kept = as_closest(model, foot, nearest);
  followed.is_new = !(kept.distance_m <= hold.release_m);
  if (!followed.is_new) followed.closest = kept;  // else it finds itself again by distance alone
  followed.closest.certificate = all;
}

}  // namespace

Followed follow(const GuideView& guide, Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following) {
  const View& model = guide.model();
  if (!(following.piece < model.pieces().size())) following.is_following = false;
  following.s = clamped(following.s);
  const bool was_following = following.is_following;
  const bool is_penalty = was_following && hold.weight_m > 0.0f && budget.work >= kMinWork;
  Followed followed;
  followed.is_new = !was_following;
  const query::Budget first{is_penalty ? budget.work - budget.work / 2 : budget.work,
                            budget.band_m};
  followed.closest = closest_on_curve(model, p_m, first, following.hint);
  Arcs arcs(guide);
  if (followed.closest.distance_m < kMaxPolished_m) {
    const query::Certificate certificate = followed.closest.certificate;
    const Foot foot =
        polished(model, p_m, foot_at(model, p_m, followed.closest.bezier, followed.closest.s));
    followed.closest = as_closest(model, foot, followed.closest);
    const bool is_kept =
        is_penalty && !(certificate.exact &&
                        comes_to(guide, foot, certificate.lower_m, hold.weight_m, following, arcs));
    if (is_kept) keep_near(guide, p_m, hold, budget.work - certificate.work, following, followed);
  }
  const Closest& closest = followed.closest;
  followed.is_held = closest.distance_m <= hold.release_m;
  const float arc_m = arcs.at_m(closest.bezier, closest.s);
  followed.arc = arc_m / guide.length_m();
  if (!followed.is_new) {
    const float was_m = arcs.at_m(following.piece, following.s);
    followed.change_of_arc =
        change_of_arc_m(round_of(guide, following.piece), was_m, closest.bezier, arc_m) /
        guide.length_m();
  }
  put_ends(guide, p_m, arc_m, followed);
  following.piece = closest.bezier;
  following.s = closest.s;
  following.is_following = followed.is_held;
  return followed;
}

void go_on_at_other_end(const GuideView& guide, int end, Vec3 p_m, float distance_m,
                        Following& following) {
  const uint32_t chain = chain_of(guide, following.piece);
  const uint32_t piece = end > 0 ? guide.chains()[chain].first_piece : end_of(guide, chain) - 1;
  const float s = end > 0 ? -1.0f : 1.0f;
  if (!(math::length(p_m - position_of(guide.model(), piece, s)) < distance_m)) return;
  following.piece = piece;
  following.s = s;
}

Vec3 point_at_arc(const GuideView& guide, float arc) {
  const float wanted_m = (arc > 0.0f ? (arc < 1.0f ? arc : 1.0f) : 0.0f) * guide.length_m();
  const uint32_t first = core::last_that(guide.arcs().size() - 1,
                                         [&](uint32_t i) { return guide.arcs()[i] <= wanted_m; });
  const float rise_m = guide.arcs()[first + 1] - guide.arcs()[first];
  const float t = rise_m > 0.0f ? (wanted_m - guide.arcs()[first]) / rise_m : 0.0f;
  const uint32_t intervals = guide.intervals();
  const float s =
      2.0f * (static_cast<float>(first % intervals) + t) / static_cast<float>(intervals) - 1.0f;
  return position_of(guide.model(), first / intervals, clamped(s));
}

}  // namespace firmtouch::spline
