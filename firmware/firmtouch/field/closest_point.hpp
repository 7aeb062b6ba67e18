#pragma once
#include "firmtouch/field/distance_bounds.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::field {

/// An answer from field and mesh.
struct Answer {
  // Certainly not inside and farther than the band: the mesh was not queried.
  bool is_far = false;
  // Far: the certificate, of one visit, and the field's upper bound as the distance; no point.
  mesh::Closest closest;
};

/// Closest point if it is inside or within `band_m`, else certified bounds: one cell read in free
/// space, a mesh query near the surface. The query starts at the hint, or at the cell's seed if the
/// hint is cold or p has moved by more than a cell. If the budget ends it, the field's bound and
/// sign replace what the search left open. Pre: `distance_field` was proven against `mesh`; the
/// hint is used with this pair only. Bounds: those of distance_bounds(), and of one
/// mesh::closest_point() where it is not far. Result: always finite. is_far only where the lower
/// bound is above band_m and the sign is not
///         inside. Else as mesh::closest_point() says.
Answer closest_point(const View& distance_field, const mesh::View& mesh, math::Vec3 p_m,
                     float band_m, query::Budget budget, mesh::Hint& hint);

}  // namespace firmtouch::field
