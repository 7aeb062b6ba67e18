#pragma once
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::mesh {

struct Hit {
  bool hit = false;
  float t =
      1;  // 0 at a, 1 at b: the first crossing; where the budget ran out and nothing was hit yet, 1
  uint32_t triangle = 0;  // in leaf order
  uint32_t steps = 0;
  bool exact = false;  // false: the budget ran out; a crossing nearer than t may have been missed
};

/// First crossing of the segment from `a_m` to `b_m` (mesh frame) with the surface, either side.
/// Watertight: an edge's side test is computed once in the order of its vertex indices, so that the
/// two triangles of an edge never both miss. No absolute tolerance. Bounds: <= budget steps; 400 B
/// of stack; re-entrant; callable from an interrupt. Result: a segment that is not finite hits
/// nothing. Ties in t: the lowest triangle in leaf order. Source: Woop, Benthin, Wald 2013
/// (watertight ray/triangle intersection).
Hit cast_segment(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

}  // namespace firmtouch::mesh
