#pragma once
// A lower bound of the distance to a triangle by its prism: few operations, short dependencies.

#include "simd/search/block_triangles.hpp"
#include "simd/search/triangle_lanes.hpp"

namespace firmtouch::simd {

/// A squared prism distance beyond this is certainly farther than the nearest so far. `slack_m2`:
/// Nearer::slack_m2().
static inline float prism_limit2(float min2_m2, float slack_m2) {
  return min2_m2 * (1.0f + 0x1p-16f) + (slack_m2 + 0x1p-100f);
}

/// Lanes whose triangle may be nearer than the nearest so far, at distance D.
/// `limit2_m2`: prism_limit2(). Arrays of a prism: the corner a, the triangle's normal n, the
/// outward normals s of its edges ab, ca and bc in its plane, and the outward offset of bc.
///
/// Let q be the triangle's point nearest to p, at distance d; u = 2^-24, E the mesh's longest edge.
/// As stored, n and s are at most 1 + 4 u long, n . s is at most 8 u, and at most 4 u E of q - a
/// lies along n or outward of an edge (tools/simd/prism.cpp proves that or stores 0, which bounds
/// nothing). Let z = n . (p - a), and o the largest of 0 and each s . (p - a), less the offset for
/// bc. Then (z, o) is longer by at most 6 u E than a vector whose square is d^2 (1 + 17 u).
///
/// Suppose d < A = D (1 + 8 u) + 30 u E; a foot beyond A is found farther than D (mesh/loss.hpp).
/// Then |p - a| < A + E. z and o have an error of at most 6 u (A + E) each. The sum of their
/// squares is at most A^2 (1 + 55 u) + 16 u E^2, which is D^2 (1 + 104 u) + 48 u E^2: half of what
/// prism_limit2() adds. Squares that underflow are less than its constant. NaN leaves the lane in.
[[gnu::always_inline]] static inline uint32_t may_be_nearer(const BlockTriangles& triangles,
                                                            math::Vec3 p_m, float limit2_m2) {
  // A pointer to every fourth array: address modes reach the others.
  const size_t stride = triangles.of.count;
  const float* const first = triangles.begin(triangles.tree.prisms, kPrismArrays);
  const float* const fourth[4] = {first, first + 4 * stride, fourth[1] + 4 * stride,
                                  fourth[2] + 4 * stride};
  const size_t on[4] = {0, stride, 2 * stride, 3 * stride};
  const auto array = [&](size_t k) { return lanes_from(fourth[k / 4] + on[k % 4]); };
  const auto vectors = [&](size_t k) { return Lanes{array(k), array(k + 1), array(k + 2)}; };
  const Lanes ap = all_of(p_m) - vectors(0);
  const auto along = [&](size_t k) { return dot(vectors(k), ap); };
  const Float8 z = along(3), beyond_bc = along(12) - array(15);
  const Float8 o = larger(larger(along(6), along(9)), larger(beyond_bc, all_of(0.0f)));
  return ~bits_of(at_most(all_of(limit2_m2), z * z + o * o)) & triangles.lanes();
}

}  // namespace firmtouch::simd
