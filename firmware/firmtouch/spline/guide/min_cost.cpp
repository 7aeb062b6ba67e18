#include "firmtouch/spline/guide/min_cost.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/guide/search.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

constexpr uint32_t kNoNode = UINT32_MAX;
constexpr float kMaxPerMetre = 0x1p20f;
// What float32 loses of a length along the curve, beside the whole of it.
constexpr float kArcLoss = 0x1p-22f;

Penalty penalty_of(const GuideView& guide, const ArcPenalty& penalised, Arcs& arcs) {
  Penalty penalty;
  const float per_m = penalised.weight_m / guide.length_m();
  penalty.per_m = per_m < kMaxPerMetre ? per_m : kMaxPerMetre;
  penalty.piece = penalised.piece;
  penalty.s = penalised.s;
  penalty.at_m = arcs.at_m(penalised.piece, penalised.s);
  penalty.round = round_of(guide, penalised.piece);
  return penalty;
}

}  // namespace

LeastCost min_cost(const GuideView& guide, Vec3 p_m, const ArcPenalty& penalised,
                   const Closest& nearest, query::Budget budget) {
  const View& model = guide.model();
  const Head& head = model.head();
  Arcs arcs(guide);
  const Penalty penalty = penalty_of(guide, penalised, arcs);
  const float arc_loss_m = penalty.per_m * guide.length_m() * kArcLoss;
  Best best(head);
  best.gap_m += arc_loss_m;

  LeastCost found;

  const CurvePoint kink =
      evaluate(model.pieces()[penalised.piece], model.coefficients().data(), penalised.s);
  const Vec3 r_m = kink.x - (p_m - vec3_at(model.pieces()[penalised.piece].origin_m));
  best.node = kNoNode;
  best.distance2_m2 = dot(r_m, r_m);
  take_cost(best, math::square_root(best.distance2_m2));
  found.piece = penalised.piece;
  found.s = penalised.s;
  const float nearest_cost_m =
      nearest.distance_m + penalty.of(nearest.bezier, arcs.at_m(nearest.bezier, nearest.s));
  if (take_cost(best, nearest_cost_m)) {
    best.distance2_m2 = nearest.distance_m * nearest.distance_m;
    found.piece = nearest.bezier;
    found.s = nearest.s;
    found.is_found = false;
  }

  GuideNodes nodes(guide, p_m, penalty, kink, arcs, nearest.certificate.lower_m, best);
  GuideSearch search(nodes, budget.work > 1 ? budget.work - 1 : 1, best);
  GuideNodes::Range range;
  const uint32_t node = nodes.node_at(penalised.piece, penalised.s, range);
  // What is farther along the curve costs more, for nothing is nearer than the nearest.
  const float reach_m = (best.distance_m - nearest.certificate.lower_m) / penalty.per_m;
  search.run(node, range,
             nodes.node_around(node, reach_m * (1.0f + 0x1p-18f) + guide.length_m() * kArcLoss));

  if (best.node != kNoNode) {
    found.piece = nodes.piece_of(best.node);
    found.s = best.s;
    found.is_found = true;
  }
  found.cost_m = best.distance_m;
  found.distance_m = math::square_root(best.distance2_m2);
  float lower_m = best.limit_m < found.cost_m ? best.limit_m : found.cost_m;
  found.certificate.exact = search.is_complete();
  if (!found.certificate.exact) {
    const float pending_m = search.pending_m(nearest.certificate.lower_m);
    if (pending_m < lower_m) lower_m = pending_m;
  }
  lower_m -= head.loss_m + 5.5f * kUnit * found.cost_m + arc_loss_m;
  if (!(lower_m > nearest.certificate.lower_m)) lower_m = nearest.certificate.lower_m;
  found.certificate.lower_m = lower_m;
  found.certificate.steps = search.steps() + 1;
  found.certificate.work = search.work() + 1;
  return found;
}

}  // namespace firmtouch::spline
