#pragma once
// A lower bound of the distance to a triangle, in few operations of which none waits long for another. For
// the library's own translation units.

#include "firmtouch/mesh/lined.hpp"
#include "firmtouch/mesh/triangle_lanes.hpp"

namespace firmtouch::mesh {

/// Lanes of which it is not certain that they are told farther than the nearest so far, D away.
/// `slack_m2`: Nearer::slack_m2(). Rows of a prism: the corner a, the triangle's normal n, the outward
/// normals s of its edges a b, c a and b c in its plane, and how far outward b c lies.
///
/// Let q be the triangle's point nearest to p, d away. As stored n and s are no longer than 1 + 4 u, n . s
/// is at most 8 u, and of q - a no more than 4 u E lies along n or outward of an edge (tools/bake/prism.cpp
/// proves that or stores 0, which tells nothing; u = 2^-24, E the mesh's longest edge). So with z = n . (p -
/// a) and o = s . (p - a), less what b c lies outward, or 0 if that is more, (z, o) is longer by no more
/// than 6 u E than a vector whose square is d^2 (1 + 17 u).
///
/// Suppose d < A = D (1 + 8 u) + 30 u E, beyond which a foot is told more than D away (mesh/loss.hpp). Then
/// |p - a| < A + E; z and o are computed with an error of at most 6 u (A + E) each, and their squares' sum
/// is at most A^2 (1 + 55 u) + 16 u E^2, which is D^2 (1 + 104 u) + 48 u E^2: half of what is added below.
/// Squares that vanish are less than the constant. A comparison with what is no number leaves its lane in.
template <class Float>
[[gnu::always_inline]] static inline uint32_t may_be_nearer(const Lined& lined, math::Vec3 p_m,
                                                            float least2_m2, float slack_m2) {
  using namespace lanes;
  using math::larger;
  const float* const rows = lined.row(lined.ahead.prisms, kRowsOfPrisms);
  const size_t stride = lined.of.count;
  const float limit2_m2 = least2_m2 * (1.0f + 0x1p-16f) + (slack_m2 * 0x1p-4f + 0x1p-100f);
  const Lanes<Float> p{all_of<Float>(p_m.x), all_of<Float>(p_m.y), all_of<Float>(p_m.z)};
  const Lanes<Float> ap = p - lanes_of_rows<Float>(rows, 0, stride);
  const auto along = [&](size_t k) { return dot(lanes_of_rows<Float>(rows, k, stride), ap); };
  const Float z = along(3), beyond_bc = along(12) - math::lanes_from<Float>(rows + 15 * stride);
  const Float o = larger(larger(along(6), along(9)), larger(beyond_bc, Float{}));
  return ~math::lanes_of(math::at_most(all_of<Float>(limit2_m2), z * z + o * o)) & lined.asked();
}

}  // namespace firmtouch::mesh
