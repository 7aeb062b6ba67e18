#pragma once
// For the library's own translation units.
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::mesh {

/// Whether floats are right about the nearest feature as far as it matters: the squared distance is
/// more than 2^-20 of the square of the longest edge, ab. A foot that floats put on the wrong
/// feature is off by at most 21 u L, which changes the distance by less than 2^-5 u L (u = 2^-24;
/// mesh/loss.hpp).
inline bool is_feature_clear(float distance2_m2, math::Vec3 ab_m) {
  const float ab2_m2 = ab_m.x * ab_m.x + ab_m.y * ab_m.y + ab_m.z * ab_m.z;
  return distance2_m2 > ab2_m2 * 0x1p-24f;
}

/// Squared distance from `p` to the triangle a b c in compensated arithmetic (pairs of floats,
/// about 46 bits), from the foot that closest_on_triangle() found. Used if float32 is not accurate
/// enough to decide whether the triangle is the nearest: far from the mesh, or with large
/// triangles.
///
/// Floats put the foot at most 21 u L from the true one. The offset from there to p is computed in
/// pairs of floats. Where the feature is clear that is enough. Else what of it lies in the plane,
/// or along an edge, is removed: it is so short that floats lose nothing. If the foot then leaves
/// the face, the nearest edge counts.
/// Pre: a b is the longest edge.
/// Bounds: about 450 instructions in a face, 370 instructions at an edge, 200 instructions at a
///         corner; 1,400 instructions if the feature is not clear; 500 B of stack; re-entrant.
/// Error:  2^-24 of the square, the rounding of the result, beside 2^-4 u L in the distance
///         (tests/mesh/compensated_host_test.cpp).
/// Source: Dekker 1971; Knuth, volume 2, 4.2.2 (error-free sums and products).
float nearest_compensated2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c, Feature feature,
                           float distance2_m2);

/// The same without a foot.
float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c);

}  // namespace firmtouch::mesh
