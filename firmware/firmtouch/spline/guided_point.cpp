#include "firmtouch/spline/guided_point.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/arc.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// A cost that is less by so much of the extent is less.
constexpr float kSlack = 0x1p-20f;
// Beyond that squares may overflow, and no guide holds.
constexpr float kMostPolished_m = 1e9f;
// Steps along the curve shorter than that end a slide.
constexpr float kStill = 0x1p-21f;

uint32_t chain_of(const GuideView& guide, uint32_t piece) {
  uint32_t first = 0, last = guide.chains().size();
  while (last - first > 1) {
    const uint32_t middle = first + (last - first) / 2;
    if (guide.chains()[middle].first_piece <= piece)
      first = middle;
    else
      last = middle;
  }
  return first;
}

uint32_t end_of(const GuideView& guide, uint32_t chain) {
  return chain + 1 < guide.chains().size() ? guide.chains()[chain + 1].first_piece
                                           : guide.model().pieces().size();
}

constexpr uint32_t kPolishings = 2;

constexpr uint32_t kNoPiece = UINT32_MAX;

// The piece that goes on from an end of one; kNoPiece where the curve ends.
uint32_t beyond(const GuideView& guide, uint32_t piece, bool is_forward) {
  const uint32_t chain = chain_of(guide, piece);
  const uint32_t first = guide.chains()[chain].first_piece, last = end_of(guide, chain) - 1;
  const bool is_closed = guide.chains()[chain].is_closed != 0;
  if (is_forward) return piece < last ? piece + 1 : is_closed ? first : kNoPiece;
  return piece > first ? piece - 1 : is_closed ? last : kNoPiece;
}

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
  point_of(model, piece, s, foot.at);
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

// From where the guide was along the curve, while the distance falls.
Foot slide(const GuideView& guide, Vec3 p_m, const Following& following, uint32_t most,
           uint32_t& used) {
  const View& model = guide.model();
  const float still_m = kStill * model.head().extent_m;
  Foot best = foot_at(model, p_m, following.piece, following.s);
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

// A certified point need not be the foot-point to the last digit: near it the distance hardly changes,
// but the way along the curve does. Newton by the slope alone, which keeps its digits.
Foot polished(const View& model, Vec3 p_m, const Foot& from) {
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

// The shorter way round where both are on one closed chain.
float change_of_arc(const GuideView& guide, uint32_t from_piece, float from, uint32_t to_piece,
                    float to) {
  const float change = to - from;
  const uint32_t chain = chain_of(guide, to_piece);
  if (guide.chains()[chain].is_closed == 0 || chain_of(guide, from_piece) != chain) return change;
  const float first_m = guide.arcs()[guide.chains()[chain].first_piece * guide.parts()];
  const float last_m = guide.arcs()[end_of(guide, chain) * guide.parts()];
  const float round = (last_m - first_m) / guide.length_m();
  return change > 0.5f * round ? change - round : change < -0.5f * round ? change + round : change;
}

float size_of_change(float change) { return change < 0.0f ? -change : change; }

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
  followed.behind_m = arc_m - guide.arcs()[first * guide.parts()];
  followed.ahead_m = guide.arcs()[(last + 1) * guide.parts()] - arc_m;
  followed.is_chain_closed = guide.chains()[chain].is_closed != 0;
  if (followed.is_chain_closed) return;
  const float beyond_m = dot(p_m - followed.closest.point_m, followed.closest.direction);
  if (followed.closest.bezier == first && !(followed.closest.s > -1.0f) && beyond_m < 0.0f)
    followed.end = -1;
  if (followed.closest.bezier == last && !(followed.closest.s < 1.0f) && beyond_m > 0.0f)
    followed.end = 1;
}

}  // namespace

Followed follow(const GuideView& guide, Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following) {
  const View& model = guide.model();
  if (!(following.piece < model.pieces().size() && following.arc >= 0.0f && following.arc <= 1.0f))
    following.is_following = false;
  following.s = clamped(following.s);
  const bool was_following = following.is_following;
  const bool is_penalty = was_following && hold.weight_m > 0.0f && budget.steps > 2;
  uint32_t slid = 0;
  Foot own{};
  if (is_penalty) {
    const uint32_t half = budget.steps / 2;
    own = slide(guide, p_m, following, half < kMostSlides ? half : kMostSlides, slid);
    own = polished(model, p_m, own);
  }
  Followed followed;
  const query::Budget rest{budget.steps > slid ? budget.steps - slid : 1, budget.band_m};
  Closest nearest = closest_point(model, p_m, rest, following.hint);
  if (nearest.distance_m < kMostPolished_m)
    nearest = as_closest(
        model, polished(model, p_m, foot_at(model, p_m, nearest.bezier, nearest.s)), nearest);
  float arc_m = arc_m_at(guide, nearest.bezier, nearest.s);
  const float length_m = guide.length_m();
  followed.closest = nearest;
  followed.is_new = !was_following;
  if (is_penalty) {
    const float own_arc_m = arc_m_at(guide, own.piece, own.s);
    const float to_own =
        change_of_arc(guide, following.piece, following.arc, own.piece, own_arc_m / length_m);
    const float to_nearest =
        change_of_arc(guide, following.piece, following.arc, nearest.bezier, arc_m / length_m);
    const float own_cost_m =
        math::square_root(own.distance2_m2) + hold.weight_m * size_of_change(to_own);
    const float nearest_cost_m = nearest.distance_m + hold.weight_m * size_of_change(to_nearest);
    if (own_cost_m + kSlack * model.head().extent_m < nearest_cost_m) {
      const Closest kept = as_closest(model, own, nearest);
      if (kept.distance_m <= hold.release_m) {
        followed.closest = kept;
        arc_m = own_arc_m;
      } else {
        followed.is_new = true;  // lets go, and finds itself again by distance alone
      }
    }
  }
  followed.closest.certificate.steps += slid;
  followed.is_held = followed.closest.distance_m <= hold.release_m;
  followed.arc = arc_m / length_m;
  if (!followed.is_new)
    followed.change_of_arc =
        change_of_arc(guide, following.piece, following.arc, followed.closest.bezier, followed.arc);
  put_ends(guide, p_m, arc_m, followed);
  following.piece = followed.closest.bezier;
  following.s = followed.closest.s;
  following.arc = followed.arc;
  following.is_following = followed.is_held;
  return followed;
}

void go_on_at_other_end(const GuideView& guide, int end, Vec3 p_m, float distance_m,
                        Following& following) {
  const uint32_t chain = chain_of(guide, following.piece);
  const uint32_t piece = end > 0 ? guide.chains()[chain].first_piece : end_of(guide, chain) - 1;
  const float s = end > 0 ? -1.0f : 1.0f;
  if (!(math::length(p_m - place_of(guide.model(), piece, s)) < distance_m)) return;
  following.piece = piece;
  following.s = s;
  following.arc = guide.arcs()[(end > 0 ? piece : piece + 1) * guide.parts()] / guide.length_m();
}

Vec3 point_at_arc(const GuideView& guide, float arc) {
  const float wanted_m = (arc > 0.0f ? (arc < 1.0f ? arc : 1.0f) : 0.0f) * guide.length_m();
  uint32_t first = 0, last = guide.arcs().size() - 1;
  while (last - first > 1) {
    const uint32_t middle = first + (last - first) / 2;
    if (guide.arcs()[middle] <= wanted_m)
      first = middle;
    else
      last = middle;
  }
  const float rise_m = guide.arcs()[first + 1] - guide.arcs()[first];
  const float t = rise_m > 0.0f ? (wanted_m - guide.arcs()[first]) / rise_m : 0.0f;
  const uint32_t parts = guide.parts();
  const float s = 2.0f * (static_cast<float>(first % parts) + t) / static_cast<float>(parts) - 1.0f;
  return place_of(guide.model(), first / parts, clamped(s));
}

}  // namespace firmtouch::spline
