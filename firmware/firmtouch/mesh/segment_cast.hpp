#pragma once
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::mesh {

// Which triangles a segment crosses is decided without any rounding, also where it passes through
// an edge or a corner, runs within a face or ends on one: as if the whole segment had been moved by
// (e, e^2, e^3) for an infinitely small e > 0. So there is no tolerance and nothing leaks: through an
// edge or a corner that the surface crosses over it is one crossing, where it only touches two or
// none, and along a chain of segments none is told twice or lost at the joints. What a segment
// crosses is the same in both directions.
//
// Of all three: a segment that is not finite crosses nothing and is not exact; one of no length
// crosses nothing. t is within 2^-18 of the truth, mostly within 2^-22; crossings nearer to each
// other may be told in the other order (tests/mesh/segment_host_test.cpp).

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
/// Result: least t; equal t: the lowest triangle in leaf order. Not exact: a crossing may be nearer
///         than the one told, or there where none is told.
Hit cast_segment(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Any crossing, the first that turns up: for whether something is in the way.
/// Bounds: <= budget steps; 2.8 KB of stack; re-entrant; callable from an interrupt.
/// Result: exact where a crossing is told, and where there is certainly none.
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

/// Every crossing, in order of t (equal t: of triangles in leaf order). Where there are more than
/// `room` holds, the first ones are kept and all are counted; no room at all counts them.
/// Bounds: <= budget steps and found * told moves in `buffer`; 2.8 KB of stack; re-entrant; callable
///         from an interrupt.
Crossings all_crossings(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                        core::Span<SurfaceCrossing> buffer);

}  // namespace firmtouch::mesh
