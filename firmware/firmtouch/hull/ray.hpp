#pragma once
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::hull {

/// A ray as the segment from its origin to beyond a box that contains the whole surface. Segment
/// queries answer for the ray; t times `reach` is in lengths of the ray's direction.
struct RaySegment {
  math::Vec3 from_m, to_m;
  float reach = 0;
};

/// `low_m`, `high_m`: the box (hull::Head, of all vertices).
/// Result: false, and `segment` unchanged, if the ray is not finite, has no direction, or begins or
///         ends beyond the range of a float.
/// Error: the ray's line is moved by one rounding of its far end.
bool segment_of_ray(const float (&low_m)[3], const float (&high_m)[3], math::Vec3 from_m,
                    math::Vec3 direction, RaySegment& segment);

}  // namespace firmtouch::hull
