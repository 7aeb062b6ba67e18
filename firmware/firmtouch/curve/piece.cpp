#include "firmtouch/curve/piece.hpp"

#include <float.h>

#include "firmtouch/curve/answer.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

constexpr uint32_t kNewtonSteps = 4;
constexpr uint32_t kDeepest = 12;  // halves of halves: a 4096th of the piece

// A cut of a piece: its Bezier points as the query sees them, and where on the piece it lies.
struct Cut {
  Vec3 q0, q1, q2, q3;
  float t0, size;
  uint32_t depth;
};

Vec3 middle(Vec3 a, Vec3 b) { return (a + b) * 0.5f; }

void halve(const Cut& cut, Cut& first, Cut& second) {
  const Vec3 a = middle(cut.q0, cut.q1), b = middle(cut.q1, cut.q2), c = middle(cut.q2, cut.q3);
  const Vec3 d = middle(a, b), e = middle(b, c), f = middle(d, e);
  const float size = cut.size * 0.5f;
  first = {cut.q0, a, d, f, cut.t0, size, cut.depth + 1};
  second = {f, e, c, cut.q3, cut.t0 + size, size, cut.depth + 1};
}

struct Best {
  float distance2_m2;
  float t;
};

void offer(const Cubic& c, Vec3 v, float t, Best& best) {
  const Vec3 rest = v - point_at(c, t);
  const float distance2_m2 = dot(rest, rest);
  if (distance2_m2 < best.distance2_m2) best = {distance2_m2, t};
}

// Newton's method from `t`, kept on the piece; every place that it comes by counts.
void refine(const Cubic& c, Vec3 v, float t, Best& best) {
  for (uint32_t i = 0; i < kNewtonSteps; ++i) {
    offer(c, v, t, best);
    const Vec3 off = point_at(c, t) - v, first = first_derivative(c, t);
    const float bent = dot(first, first) + dot(off, second_derivative(c, t));
    if (!(bent > 0.0f)) break;
    const float next = t - dot(off, first) / bent;
    const float kept = next > 0.0f ? (next < 1.0f ? next : 1.0f) : 0.0f;
    if (!(kept < t) && !(kept > t)) return;
    t = kept;
  }
  offer(c, v, t, best);
}

// Distance to the chord of a cut, how far the cut may lie from it, and where on the chord.
struct Chord {
  float distance_m, radius_m, t;
};
Chord chord_of(const Cut& cut) {
  const Vec3 along = cut.q3 - cut.q0;
  const float progress = -dot(cut.q0, along), length2 = dot(along, along);
  const float t = !(progress > 0.0f) ? 0.0f : progress < length2 ? progress / length2 : 1.0f;
  const Vec3 rest = cut.q0 + along * t;
  const float first2 = line_distance2(cut.q1 - cut.q0, along);
  const float second2 = line_distance2(cut.q2 - cut.q0, along);
  // The two inner points have three quarters of the weight at most.
  const float radius_m =
      0.75f * math::square_root(first2 > second2 ? first2 : second2) * (1.0f + 0x1p-20f);
  return {math::square_root(dot(rest, rest)), radius_m, t};
}

}  // namespace

PieceFoot foot_on_piece(const View& curve, Vec3 p_m, uint32_t segment) {
  const Cubic c = cubic_of(track_of(curve), segment);
  const Vec3 v = p_m - curve.sample(segment);
  Best best{dot(v, v), 0.0f};
  offer(c, v, 1.0f, best);
  Cut pending[kDeepest + 2];
  pending[0] = {-v, c.c1 - v, c.c2 - v, c.c3 - v, 0.0f, 1.0f, 0};
  refine(c, v, chord_of(pending[0]).t, best);
  float reach_m = math::square_root(best.distance2_m2), doubt_m = 0;
  uint32_t left = kMaxCuts;
  for (uint32_t count = 1; count > 0;) {
    const Cut cut = pending[--count];
    const Chord chord = chord_of(cut);
    const float lower_m = chord.distance_m - chord.radius_m;
    if (lower_m >= reach_m - piece_slack_m(curve.head(), reach_m)) {
      if (reach_m - lower_m > doubt_m) doubt_m = reach_m - lower_m;
      continue;
    }
    if (left == 0 || cut.depth == kDeepest) {
      offer(c, v, cut.t0 + chord.t * cut.size, best);
      reach_m = math::square_root(best.distance2_m2);
      if (reach_m - lower_m > doubt_m) doubt_m = reach_m - lower_m;
      continue;
    }
    --left;
    // A cut that may hold a nearer point than any before is where Newton's method begins again.
    if (chord.distance_m + chord.radius_m < reach_m) {
      refine(c, v, cut.t0 + chord.t * cut.size, best);
      reach_m = math::square_root(best.distance2_m2);
    }
    const bool is_second = chord.t > 0.5f;
    halve(cut, pending[count + (is_second ? 0 : 1)], pending[count + (is_second ? 1 : 0)]);
    count += 2;
  }
  if (best.t > 0.5f) return {{best.distance2_m2, segment + 1, segment, 1.0f - best.t}, doubt_m};
  return {{best.distance2_m2, segment, segment + 1, best.t}, doubt_m};
}

Closest answer_on_piece(const View& curve, const Foot& foot) {
  Closest closest;
  closest.distance_m = math::square_root(foot.distance2_m2);
  closest.segment = segment_of(foot);
  const Cubic c = cubic_of(track_of(curve), closest.segment);
  const float t = foot.sample < foot.neighbour ? foot.t : 1.0f - foot.t;
  closest.point_m = curve.sample(closest.segment) + point_at(c, t);
  const Vec3 along_m = first_derivative(c, t);
  const float size_m = math::length(along_m), chord_m = math::length(c.c3);
  // Where the curve turns straight back it has no tangent: the chord's then.
  closest.tangent = size_m > 1e-3f * chord_m ? along_m * (1.0f / size_m) : c.c3 * (1.0f / chord_m);
  closest.arc = arc_of(curve, foot);
  return closest;
}

Closest any_answer(const View& curve, const Foot& foot) {
  return curve.is_smooth() ? answer_on_piece(curve, foot) : answer_at(curve, foot);
}

}  // namespace firmtouch::curve
