#include "field/foot.hpp"

#include <algorithm>
#include <cmath>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

// Parts of the triangle whose first corner was corner `turn`, as parts of the triangle itself.
uint32_t turned_part(uint32_t part, uint32_t turn) {
  if (part == 0) return 0;
  const uint32_t first = part < 4 ? 1 : 4;
  return first + (part - first + turn) % 3;
}

Foot foot_at(Point p, Point at, uint32_t part) { return {at, dot(p - at, p - at), part}; }

// a b is the longest edge.
Foot foot_in_order(Point p, Point a, Point b, Point c) {
  const Point ab = b - a, ac = c - a, ap = p - a;
  if (!(dot(ab, ab) > 0)) return foot_at(p, a, 4);  // a point
  const double per_ab2 = 1 / dot(ab, ab);
  const double x = dot(ab, ap) * per_ab2, xc = dot(ab, ac) * per_ab2;
  const Point e = ap - ab * x, h = ac - ab * xc;
  const double y = dot(e, h);
  if (y <= 0) {
    if (x <= 0) return foot_at(p, a, 4);
    if (x >= 1) return foot_at(p, b, 5);
    return foot_at(p, a + ab * x, 1);
  }
  const double w = y / dot(h, h), v = x - w * xc;
  const bool beyond_ac = v<0, beyond_bc = v + w> 1;
  if (!(beyond_ac || beyond_bc)) return foot_at(p, a + ab * x + h * w, 0);
  if (beyond_ac) {
    const double t = dot(ac, ap), ac2 = dot(ac, ac);
    if (t <= 0) return foot_at(p, a, 4);
    if (t < ac2) return foot_at(p, a + ac * (t / ac2), 3);
  }
  if (beyond_bc) {
    const Point bc = c - b;
    const double t = dot(bc, p - b), bc2 = dot(bc, bc);
    if (t <= 0) return foot_at(p, b, 5);
    if (t < bc2) return foot_at(p, b + bc * (t / bc2), 2);
  }
  return foot_at(p, c, 6);
}

Point unit(Point v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Point{};
}

// Of two unit vectors, exact near 0 and near pi.
double angle_between(Point a, Point b) { return 2 * std::atan2(length(a - b), length(a + b)); }

}  // namespace

Foot foot_on(Point p, const std::array<Point, 3>& t) {
  const double length2[3] = {dot(t[1] - t[0], t[1] - t[0]), dot(t[2] - t[1], t[2] - t[1]),
                             dot(t[0] - t[2], t[0] - t[2])};
  const uint32_t turn = static_cast<uint32_t>(std::max_element(length2, length2 + 3) - length2);
  Foot foot = foot_in_order(p, t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]);
  foot.part = turned_part(foot.part, turn);
  return foot;
}

SideTeller::SideTeller(const Surface& surface)
    : surface_(surface), vertex_normal_(surface.vertices.size()) {
  for (const Face& face : surface.faces) {
    const Point a = to_point(surface.vertices[face[0]]), b = to_point(surface.vertices[face[1]]),
                c = to_point(surface.vertices[face[2]]);
    const Point normal = unit(cross(b - a, c - a));
    face_normal_.push_back(normal);
    const Point along[3] = {unit(b - a), unit(c - b), unit(a - c)};
    for (uint32_t k = 0; k < 3; ++k) {
      const double angle = angle_between(along[k], along[(k + 2) % 3] * -1);
      vertex_normal_[face[k]] = vertex_normal_[face[k]] + normal * angle;
    }
  }
  for (const uint32_t mate : Edges(surface.faces).mates()) across_.push_back(mate / 3);
}

int SideTeller::side_of(Point p, uint32_t face, const Foot& foot) const {
  Point normal = face_normal_[face];
  if (foot.part >= 4)
    normal = vertex_normal_[surface_.faces[face][foot.part - 4]];
  else if (foot.part >= 1)
    normal = normal + face_normal_[across_[3 * face + foot.part - 1]];
  return dot(p - foot.at, normal) < 0 ? -1 : 1;
}

}  // namespace firmtouch::tools
