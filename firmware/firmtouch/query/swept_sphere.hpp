#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::query {

/// A sphere that moves straight on.
struct SweptSphere {
  math::Vec3 from_m, along_m;
  float radius_m = 0;
  // Directions in which a near part of the shape may lie, at most 1 long: those into the planes
  // that the sphere slides along.
  math::Vec3 axis[3];
  uint32_t axes = 0;
};

}  // namespace firmtouch::query
