#pragma once
#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/work.hpp"

namespace firmtouch::hull {

struct BaseHullHit {
  bool hit = false;
  float t = 1;
  uint32_t face = 0;
  bool enters = false;
  uint32_t steps = 0;
  bool exact = false;  // the first crossing of the base hull, or certainly none
};

/// First crossing of the segment from `a_m` to `b_m` (mesh frame) with the base hull. Reads only
/// the resident part, so a base hull in fast memory is queried without a read of flash. Bounds: <=
/// budget visits (boxes read); 3.5 KB of stack; re-entrant; callable from an interrupt. Result: no
/// hit and not exact for a segment that is not finite. For a segment that begins outside the
///         base hull: no hit and exact means that it does not meet the mesh; a hit means that it
///         does not meet the mesh before t. A hit is not exact if floats cannot decide a crossing
///         at an edge or almost along a face (t is then its earliest time), or if the budget ran
///         out (t is 0).
/// Error:  exact: t is at most 2^-12 early, and late by no more than mesh::cast_segment() may be.
BaseHullHit cast_base_hull(const BaseHull& base_hull, math::Vec3 a_m, math::Vec3 b_m,
                           query::Budget budget);

/// Winding number of the base hull around a point, from the crossings of a segment to a point
/// outside its box: 0 outside, 1 or more inside. Exact; reads only the resident part. Bounds: <=
/// work.left units; 4 KB of stack; re-entrant; callable
///         from an interrupt.
/// Result: false if the budget ran out or the point is not finite.
bool wind_around(const BaseHull& base_hull, math::Vec3 p_m, query::Work& work, int32_t& winding);

}  // namespace firmtouch::hull
