#include "host_sim/plant/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/triangle_distance.hpp"

namespace firmtouch::host_sim {
namespace {

Vec corner(const mesh::View& mesh, uint32_t i) {
  const mesh::Vertex& v = mesh.vertices()[i];
  return {static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)};
}

}  // namespace

double brute_force_distance_m(const mesh::View& mesh, Vec p_m) {
  double best = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    best = std::min(
        best, tools::distance2_to_triangle(p_m, corner(mesh, t.corner[0]),
                                           corner(mesh, t.corner[1]), corner(mesh, t.corner[2])));
  }
  return std::sqrt(best);
}

}  // namespace firmtouch::host_sim
