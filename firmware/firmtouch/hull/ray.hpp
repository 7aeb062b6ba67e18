#pragma once
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::hull {

/// A ray as the segment from its origin to beyond a box that holds all that it may meet: what any
/// query of a segment tells of that it tells of the ray, its t times `reach` being in lengths of the
/// ray's direction.
struct RaySegment {
  math::Vec3 from_m, to_m;
  float reach = 0;
};

/// `low_m`, `high_m`: the box (hull::Head, of all vertices). Result: false, and nothing told, where the
/// ray is not finite, has no direction, or begins or reaches too far off for a float.
/// Error: the ray's line is moved by one rounding of its far end.
bool segment_of_ray(const float (&low_m)[3], const float (&high_m)[3], math::Vec3 from_m,
                    math::Vec3 direction, RaySegment& segment);

}  // namespace firmtouch::hull
