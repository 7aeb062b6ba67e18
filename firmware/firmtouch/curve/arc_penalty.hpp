#pragma once
// What a change of arc position costs, for .cpp files of this module only.

#include "firmtouch/curve/nearest_constraint.hpp"
#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {

/// A penalty that is known to be one: a positive weight and a previous arc position.
static inline bool is_penalty(const ArcPenalty& penalty) {
  return penalty.has_previous && penalty.weight_m > 0.0f && penalty.previous_arc >= 0.0f &&
         penalty.previous_arc <= 1.0f;
}

/// From one arc position to another: on a closed curve the shorter way round, signed.
static inline float change_of_arc(float from, float to, bool is_closed) {
  const float change = to - from;
  if (!is_closed) return change;
  return change > 0.5f ? change - 1.0f : change < -0.5f ? change + 1.0f : change;
}

/// Pre: is_penalty().
static inline float penalty_at_m(const ArcPenalty& penalty, float arc, bool is_closed) {
  const float change = change_of_arc(penalty.previous_arc, arc, is_closed);
  const float cost_m = (change < 0.0f ? -change : change) * penalty.weight_m;
  return cost_m < 0x1p100f ? cost_m : 0x1p100f;
}

/// Least penalty of a piece of the curve.
static inline float min_penalty_m(const ArcPenalty& penalty, float first_arc, float last_arc,
                                  bool is_closed) {
  if (penalty.previous_arc >= first_arc && penalty.previous_arc <= last_arc) return 0.0f;
  const float first_m = penalty_at_m(penalty, first_arc, is_closed);
  const float last_m = penalty_at_m(penalty, last_arc, is_closed);
  return first_m < last_m ? first_m : last_m;
}

}  // namespace firmtouch::curve
