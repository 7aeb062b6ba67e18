#pragma once
#include <float.h>

#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::hull {

/// Position of a point relative to a base hull. Inside the base hull is not inside the mesh:
/// between the two nothing is known about the mesh.
enum class BaseHullSide : uint8_t { kUnknown, kOutside, kInside };

struct BaseHullDistance {
  BaseHullSide side = BaseHullSide::kUnknown;
  // Outside: certified, no point of the mesh is nearer. Else 0.
  float lower_m = 0;
  // Inside: upper bound of the distance to the base hull. A point inside the mesh too is no deeper,
  // unless the base hull crosses itself. Else FLT_MAX.
  float deepest_m = FLT_MAX;
  math::Vec3 point_m{};  // of the base hull, the nearest found
  math::Vec3 normal{};   // unit, outward, of a face at point_m; 0 if none was found
  uint32_t steps = 0;    // visits
  uint32_t work = 0;     // units used
  bool exact = false;    // point_m is the nearest of the base hull, except for rounding
};

/// Closest point of a base hull to `p_m` (mesh frame), and the bounds that it certifies for the
/// mesh: contact begins in time although there is no time for the mesh. Reads only the resident
/// part. Bounds: <= budget visits (boxes read, first for the sign, then for the point); 4 KB of
/// stack;
///         re-entrant; callable from an interrupt.
/// Result: always finite. A query that is not finite: unknown, zeros. A budget that runs out lowers
///         lower_m and never makes it wrong.
/// Error:  where exact, lower_m is at most 3e-6 diagonals of the base hull below the distance to
/// it.
BaseHullDistance base_hull_distance(const BaseHull& base_hull, math::Vec3 p_m,
                                    query::Budget budget);

}  // namespace firmtouch::hull
