#pragma once
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::hull {

// Crossings of a segment with the mesh by the hull's own sections and the mesh's vertices and
// triangles: the mesh's tree is not read and need not be there. Nothing is missed, wherever the
// segment begins, between hull and mesh and inside too. Answers are those of mesh/segment_cast.hpp,
// whose rules of what is a crossing hold here; only the steps differ.

/// First crossing of the segment from `a_m` to `b_m` (mesh frame), either way.
/// Bounds: <= budget steps (boxes of the tree read); 4 KB of stack; re-entrant; callable from an
///         interrupt.
/// Result: as mesh::cast_segment().
mesh::Hit cast_segment(const View& hull, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Any crossing, the first that turns up.
/// Bounds: as above.
mesh::Hit any_crossing(const View& hull, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Every crossing, in order of t (equal t: of triangles in leaf order).
/// Bounds: as above, and found * told moves in `buffer`.
mesh::Crossings all_crossings(const View& hull, math::Vec3 a_m, math::Vec3 b_m,
                              query::Budget budget, core::Span<mesh::SurfaceCrossing> buffer);

}  // namespace firmtouch::hull
