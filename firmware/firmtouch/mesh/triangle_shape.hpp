#pragma once
// What a measurement takes from the triangle alone, as the baker stores it and open() proves it. For
// the library's own translation units and the baker.

#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {

/// A row of kShapesSection, by the operations of mesh/triangle.hpp in their order.
inline void shape_of(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m, float (&row)[kShapeFloats]) {
  const OfCorners shape{a_m, b_m, c_m};
  const math::Vec3 ab = shape.ab(), ac = shape.ac();
  const float per_ab2 = shape.per_ab2(ab);
  const float xc = shape.xc(ab, ac, per_ab2);
  const float h2 = shape.h2(ac - ab * xc);
  const float values[kShapeFloats] = {a_m.x, a_m.y, a_m.z, ab.x,    ab.y, ab.z,
                                      ac.x,  ac.y,  ac.z,  per_ab2, xc,   h2};
  for (uint32_t k = 0; k < kShapeFloats; ++k) row[k] = values[k];
}

}  // namespace firmtouch::mesh
