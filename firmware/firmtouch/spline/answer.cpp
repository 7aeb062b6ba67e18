#include "firmtouch/spline/answer.hpp"

#include <float.h>

#include "firmtouch/spline/probe_run.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// What float32 loses of a distance: two roundings of the query's differences, three of the squares'
// sum, which the root halves, and one each of root and result.
float lost_m(const Head& head, float distance_m) { return head.loss_m + 5.5f * kUnit * distance_m; }

}  // namespace

void begin_at_first(const View& model, Vec3 p_m, Best& best) {
  const Piece& piece = model.pieces()[0];
  const float* c = model.coefficients().data() + piece.coefficients;
  best.x = vec3_at(c) * (piece.is_rational != 0 ? 1.0f / c[3] : 1.0f);
  const Vec3 r_m = best.x - (p_m - vec3_at(piece.origin_m));
  (void)best.take(dot(r_m, r_m));
  best.node = query::kNowhere;
}

// Five roundings of the sizes involved are lost.
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
  return math::larger(off_m, 0.0f);
}

Closest answer_at(const View& model, const Best& best, uint32_t piece_index, Vec3 direction,
                  const query::Certificate& certificate) {
  const Piece& piece = model.pieces()[piece_index];
  return {best.distance_m,
          vec3_at(piece.origin_m) + best.x,
          direction,
          piece.entity,
          piece.middle_u + piece.half_u * best.s,
          piece.middle_v + piece.half_v * best.t,
          piece_index,
          best.s,
          best.t,
          best.evaluations,
          certificate};
}

query::Certificate certify(const Head& head, Vec3 p_m, const Best& best, const Account& search,
                           float pending_m, const query::Carried& carried, CurveHint& hint) {
  const bool is_complete = search.is_complete();
  float lower_m = best.limit_m < best.distance_m ? best.limit_m : best.distance_m;
  if (!is_complete && pending_m < lower_m) lower_m = pending_m;
  lower_m -= lost_m(head, best.distance_m);
  if (!is_complete && carried.lower_m > lower_m) lower_m = carried.lower_m;
  if (!(lower_m > 0.0f)) lower_m = 0.0f;
  hint.position_m = p_m;
  hint.lower_m = lower_m;
  hint.sign = 0;
  return {lower_m, search.steps(), is_complete, 0, search.work()};
}

Closest answer_beyond(const View& model, Vec3 p_m, CurveHint& hint) {
  const bool is_finite = math::is_finite(p_m);
  Best best(model.head());
  begin_at_first(model, is_finite ? p_m : Vec3{}, best);
  Closest closest = answer_at(model, best, 0, {}, {});
  if (!is_finite) {
    closest.distance_m = FLT_MAX;
    hint.lower_m = 0;
    hint.safe_subtree = query::kNowhere;
    hint.safe_subtree_m = 0;
    return closest;
  }
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate = {closest.distance_m * (1.0f - 8.0f * kUnit), 1, fits, 0, 1};
  hint = CurveHint{};
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  return closest;
}

void add_answer(const Closest& answer, core::Hash& hash) {
  const float values[] = {answer.distance_m,         answer.point_m.x,   answer.point_m.y,
                          answer.point_m.z,          answer.direction.x, answer.direction.y,
                          answer.direction.z,        answer.u,           answer.v,
                          answer.certificate.lower_m};
  for (const float value : values) hash.add(math::bits_of(value));
  hash.add(answer.piece);
  hash.add(answer.certificate.steps);
}

}  // namespace firmtouch::spline
