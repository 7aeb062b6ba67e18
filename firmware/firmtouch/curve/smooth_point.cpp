#include "firmtouch/curve/smooth_point.hpp"

#include "firmtouch/curve/min_cost.hpp"

namespace firmtouch::curve {

Constraint smooth_point(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                        query::Budget budget, Hint& hint) {
  const bool counts = is_penalty(penalty) && penalty.weight_m <= 0x1p60f;
  const ArcPenalty used = counts ? penalty : ArcPenalty{0.0f, 0.0f, true};
  NearBound near_bound;
  if (near_bound.begin(curve.head(), p_m))
    return min_cost<true>(curve, near_bound, p_m, used, false, budget, hint);
  FarBound far_bound;
  far_bound.begin(curve.head(), p_m);
  return min_cost<true>(curve, far_bound, p_m, used, false, budget, hint);
}

}  // namespace firmtouch::curve
