#include "host_sim/plant/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace firmtouch::host_sim {
namespace {

Vec corner(const mesh::View& mesh, uint32_t i) {
  const mesh::Vertex& v = mesh.vertices()[i];
  return {static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)};
}

double edge_distance2(Vec p, Vec a, Vec b) {
  const Vec along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
  const Vec rest = p - (a + along * t);
  return dot(rest, rest);
}

double triangle_distance2(Vec p, Vec a, Vec b, Vec c) {
  const Vec n = cross(b - a, c - a);
  const double area2 = dot(n, n);
  const bool above = area2 > 0 && dot(cross(b - a, p - a), n) >= 0 &&
                     dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  if (above) {
    const double height = dot(p - a, n);
    return height * height / area2;
  }
  return std::min({edge_distance2(p, a, b), edge_distance2(p, b, c), edge_distance2(p, c, a)});
}

}  // namespace

double brute_force_distance_m(const mesh::View& mesh, Vec p_m) {
  double best = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    best = std::min(best, triangle_distance2(p_m, corner(mesh, t.corner[0]),
                                             corner(mesh, t.corner[1]), corner(mesh, t.corner[2])));
  }
  return std::sqrt(best);
}

}  // namespace firmtouch::host_sim
