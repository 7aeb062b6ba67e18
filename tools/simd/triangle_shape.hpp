#pragma once
// What a measurement takes from the triangle alone, stored for speed.

#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::simd {

/// Of a triangle a b c: corner a, b - a, the height vector from the line a b to c, 1 / |ab|^2, the
/// part of ab at which c stands, |h|^2.
struct TriangleShape {
  mesh::Vertex a_m, ab_m, h_m;
  float per_ab2_m2;
  float xc;
  float h2_m2;
};
static_assert(sizeof(TriangleShape) == 48);

/// By the operations of mesh/triangle.hpp in their order.
inline TriangleShape shape_of(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m) {
  const mesh::OfCorners shape{a_m, b_m, c_m};
  const math::Vec3 ab = shape.ab();
  const float per_ab2 = shape.per_ab2(ab);
  const float xc = shape.xc(ab, per_ab2);
  const math::Vec3 h = shape.h(ab, xc);
  return {{a_m.x, a_m.y, a_m.z}, {ab.x, ab.y, ab.z}, {h.x, h.y, h.z}, per_ab2, xc, shape.h2(h)};
}

/// Arrays of a block's shapes: the floats of a shape, in the order of its members.
constexpr uint32_t kShapeArrays = sizeof(TriangleShape) / sizeof(float);
inline void put_floats(const TriangleShape& shape, float (&to)[kShapeArrays]) {
  static_assert(sizeof shape == sizeof to);
  __builtin_memcpy(to, &shape, sizeof to);
}

}  // namespace firmtouch::simd
