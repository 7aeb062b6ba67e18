#pragma once
// A lower bound of the distance to a triangle, in few operations of which none waits long for another. For
// the library's own translation units.

#include "firmtouch/mesh/lined.hpp"
#include "firmtouch/mesh/triangle_lanes.hpp"

namespace firmtouch::mesh {

/// Beyond this a prism's lane is certainly told farther than the nearest so far. `slack_m2`:
/// Nearer::slack_m2().
static inline float prism_limit2(float min2_m2, float slack_m2) {
  return min2_m2 * (1.0f + 0x1p-16f) + (slack_m2 * 0x1p-4f + 0x1p-100f);
}

/// Lanes of which it is not certain that they are told farther than the nearest so far, D away.
/// `limit2_m2`: prism_limit2(). Rows of a prism: the corner a, the triangle's normal n, the outward
/// normals s of its edges a b, c a and b c in its plane, and how far outward b c lies.
///
/// Let q be the triangle's point nearest to p, d away. As stored n and s are no longer than 1 + 4 u, n . s
/// is at most 8 u, and of q - a no more than 4 u E lies along n or outward of an edge (tools/bake/mesh/prism.cpp
/// proves that or stores 0, which tells nothing; u = 2^-24, E the mesh's longest edge). So with z = n . (p -
/// a) and o = s . (p - a), less what b c lies outward, or 0 if that is more, (z, o) is longer by no more
/// than 6 u E than a vector whose square is d^2 (1 + 17 u).
///
/// Suppose d < A = D (1 + 8 u) + 30 u E, beyond which a foot is told more than D away (mesh/loss.hpp). Then
/// |p - a| < A + E; z and o are computed with an error of at most 6 u (A + E) each, and their squares' sum
/// is at most A^2 (1 + 55 u) + 16 u E^2, which is D^2 (1 + 104 u) + 48 u E^2: half of what prism_limit2() adds.
/// Squares that vanish are less than the constant. A comparison with what is no number leaves its lane in.
template <class Float>
[[gnu::always_inline]] static inline uint32_t may_be_nearer(const Lined& lined, math::Vec3 p_m,
                                                            float limit2_m2) {
  using namespace lanes;
  using math::larger;
  // Every fourth row by a pointer: a processor reaches the others from there.
  const size_t stride = lined.of.count;
  const float* const first = lined.row(lined.ahead.prisms, kRowsOfPrisms);
  const float* const fourth[4] = {first, first + 4 * stride, fourth[1] + 4 * stride,
                                  fourth[2] + 4 * stride};
  const size_t on[4] = {0, stride, 2 * stride, 3 * stride};
  const auto row = [&](size_t k) { return math::lanes_from<Float>(fourth[k / 4] + on[k % 4]); };
  const auto rows = [&](size_t k) { return Lanes<Float>{row(k), row(k + 1), row(k + 2)}; };
  const Lanes<Float> p{all_of<Float>(p_m.x), all_of<Float>(p_m.y), all_of<Float>(p_m.z)};
  const Lanes<Float> ap = p - rows(0);
  const auto along = [&](size_t k) { return dot(rows(k), ap); };
  const Float z = along(3), beyond_bc = along(12) - row(15);
  const Float o = larger(larger(along(6), along(9)), larger(beyond_bc, Float{}));
  return ~math::lanes_of(math::at_most(all_of<Float>(limit2_m2), z * z + o * o)) & lined.asked();
}

}  // namespace firmtouch::mesh
