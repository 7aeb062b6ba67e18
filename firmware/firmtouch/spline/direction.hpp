#pragma once
// Unit vectors of any length that float32 has, for .cpp files of this module only.
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::spline {

/// The vector divided by its length; 0 where that is next to nothing.
static inline math::Vec3 unit_of(math::Vec3 v) {
  const float most = [&] {
    const float x = v.x < 0.0f ? -v.x : v.x, y = v.y < 0.0f ? -v.y : v.y,
                z = v.z < 0.0f ? -v.z : v.z;
    return x > y ? (x > z ? x : z) : (y > z ? y : z);
  }();
  if (!(most >= 0x1p-100f && most <= 0x1p100f)) return {};
  const math::Vec3 scaled = v * (1.0f / most);
  return scaled * (1.0f / math::length(scaled));
}

}  // namespace firmtouch::spline
