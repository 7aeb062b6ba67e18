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

// Squared distance of a number to the interval of three others.
double outside2(double x, double a, double b, double c) {
  const double off = std::max({std::min({a, b, c}) - x, x - std::max({a, b, c}), 0.0});
  return off * off;
}

// Whether even the triangle's box is farther than the square root of `best`.
bool is_farther(Vec p, Vec a, Vec b, Vec c, double best) {
  double distance2 = outside2(p.x, a.x, b.x, c.x);
  if (distance2 > best) return true;
  distance2 += outside2(p.y, a.y, b.y, c.y);
  return distance2 > best || distance2 + outside2(p.z, a.z, b.z, c.z) > best;
}

}  // namespace

double brute_force_distance_m(const mesh::View& mesh, Vec p_m) {
  double best = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    const Vec a = corner(mesh, t.corner[0]), b = corner(mesh, t.corner[1]);
    const Vec c = corner(mesh, t.corner[2]);
    if (is_farther(p_m, a, b, c, best)) continue;
    best = std::min(best, tools::distance2_to_triangle(p_m, a, b, c));
  }
  return std::sqrt(best);
}

}  // namespace firmtouch::host_sim
