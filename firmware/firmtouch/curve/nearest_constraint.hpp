#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::curve {

/// A sample among the N nearest.
struct Neighbour {
  float distance2_m2;
  uint32_t sample;
};

/// Samples that the published way looks at, at most. Figure 5 of the paper goes on to all 2,000;
/// what so many give, guided_point() gives of all segments.
constexpr uint32_t kMaxNearest = 100;

/// What holds the constraint where it was: `weight_m` metres of distance for the whole length of
/// the curve in arc position. Without a previous arc position (a new constraint) the penalty is
/// zero.
struct ArcPenalty {
  float weight_m = 0;
  float previous_arc = 0;
  bool has_previous = false;
};

struct Constraint {
  Closest closest;          // of the candidate with the least cost; `exact`: no point is nearer
  float cost_m = 0;         // distance and penalty
  uint32_t candidates = 0;  // segments looked at, at most twice the samples found
};

/// Point of the curve that a haptic device is tied to, as published: of the segments at the N
/// nearest samples the one of least distance + penalty. Reads the k-d tree of samples (bake
/// --curve-tree). It can miss the closest point where samples lie unevenly: closest_point() cannot.
/// Pre:    `curve` is open. `nearest` is memory for N samples (at most kMaxNearest are used); what
///         it holds is overwritten.
/// Bounds: <= budget.work units and N log N steps of sorting; 3.9 KB of stack; re-entrant;
///         interrupt-safe. Candidates are left out where the work does not suffice.
/// Result: always finite. Equal costs: the first segment. On a closed curve the change of arc is
///         taken the shorter way round. No penalty for a weight that is not positive or a previous
///         arc position outside 0 to 1. As closest_point() without a k-d tree or memory, and for a
///         query that is not finite or beyond 2^60 m. The certificate is that of the distance, not
///         of the cost.
/// Source: Morris 2006, section 2.2. Its printed code swaps the weights of the arc position, which
///         is a (1 - t) + b t.
Constraint nearest_constraint(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                              core::Span<Neighbour> nearest, query::Budget budget);

}  // namespace firmtouch::curve
