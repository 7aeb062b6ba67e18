#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::hull {

// Triangles of the mesh that a triangle crosses, from the hull's sections and the mesh's vertices
// and triangles, as in hull/complete_cast.hpp: all are found. Decided without rounding, also where
// triangles touch or share a plane: as if the queried triangle were moved by (e, e^2, e^3) for an
// infinitely small e > 0. A triangle inside the mesh crosses nothing.

struct TriangleHit {
  bool hit = false;
  uint32_t triangle = 0;  // in leaf order
  uint32_t steps = 0;
  bool exact = false;  // false: not finite, or the budget ran out before it was certain
};

struct TriangleHits {
  uint32_t found = 0;     // all of them, also those for which there was no room
  uint32_t reported = 0;  // in the caller's span: the smaller of `found` and its size
  uint32_t steps = 0;
  bool exact = false;
};

/// Any of them: whether something is in the way.
/// Bounds: <= budget visits (boxes of the tree read); 5 KB of stack; re-entrant; callable from an
///         interrupt.
TriangleHit any_crossed(const View& hull, const math::Vec3 (&corner_m)[3], query::Budget budget);

/// All of them, in leaf order; where there are more than `buffer` holds, the first ones.
/// Bounds: as above, and found * reported moves in `buffer`.
TriangleHits all_crossed(const View& hull, const math::Vec3 (&corner_m)[3], query::Budget budget,
                         core::Span<uint32_t> buffer);

/// Whether a triangle may meet the mesh, from the base hull alone: it crosses a face of it, or
/// begins inside. Reads only the resident part. Bounds: <= budget visits; 5 KB of stack;
/// re-entrant; callable from an interrupt. Result: no hit and exact: it lies outside the mesh and
/// does not meet it. `triangle` is a face of the
///         base hull. If the budget runs out: a hit that is not exact.
TriangleHit base_hull_crossed(const BaseHull& base_hull, const math::Vec3 (&corner_m)[3],
                              query::Budget budget);

}  // namespace firmtouch::hull
