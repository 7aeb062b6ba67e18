#pragma once
#include <stdint.h>

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/nearest_constraint.hpp"

namespace firmtouch::curve {

/// The point of the curve that a haptic device is tied to: of the closest points of all segments
/// the one of the least distance + penalty, with a certificate. nearest_constraint() looks at the
/// segments of the N nearest samples only.
/// Pre:    `curve` is open.
/// Bounds: <= budget.work units; 1.9 KB of stack, of a smooth curve 2.8 KB; re-entrant; callable
///         from an interrupt.
/// Result: always finite. Equal costs: the one found first. On a closed curve the change of arc is
///         taken the shorter way round. Without a penalty (no previous arc, one outside 0 to 1, a
///         weight that is not positive), or where the query is not finite or beyond 2^60 m: as
///         closest_point(), bit for bit. certificate.lower_m bounds the cost of all segments, and
///         `exact` says that cost and bound are within 4e-7 max(diagonal, distance) and, for
///         the rounding of arc positions, 1e-6 weight_m (1 + cost_m / length) of the truth.
/// Error:  tests/curve/guided_point_host_test.cpp, against every segment in double.
/// Source: Morris 2006, section 2.2, over all segments instead of those at N samples.
Constraint guided_point(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                        query::Budget budget, Hint& hint);

/// Settings of a guide.
struct Hold {
  float weight_m = 0;   // metres of distance for the whole length's change of arc; 0: none
  float release_m = 0;  // a deviation beyond this lets go
};

/// State of one (tool, guide) pair between ticks; the caller owns it. The first query of a default
/// one is not penalised.
struct Following {
  Hint hint;
  float arc = 0;  // of the last point, where is_following
  bool is_following = false;
};

struct Followed {
  Constraint constraint;  // the part of the curve that the guide is on: guided_point()
  // From there along the curve to the closest point near by. Its certificate's lower_m bounds the
  // distance to the whole curve; `exact` is the constraint's, steps are all.
  Closest closest;
  float change_of_arc = 0;  // since the last tick, the shorter way round; 0 where the guide is new
  bool is_new = false;      // no previous state, or let go: found by distance alone
  bool is_held = false;     // the deviation, closest.distance_m, is within release_m
};

/// One tick of a guide. guided_point() from the previous arc position says which part of the curve
/// it is on, and the closest point of that part where it pulls to: a penalty alone would hold the
/// guide back at every sample that it passes, and drag. If the point is farther than release_m or
/// NaN, the guide lets go and searches again by distance alone.
/// Bounds: <= budget.work units (2 at least, in the tick that lets go): with a penalty three
///         quarters for the search, and the rest for the way along the curve.
/// Result: a change of part never raises the distance: what a spring holds is not increased by it.
Followed follow(const View& curve, math::Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following);

/// Segments that follow() goes along the curve in a tick; beyond them the next tick goes on.
constexpr uint32_t kMaxSlides = 32;
constexpr uint32_t kMaxSmoothSlides = 4;  // of cubic pieces

}  // namespace firmtouch::curve
