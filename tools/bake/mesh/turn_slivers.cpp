#include "bake/mesh/turn_slivers.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "firmtouch/math/vec3_ops.hpp"
#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// Whether an edge joins the start of half-edge `h` and vertex `to`.
bool has_edge(const std::vector<Face>& faces, const std::vector<uint32_t>& mates, uint32_t h,
              uint32_t to) {
  const uint32_t first = h;
  do {
    if (end_of(faces, h) == to) return true;
    h = next_half(mates[h]);
  } while (h != first);
  return false;
}

}  // namespace

double moved_by_flip_m(Point a, Point b, Point c, Point d) {
  const Point ab = b - a, cd = d - c, ac = c - a, n = cross(ab, cd);
  const double n2 = dot(n, n);
  const double of_ab = dot(cross(ac, cd), n) / n2, of_cd = dot(cross(ac, ab), n) / n2;
  // Written so that NaN is infinite.
  if (!(of_ab > 0 && of_ab < 1 && of_cd > 0 && of_cd < 1)) return HUGE_VAL;
  return std::fabs(dot(ac, n)) / std::sqrt(n2);
}

double height_m(Point a, Point b, Point c) {
  return length(cross(b - a, c - a)) / std::max({length(b - a), length(c - b), length(a - c)});
}

void longest_edge_first(Surface& surface) {
  for (Face& face : surface.faces) {
    float longest2 = -1;
    size_t longest = 0;
    for (size_t k = 0; k < 3; ++k) {
      const math::Vec3 edge = surface.vertices[face[(k + 1) % 3]] - surface.vertices[face[k]];
      const float length2 = dot(edge, edge);
      if (length2 > longest2) longest2 = length2, longest = k;
    }
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(longest), face.end());
  }
}

TurnedSlivers turn_slivers(Surface& surface, const std::vector<uint32_t>& mates,
                           const std::vector<uint32_t>& slivers, double max_m,
                           double min_height_m) {
  TurnedSlivers turned;
  std::vector<Face>& faces = surface.faces;
  std::set<uint32_t> corners;  // of the faces flipped: about these the mates hold no more
  for (const uint32_t f : slivers) {
    const uint32_t mate = mates[3 * f], g = mate / 3, beyond = next_half(next_half(mate));
    const uint32_t a = faces[f][0], b = faces[f][1], c = faces[f][2], d = faces[g][beyond % 3];
    if (corners.count(a) + corners.count(b) + corners.count(c) + corners.count(d) != 0) continue;
    if (c == d || has_edge(faces, mates, 3 * f + 2, d)) continue;
    const auto at = [&](uint32_t v) { return to_point(surface.vertices[v]); };
    const double moved_m = moved_by_flip_m(at(a), at(b), at(c), at(d));
    if (!(moved_m <= max_m)) continue;
    if (!(height_m(at(a), at(d), at(c)) > min_height_m)) continue;
    if (!(height_m(at(d), at(b), at(c)) > min_height_m)) continue;
    surface.take_material(f, g);
    faces[f] = {a, d, c};
    faces[g] = {d, b, c};
    corners.insert({a, b, c, d});
    ++turned.flips;
    turned.moved_m = std::max(turned.moved_m, moved_m);
  }
  return turned;
}

}  // namespace firmtouch::tools
