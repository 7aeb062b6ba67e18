#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::spline {

/// The answer of a closest-point query.
struct Closest {
  float distance_m = 0;
  math::Vec3 point_m;  // on the curve or surface
  // Unit vector: a curve's tangent; a surface's normal, along u x along v, or against it where the
  // baker reversed the surface. 0 where there is none.
  math::Vec3 direction;
  uint32_t piece = 0;   // the entity, in the order of the file
  float u = 0, v = 0;   // in the entity's own parameters; v = 0 for a curve
  uint32_t bezier = 0;  // the piece of the asset, and its parameters, -1 to 1
  float s = 0, t = 0;
  uint32_t evaluations = 0;        // points evaluated; certificate.steps includes them
  query::Certificate certificate;  // sign: always 0
};

}  // namespace firmtouch::spline
