#pragma once
// What a measurement takes from the triangle alone, as the baker stores it and open() proves it.
// For the library's own translation units and the baker.

#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {

/// By the operations of mesh/triangle.hpp in their order.
inline TriangleShape shape_of(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m) {
  const OfCorners shape{a_m, b_m, c_m};
  const math::Vec3 ab = shape.ab();
  const float per_ab2 = shape.per_ab2(ab);
  const float xc = shape.xc(ab, per_ab2);
  const math::Vec3 h = shape.h(ab, xc);
  return {{a_m.x, a_m.y, a_m.z}, {ab.x, ab.y, ab.z}, {h.x, h.y, h.z}, per_ab2, xc, shape.h2(h)};
}

/// The floats of a shape, in the order of its members.
constexpr uint32_t kShapeFloats = sizeof(TriangleShape) / sizeof(float);
inline void put_floats(const TriangleShape& shape, float (&to)[kShapeFloats]) {
  static_assert(sizeof shape == sizeof to);
  __builtin_memcpy(to, &shape, sizeof to);
}

}  // namespace firmtouch::mesh
