#pragma once
#include "firmtouch/field/distance_bounds.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::field {

/// An answer by map and mesh.
struct Answer {
  // Certainly not inside and farther than the band: the mesh was not asked.
  bool is_far = false;
  // Far: the certificate, of one step, and the map's upper bound as the distance; no point.
  mesh::Closest closest;
};

/// The closest point where it is inside or within `band_m`, else certified bounds: one cell read in
/// free space, the mesh's query near the surface. That starts where the last one ended, and at the
/// cell's seed where there was none or p has moved by more than a cell since. Where the budget ends
/// it, the map's bound and side stand in for what was left open.
/// Pre: `map` was proven against `mesh`; the hint is used with this pair alone.
/// Bounds: those of distance_bounds(), and of one mesh::closest_point() where it is not far.
/// Result: always finite. is_far only where the lower bound is above band_m and the side is not
///         inside. Else as mesh::closest_point() says.
Answer closest_point(const View& distance_field, const mesh::View& mesh, math::Vec3 p_m,
                     float band_m, query::Budget budget, mesh::Hint& hint);

}  // namespace firmtouch::field
