#pragma once
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::mesh {

// Crossings are decided without rounding, also if the segment passes through an edge or a corner,
// runs within a face or ends on one: as if the whole segment had been moved by (e, e^2, e^3) for an
// infinitely small e > 0. There is no tolerance and no leak. A segment through an edge or a corner
// has one crossing if the surface passes there from one side to the other, else two or none. Along
// a chain of segments no crossing is reported twice or lost at the joints, in either direction.
//
// All three functions: a segment that is not finite crosses nothing and is not exact; one without
// length crosses nothing. t is within 2^-18 of the truth, mostly within 2^-22. Crossings closer
// than that may be reported in the other order (tests/mesh/segment_host_test.cpp).

struct Hit {
  bool hit = false;
  float t = 1;            // of the crossing: 0 at a, 1 at b
  uint32_t triangle = 0;  // in leaf order
  bool enters = false;    // from outside to inside
  uint32_t steps = 0;
  bool exact = false;  // false: the budget ran out before it was certain
};

/// First crossing of the segment from `a_m` to `b_m` (mesh frame) with the surface, either way.
/// Bounds: <= budget steps; 2.8 KB of stack; re-entrant; callable from an interrupt.
/// Result: least t; equal t: the lowest triangle in leaf order. Not exact: there may be a nearer
///         crossing, or one although none is reported.
Hit cast_segment(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Any crossing, the first that is found: to test for an obstacle.
/// Bounds: <= budget steps; 2.8 KB of stack; re-entrant; callable from an interrupt.
/// Result: exact if a crossing is reported, and if there is certainly none.
Hit any_crossing(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

struct SurfaceCrossing {
  float t;
  uint32_t triangle;
  bool enters;
};

struct Crossings {
  uint32_t found = 0;     // all crossings, also those for which there was no room
  uint32_t reported = 0;  // in the caller's span: the smaller of `found` and its size
  uint32_t steps = 0;
  bool exact = false;  // false: the budget ran out; there may be more
};

/// Every crossing, in order of t (equal t: of triangles in leaf order). If there are more than the
/// span holds, the first ones are kept and all are counted; an empty span counts them.
/// Bounds: <= budget steps and found * reported moves; 2.8 KB of stack; re-entrant; callable from
///         an interrupt.
Crossings all_crossings(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                        core::Span<SurfaceCrossing> buffer);

}  // namespace firmtouch::mesh
