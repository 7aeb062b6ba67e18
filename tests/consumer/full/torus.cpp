#include "torus.hpp"

#include "firmtouch/math/elementary.hpp"

using firmtouch::math::safe_square_root;

firmtouch::scene::SurfacePoint closest_on(const Torus& torus, firmtouch::math::Vec3 position_m) {
  const float x = position_m.x - torus.centre_m.x, y = position_m.y - torus.centre_m.y;
  const float z = position_m.z - torus.centre_m.z;
  const float from_axis_m = safe_square_root(x * x + y * y);
  const float from_ring_m = from_axis_m - torus.ring_radius_m;
  const float from_core_m = safe_square_root(from_ring_m * from_ring_m + z * z);
  firmtouch::scene::SurfacePoint point;
  if (!(from_axis_m > 1e-6f) || !(from_core_m > 1e-6f))
    return point;  // no direction is nearest: nothing is certain
  const float outward = from_ring_m / (from_core_m * from_axis_m);
  point.distance_m = from_core_m - torus.tube_radius_m;
  point.normal = {x * outward, y * outward, z / from_core_m};
  point.sign = point.distance_m < 0 ? -1 : 1;
  return point;
}
