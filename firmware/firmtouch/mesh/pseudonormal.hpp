#pragma once
// Decoding of the stored pseudonormals. For the library's own translation units and the baker,
// which measures the margin that is left after the encoding.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::mesh {

static inline math::Vec3 unit(math::Vec3 v) { return v * (1.0f / math::length(v)); }

/// Unit normal of a triangle. The edges are scaled to its longest first: a product of two edges of
/// a model in micrometres would be lost below the smallest float.
static inline math::Vec3 unit_normal(math::Vec3 a, math::Vec3 b, math::Vec3 c) {
  const math::Vec3 ab = b - a;
  const float per_ab = 1.0f / math::length(ab);
  return unit(cross(ab * per_ab, (c - a) * per_ab));
}

/// Octahedral to unit vector. Error: 5e-5 rad.
static inline math::Vec3 decode_vertex_normal(uint32_t code) {
  const float u =
      static_cast<float>(static_cast<int32_t>(code & 0xFFFFu) - 32767) * (1.0f / 32767.0f);
  const float v = static_cast<float>(static_cast<int32_t>(code >> 16) - 32767) * (1.0f / 32767.0f);
  const float absolute_u = u < 0.0f ? -u : u, absolute_v = v < 0.0f ? -v : v;
  math::Vec3 n{u, v, 1.0f - absolute_u - absolute_v};
  if (n.z < 0.0f) {  // the lower half is folded over the upper one's edges
    n.x = u < 0.0f ? absolute_v - 1.0f : 1.0f - absolute_v;
    n.y = v < 0.0f ? absolute_u - 1.0f : 1.0f - absolute_u;
  }
  return unit(n);
}

/// The pseudonormal of an edge that runs along `edge` (any length; its triangle to the left, seen
/// from outside), given its triangle's unit normal.
static inline math::Vec3 decode_edge_normal(math::Vec3 normal, math::Vec3 edge, int8_t fold) {
  const float s = static_cast<float>(fold) * (1.0f / kFoldsPerUnit);
  const float along = 1.0f - (s < 0.0f ? -s : s);
  const math::Vec3 across =
      cross(edge, normal);  // in the plane, outward, |edge| times as long as the normal
  return unit(normal * (math::length(edge) * along) + across * s);
}

}  // namespace firmtouch::mesh
