#pragma once
#include <stdint.h>

#include "firmtouch/spline/curve/closest_on_curve.hpp"
#include "firmtouch/spline/guide/view.hpp"

namespace firmtouch::spline {

/// How a guide holds on to a curve.
struct Hold {
  float weight_m = 0;   // metres of distance for the whole length's change of arc; 0: none
  float release_m = 0;  // a deviation beyond this lets go
};

/// What one (tool, guide) pair remembers from tick to tick; the caller owns it. A default one has
/// no previous state.
struct Following {
  CurveHint hint;
  uint32_t piece = 0;  // where on the curve the guide is, where is_following
  float s = 0;
  bool is_following = false;
};

struct Followed {
  Closest closest;          // distance_m is the deviation; lower_m bounds that of the whole curve
  float arc = 0;            // of the point: share of the length of all chains, 0 to 1
  float change_of_arc = 0;  // since the last tick; 0 where the guide is new
  float behind_m = 0;       // along the curve to the first end of its chain, and
  float ahead_m = 0;        // to the last
  bool is_chain_closed = false;
  int end = 0;           // -1: past the first end of an open chain, 1: past the last, 0: beside it
  bool is_new = false;   // no previous state, or let go: found by distance alone
  bool is_held = false;  // the deviation is within release_m
};

/// One tick of a guide. The penalty says on which part of the curve it is: of all points the one of
/// the least distance + penalty of the change of arc, min_cost(). Distance says where on it: from
/// there the guide goes along the curve to where the distance falls no further. Without a penalty
/// it is at the closest point of the whole curve. No lost tick, jump or reset can keep it on a
/// wrong part. Where the point is farther than release_m, or NaN, the guide lets go and
/// takes the closest.
/// Pre:    `guide` is open.
/// Bounds: <= budget.work units (16 for a penalty), at most half of them for the closest point
///         where there is one, kMaxSlides points for the way along; and 14 points evaluated for
///         lengths and for the last digits of the place; stack and reentrancy as closest_point().
/// Result: always finite. lower_m bounds the distance of the whole curve; `exact` says that it
///         meets that of the closest point, and that of no other part a point costs less.
Followed follow(const GuideView& guide, math::Vec3 p_m, const Hold& hold, query::Budget budget,
                Following& following);

/// Points evaluated along the curve in a tick; beyond them the next tick goes on.
constexpr uint32_t kMaxSlides = 24;

/// Goes on at the other end of the open chain on which the guide is, where that is nearer.
/// Pre: is_following, and `end` is the one that it is past.
void go_on_at_other_end(const GuideView& guide, int end, math::Vec3 p_m, float distance_m,
                        Following& following);

/// Point of the curve a share of the length from its beginning: for a hand that goes along it.
math::Vec3 point_at_arc(const GuideView& guide, float arc);

}  // namespace firmtouch::spline
