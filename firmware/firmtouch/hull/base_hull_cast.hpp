#pragma once
#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::hull {

struct BaseHullHit {
  bool hit = false;
  float t = 1;
  uint32_t face = 0;
  bool enters = false;
  uint32_t steps = 0;
  bool exact = false;  // the shell's first crossing, or certainly none
};

/// First crossing of the segment from `a_m` to `b_m` (mesh frame) with a shell: reads the shell's
/// own block and nothing else, so that a shell in fast memory answers without a read of flash.
/// Bounds: <= budget steps (boxes read); 3.5 KB of stack; re-entrant; callable from an interrupt.
/// Result: none and not exact where the segment is not finite. For one that begins outside the shell:
///         where none is told and exact, it meets nothing of the mesh; else the mesh is not met before
///         t. A hit that is not exact: floats cannot tell whether or when a face is crossed that
///         is passed at its very edge or almost along it, and t is the earliest that it may be; or the
///         budget ran out, and t is 0.
/// Error:  exact: t is at most 2^-12 early, and late by no more than mesh::cast_segment() may be.
BaseHullHit cast_base_hull(const BaseHull& base_hull, math::Vec3 a_m, math::Vec3 b_m,
                           query::Budget budget);

/// How often the shell winds around a point, told by the crossings of a segment to a point outside
/// its box: 0 is outside, 1 or more inside. Exact; reads the shell's own block.
/// Bounds: <= budget steps, with those that `steps` holds already; 4 KB of stack; re-entrant;
///         callable from an interrupt.
/// Result: false where the budget ran out or the point is not finite.
bool wind_around(const BaseHull& base_hull, math::Vec3 p_m, query::Budget budget, int32_t& winding,
                 uint32_t& steps);

}  // namespace firmtouch::hull
