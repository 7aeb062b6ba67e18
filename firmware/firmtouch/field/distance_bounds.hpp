#pragma once
#include <stdint.h>

#include "firmtouch/field/view.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::field {

/// Bounds of a point, from one cell.
struct Bounds {
  float lower_m = 0;  // certified: no point of the surface is nearer
  float upper_m = 0;  // certified: some point of the surface is no farther
  int8_t sign =
      0;  // +1 outside, -1 inside, 0 unknown; never unknown where lower_m > 0, of a signed field
  uint32_t seed = query::kNowhere;  // where the mesh's query may start
};

/// Bounds of the distance from `p_m` (mesh frame) to the surface, from the cell that holds it:
/// those of its centre, less and more by the way there (distance is 1-Lipschitz). Outside the grid
/// also by the grid's box, which holds the surface. Bounds: one cell read; at most 256 instructions
/// on the Cortex-M7, without a loop or a call;
///         re-entrant; callable from an interrupt.
/// Result: lower_m >= 0 and both finite for every input; a query that is not finite: 0, FLT_MAX, 0.
/// Error:  bounds are rounded outward through all float32 error
/// (tests/field/bake_field_host_test.cpp).
Bounds distance_bounds(const View& distance_field, math::Vec3 p_m);

}  // namespace firmtouch::field
