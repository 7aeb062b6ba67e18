#pragma once
// Which way is out. For the library's own translation units and the baker.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"

namespace firmtouch::mesh {

/// The pseudonormal of an edge or a vertex of a triangle whose unit normal is `normal`. Apart:
/// nearly every answer is a face's, whose values would wait in memory.
math::Vec3 border_direction(const View& mesh, uint32_t triangle, Feature feature,
                            math::Vec3 normal);

/// Unit pseudonormal of a feature of a triangle, from what the mesh stores of it; of an unsigned
/// mesh the face's normal.
[[gnu::always_inline]] static inline math::Vec3 feature_direction(const View& mesh,
                                                                  uint32_t triangle,
                                                                  Feature feature) {
  const Triangle<uint32_t> t = mesh.triangle(triangle);
  const math::Vec3 normal =
      unit_normal(mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]), mesh.vertex(t.corner[2]));
  if (feature != Feature::kFace && mesh.is_signed())
    return border_direction(mesh, triangle, feature, normal);
  return {normal.x, normal.y, normal.z};  // one by one: an aggregate is built on the stack
}

}  // namespace firmtouch::mesh
