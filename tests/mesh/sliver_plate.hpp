#pragma once
#include "mesh/brute_force.hpp"

namespace firmtouch::mesh_test {

struct Rotation {
  Point x, y, z;  // rows
  Point of(Point p) const { return {dot(x, p), dot(y, p), dot(z, p)}; }
};

/// A plate whose outline has a corner `lift_m` off the line between its neighbours; both flat faces
/// are cut so that this corner gets a triangle of its own.
inline tools::Surface sliver_plate(const Rotation& rotation, double lift_m) {
  const Point outline[5] = {
      {0.06, -0.019, 0}, {0.06 + lift_m, 0.0185, 0}, {0.06, 0.019, 0}, {0, 0.04, 0}, {0, -0.04, 0}};
  tools::Surface surface;
  for (const double z_m : {0.0, 0.006})
    for (const Point& p : outline)
      surface.vertices.push_back(tools::to_vec3(rotation.of({p.x, p.y, z_m})));
  for (const tools::Face& f : {tools::Face{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}) {
    surface.faces.push_back({f[2], f[1], f[0]});
    surface.faces.push_back({f[0] + 5, f[1] + 5, f[2] + 5});
  }
  for (uint32_t k = 0; k < 5; ++k) {
    const uint32_t next = (k + 1) % 5;
    surface.faces.push_back({k, next, next + 5});
    surface.faces.push_back({k, next + 5, k + 5});
  }
  return surface;
}

}  // namespace firmtouch::mesh_test
