#pragma once
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::mesh {

struct Hit {
  bool hit = false;
  float t = 1;            // of the first crossing: 0 at a, 1 at b
  uint32_t triangle = 0;  // in leaf order
  uint32_t steps = 0;
  bool exact = false;  // false: the budget ran out; a crossing nearer than t may have been missed
};

/// First crossing of the segment from `a_m` to `b_m` (mesh frame) with the surface, either side.
/// Watertight: the two triangles of an edge compute the same number for its side, with opposite
/// signs, so that no segment slips between them. No absolute tolerance.
/// Bounds: <= budget steps; 500 B of stack; re-entrant; callable from an interrupt.
/// Result: a segment that is not finite, or farther than 1e9 m from the origin, hits nothing and is
///         not exact; one of no length hits nothing. Equal t: the lowest triangle in leaf order.
/// Source: Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection.
Hit cast_segment(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

}  // namespace firmtouch::mesh
