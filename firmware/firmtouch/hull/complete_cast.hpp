#pragma once
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::hull {

// Crossings of a segment with the mesh, from the hull's sections and the mesh's vertices and
// triangles. The mesh's tree is not read and may be absent. Every crossing is found, wherever the
// segment begins. Answers equal those of mesh/segment_cast.hpp, where a crossing is defined; only
// visits differ.

/// First crossing of the segment from `a_m` to `b_m` (mesh frame), either way.
/// Bounds: <= budget visits (boxes of the tree read); 4 KB of stack; re-entrant; callable from an
///         interrupt.
/// Result: as mesh::cast_segment().
mesh::Hit cast_segment(const View& hull, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Any crossing, the first that turns up.
/// Bounds: as above.
mesh::Hit any_crossing(const View& hull, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

/// Every crossing, in order of t (equal t: of triangles in leaf order).
/// Bounds: as above, and found * reported moves in `buffer`.
mesh::Crossings all_crossings(const View& hull, math::Vec3 a_m, math::Vec3 b_m,
                              query::Budget budget, core::Span<mesh::SurfaceCrossing> buffer);

}  // namespace firmtouch::hull
