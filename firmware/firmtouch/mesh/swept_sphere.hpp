#pragma once
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/swept_sphere.hpp"

namespace firmtouch::mesh {

struct Sweep {
  float free_part = 0;  // of the way, 0 to 1: up to there no point of the surface is nearer to it
                        // than the radius
  uint32_t work = 0;    // units used, at most those allowed
};

/// How far the sphere, in the mesh frame, certainly passes freely. The boxes that its way meets are
/// searched. A triangle is apart from the sphere as long as their shadows on an axis are: one of
/// those given, or the direction in which the triangle is nearest at first.
/// Errors: the free part is never too long, rounding of the import included; it may be too short,
///         and is 0 where the budget ends.
/// Bounds: <= budget, or 4 units; 0.5 KB of stack; re-entrant; callable from an interrupt.
/// Source: separating axes: Gottschalk, Lin and Manocha 1996; conservative advancement: Mirtich
///         1996.
Sweep sweep(const View& mesh, const query::SweptSphere& sphere, query::Budget budget);

}  // namespace firmtouch::mesh
