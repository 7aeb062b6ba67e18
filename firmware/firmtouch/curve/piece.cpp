#include "firmtouch/curve/piece.hpp"

#include "firmtouch/curve/answer.hpp"

namespace firmtouch::curve {
namespace {

using math::Vec3;

constexpr uint32_t kNewtonSteps = 5;
constexpr float kSmallest = 0x1p-12f;  // a cut is not halved below this share of the piece
constexpr uint32_t kMaxPending = 13;   // one for each halving, and the whole
constexpr uint32_t kPieceWork = 6, kCutWork = 10;  // units of a piece, and of each of its cuts

float greatest(float a, float b) { return a < b ? b : a; }
float size_of(float a) { return a < 0.0f ? -a : a; }

struct Best {
  float distance2_m2;
  float t;
};

void offer(float distance2_m2, float t, Best& best) {
  if (distance2_m2 < best.distance2_m2) best = {distance2_m2, t};
}

// A point of the piece as the query sees it, and derivatives.
struct Jet {
  Vec3 off, first, second;
};
[[gnu::noinline]] void jet_at(const Cubic& c, Vec3 v, float t, Jet& jet) {
  jet = {point_at(c, t) - v, first_derivative(c, t), second_derivative(c, t)};
}

// What is known of f, the square of the distance, on a cut of the piece.
struct Bounds {
  float min_m2;   // f is no less
  float bend_m2;  // nor is half its second derivative, in the cut's parameter
  float t;        // of the smallest Bernstein coefficient, on the piece
};

// By Bernstein coefficients: of f, of degree 6, and of f'' / 2 = C' C' + (C - v) C'', of degree 4.
// Rounding of derivatives at both ends costs f'' less than 160 u of |C'| and 500 u of |C - v|, both
// times the chord.
Bounds bounds_of(const Cubic& c, Vec3 v, float chord_m, float t0, float size, Best& best) {
  Jet low, high;
  jet_at(c, v, t0, low), jet_at(c, v, t0 + size, high);
  const Vec3 first = low.first * size, last = high.first * size;
  const Vec3 s0 = low.second * (size * size), s1 = high.second * (size * size);
  const Vec3 q0 = low.off, q1 = q0 + first * (1.0f / 3.0f), q3 = high.off,
             q2 = q3 - last * (1.0f / 3.0f);
  const float q00 = dot(q0, q0), q11 = dot(q1, q1), q22 = dot(q2, q2), q33 = dot(q3, q3);
  offer(q00, t0, best), offer(q33, t0 + size, best);
  const float f[7] = {q00,
                      dot(q0, q1),
                      0.4f * dot(q0, q2) + 0.6f * q11,
                      0.1f * dot(q0, q3) + 0.9f * dot(q1, q2),
                      0.4f * dot(q1, q3) + 0.6f * q22,
                      dot(q2, q3),
                      q33};
  uint32_t at = 0;
  for (uint32_t i = 1; i < 7; ++i) at = f[i] < f[at] ? i : at;
  const Vec3 middle = first + s0 * 0.5f;
  const float bends[5] = {dot(first, first) + dot(q0, s0),
                          dot(first, middle) + 0.25f * (dot(q0, s1) + 3.0f * dot(q1, s0)),
                          (dot(first, last) + 2.0f * dot(middle, middle)) * (1.0f / 3.0f) +
                              0.5f * (dot(q1, s1) + dot(q2, s0)),
                          dot(middle, last) + 0.25f * (dot(q3, s0) + 3.0f * dot(q2, s1)),
                          dot(last, last) + dot(q3, s1)};
  float bend_m2 = bends[0], first2_m2 = greatest(dot(middle, middle), dot(last, last));
  for (const float bend : bends) bend_m2 = bend < bend_m2 ? bend : bend_m2;
  first2_m2 = greatest(first2_m2, dot(first, first));
  const float q_m2 = greatest(greatest(q00, q11), greatest(q22, q33));
  const float lost_m =
      160.0f * math::square_root(first2_m2) + 500.0f * size * math::square_root(q_m2);
  return {f[at] - 5.0f * kUnit * q_m2, bend_m2 - kUnit * chord_m * size * lost_m,
          t0 + size * (static_cast<float>(at) * (1.0f / 6.0f))};
}

// Newton's method from `t`, kept on the cut. Result: f where it ends, and half its derivative
// there; 0 at an end of the cut beyond which f falls.
struct End {
  float distance2_m2, slope_m2, speed2_m2;
};
End refine(const Cubic& c, Vec3 v, float t, float t0, float t1, Best& best) {
  for (uint32_t i = 0;; ++i) {
    Jet jet;
    jet_at(c, v, t, jet);
    const float distance2_m2 = dot(jet.off, jet.off), slope_m2 = dot(jet.off, jet.first);
    const float speed2_m2 = dot(jet.first, jet.first);
    offer(distance2_m2, t, best);
    const float bend_m2 = speed2_m2 + dot(jet.off, jet.second);
    if (!(bend_m2 > 0.0f)) return {distance2_m2, slope_m2, speed2_m2};
    const float next = t - slope_m2 / bend_m2;
    const float kept = next > t0 ? (next < t1 ? next : t1) : t0;
    if (!(kept < t) && !(kept > t)) {
      const bool leads_out = t > t0 ? t >= t1 && slope_m2 < 0.0f : slope_m2 > 0.0f;
      return {distance2_m2, leads_out ? 0.0f : slope_m2, speed2_m2};
    }
    if (i == kNewtonSteps) return {distance2_m2, slope_m2, speed2_m2};
    t = kept;
  }
}

// Where half of f'' is at least `bend_m2`, f(t) - (f'(t) / 2)^2 / bend_m2 is its least value. The
// slope loses 96 u of the chord times distance + chord. Where the distance is small beside chord
// and speed, and f bends by no less than a quarter of the speed, that is worth 27 u of the chord at
// most, which piece_loss_m() holds.
float convex_bound_m(const End& end, float chord_m, float bend_m2) {
  const float distance_m = math::square_root(end.distance2_m2);
  float slope_m2 = size_of(end.slope_m2), share = 2.0f;
  if (!(4.0f * bend_m2 >= end.speed2_m2 && bend_m2 >= 4.0f * end.distance2_m2 &&
        chord_m >= 4.0f * distance_m)) {
    slope_m2 += 96.0f * kUnit * chord_m * (distance_m + chord_m);
    share = 1.0f;
  }
  return math::square_root(
      greatest(end.distance2_m2 - share * slope_m2 * slope_m2 / bend_m2, 0.0f));
}

}  // namespace

PieceFoot foot_on_piece(const View& curve, Vec3 p_m, uint32_t segment, float reach_m,
                        PieceWork& work) {
  const Vec3 v = p_m - curve.sample(segment);
  PieceFoot found{{dot(v, v), segment, segment + 1, 0.0f}, 0.0f, true};
  work.charge(kPieceWork);
  const Cubic c = cubic_of(track_of(curve), segment);
  // Within three quarters of its inner points' distance the piece keeps to its chord.
  const float off2_m2 = greatest(line_distance2(c.c1, c.c3), line_distance2(c.c2, c.c3));
  const float least_m =
      math::square_root(line_distance2(v, c.c3)) - math::square_root(off2_m2) * (0.75f + 0x1p-20f);
  if (least_m >= reach_m) return found;

  const float chord_m = math::length(c.c3);
  Best best{found.foot.distance2_m2, 0.0f};
  struct {
    float t0, size;
  } pending[kMaxPending];
  pending[0] = {0.0f, 1.0f};
  uint32_t left = kMaxCuts;
  for (uint32_t count = 1; count > 0;) {
    if (work.left == 0) {
      found.is_done = false;
      break;
    }
    work.charge(kCutWork);
    const float t0 = pending[--count].t0, size = pending[count].size;
    const Bounds bounds = bounds_of(c, v, chord_m, t0, size, best);
    float lower_m = math::square_root(greatest(bounds.min_m2, 0.0f));
    if (bounds.bend_m2 > 0.0f) {
      const End end = refine(c, v, bounds.t, t0, t0 + size, best);
      lower_m = greatest(lower_m, convex_bound_m(end, chord_m, bounds.bend_m2 / (size * size)));
    }
    const float best_m = math::square_root(best.distance2_m2);
    const bool is_closed = lower_m >= best_m - piece_slack_m(curve.head(), best_m);
    if (is_closed || left == 0 || size <= kSmallest) {
      found.doubt_m = greatest(found.doubt_m, best_m - lower_m);
      continue;
    }
    --left;
    const float half = 0.5f * size, middle = t0 + half;
    const bool is_second = bounds.t > middle;  // the nearer half is taken first
    pending[count++] = {is_second ? t0 : middle, half};
    pending[count++] = {is_second ? middle : t0, half};
  }
  found.foot = best.t > 0.5f ? Foot{best.distance2_m2, segment + 1, segment, 1.0f - best.t}
                             : Foot{best.distance2_m2, segment, segment + 1, best.t};
  return found;
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

PieceFoot any_foot(const View& curve, Vec3 p_m, uint32_t segment, bool compensated,
                   PieceWork& work) {
  if (curve.is_smooth()) return foot_on_piece(curve, p_m, segment, kAnyReach_m, work);
  work.charge(segment_work(compensated));
  return {foot_on_segment(curve, p_m, segment, compensated), 0.0f, true};
}

Closest any_answer(const View& curve, const Foot& foot) {
  return curve.is_smooth() ? answer_on_piece(curve, foot) : answer_at(curve, foot);
}

}  // namespace firmtouch::curve
