#pragma once
#include <float.h>

#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::hull {

/// Where a point lies to a shell. Inside a shell is not inside the mesh: between the two a shell says
/// nothing of the mesh.
enum class BaseHullSide : uint8_t { kUnknown, kOutside, kInside };

struct BaseHullDistance {
  BaseHullSide side = BaseHullSide::kUnknown;
  // Certified, outside: no point of the mesh is nearer. Else 0: nothing is promised.
  float lower_m = 0;
  // Certified, inside: if the point is inside the mesh too, it is no deeper than this. Else FLT_MAX.
  float deepest_m = FLT_MAX;
  math::Vec3 point_m{};  // of the shell, the nearest that was found
  math::Vec3 normal{};   // unit, outward, of a face that it is on; 0 where none was found
  uint32_t steps = 0;
  bool exact = false;  // point_m is the nearest of the shell, but for rounding
};

/// Closest point of a shell to `p_m` (mesh frame), and what it certifies of the mesh: for contact
/// that must not begin late when there is no time for the mesh. Reads the shell's own block only.
/// Bounds: <= budget steps (boxes read, for the side and then for the point); 4 KB of stack;
///         re-entrant; callable from an interrupt.
/// Result: always finite. A point that is not finite: nothing is known. A budget that runs out
///         lowers lower_m and never makes it wrong.
/// Error:  lower_m is at most 3e-6 diagonals of the shell below the distance to it where exact.
BaseHullDistance base_hull_distance(const BaseHull& base_hull, math::Vec3 p_m,
                                    query::Budget budget);

}  // namespace firmtouch::hull
