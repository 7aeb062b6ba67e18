#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::mesh {

/// Squared distance from `p` to the triangle a b c in compensated arithmetic (pairs of floats,
/// about 46 bits). Used if float32 is not accurate enough to decide whether the triangle is the
/// nearest: far from the mesh, or with few large triangles.
/// Bounds: about 3,000 instructions; 600 B of stack; re-entrant.
/// Error:  2^-24 of the square, the rounding of the result (tests/mesh/compensated_host_test.cpp).
/// Source: Dekker 1971; Knuth, volume 2, 4.2.2 (error-free sums and products).
float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c);

/// The same from the feature that closest_on_triangle() found; a tenth of the work at a corner.
/// Pre: the distance is more than 2^-10 of the triangle's longest edge L. A foot that float32 puts
/// on the wrong feature is then off by at most 21 u L, which changes the distance by less than 2^-5
/// u L (u = 2^-24; mesh/loss.hpp).
float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c,
                            Feature feature);

}  // namespace firmtouch::mesh
