#include "firmtouch/hull/ray.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::hull {
namespace {

float size_of(float v) { return v < 0.0f ? -v : v; }
float larger(float a, float b) { return a > b ? a : b; }

}  // namespace

// The farthest corner is no farther than the farthest planes' sum; a direction no shorter than its
// longest axis.
bool segment_of_ray(const float (&low_m)[3], const float (&high_m)[3], math::Vec3 from_m,
                    math::Vec3 direction, RaySegment& segment) {
  if (!(math::is_finite(from_m) && math::is_finite(direction))) return false;
  const float from[3] = {from_m.x, from_m.y, from_m.z};
  float farthest_m = 0.0f;
  for (uint32_t k = 0; k < 3; ++k)
    farthest_m += larger(size_of(low_m[k] - from[k]), size_of(high_m[k] - from[k]));
  const float longest =
      larger(size_of(direction.x), larger(size_of(direction.y), size_of(direction.z)));
  if (!(longest > 1e-30f)) return false;
  const float reach = farthest_m / longest * 1.01f;
  const math::Vec3 to_m = from_m + direction * reach;
  if (!(reach > 0.0f && math::is_finite(to_m))) return false;
  segment = {from_m, to_m, reach};
  return true;
}

}  // namespace firmtouch::hull
