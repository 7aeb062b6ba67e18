#pragma once
#include <stdint.h>

#include "firmtouch/query/certificate.hpp"
#include "firmtouch/spline/curve/closest_on_curve.hpp"
#include "firmtouch/spline/guide/view.hpp"

namespace firmtouch::spline {

/// What holds a guide where it was: metres of distance for the whole length's change of arc.
struct ArcPenalty {
  float weight_m = 0;  // more than 2^20 lengths counts as that
  uint32_t piece = 0;  // where the guide was
  float s = 0;
};

struct LeastCost {
  uint32_t piece = 0;  // the point that is returned
  float s = 0;
  float distance_m = 0;
  float cost_m = 0;      // distance + penalty
  bool is_found = true;  // false: it is the closest point of all, as passed
  query::Certificate
      certificate;  // lower_m bounds the cost of every point; `exact` says that it meets it
};

/// The point of the least distance + penalty of the change of arc, of all points of the curve;
/// changes are taken the shorter way round where a chain is closed. `nearest` is the answer of
/// closest_point() there, of which the place and the bound are used.
/// Pre:    `guide` is open; penalty.piece is one of its pieces, -1 <= penalty.s <= 1, weight_m > 0;
///         nearest.distance_m <= 1e9.
/// Bounds: <= budget.work units (2 at least), 2 a node read and 8 a point evaluated; and 5 points
///         evaluated. 3 KB of stack; re-entrant; callable from an interrupt.
/// Result: always finite. Equal costs: where the guide was, the closest point, the one found first.
///         `exact` says that cost and bound are within 4e-7 (rational: 1e-6) of the extent, 1e-6 of
///         the weight and 2e-6 of the cost of the truth, by the lengths that are returned.
/// Error:  tests/spline/min_cost_host_test.cpp, against dense sampling in double.
LeastCost min_cost(const GuideView& guide, math::Vec3 p_m, const ArcPenalty& penalty,
                   const Closest& nearest, query::Budget budget);

}  // namespace firmtouch::spline
