#include "bench/true_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/triangle_distance.hpp"

namespace firmtouch::bench {
namespace {

using tools::Box;
using tools::Point;

constexpr uint32_t kLeafFaces = 4;

double triangle_distance2(Point p, Point a, Point b, Point c) {
  double least2 =
      std::min({tools::distance2_to_segment(p, a, b), tools::distance2_to_segment(p, b, c),
                tools::distance2_to_segment(p, c, a)});
  // In an orthogonal frame of the triangle, which slivers do not spoil.
  const Point ab = b - a, ac = c - a, ap = p - a;
  const double ab2 = dot(ab, ab);
  if (!(ab2 > 0)) return least2;
  const double x = dot(ap, ab) / ab2, xc = dot(ac, ab) / ab2;
  const Point height = ac - ab * xc, rest = ap - ab * x;
  const double height2 = dot(height, height);
  if (!(height2 > 0)) return least2;
  const double w = dot(rest, height) / height2, v = x - w * xc;
  if (w >= 0 && v >= 0 && v + w <= 1) {
    const Point up = rest - height * w;
    least2 = std::min(least2, dot(up, up));
  }
  return least2;
}

double outside(double low, double high, double x) { return std::max({low - x, x - high, 0.0}); }

double box_distance2(const Box& box, Point p) {
  const Point d{outside(box.low.x, box.high.x, p.x), outside(box.low.y, box.high.y, p.y),
                outside(box.low.z, box.high.z, p.z)};
  return dot(d, d);
}

}  // namespace

double triangle_distance(Point p, Point a, Point b, Point c) {
  return std::sqrt(triangle_distance2(p, a, b, c));
}

TrueDistance::TrueDistance(const tools::Surface& surface) : surface_(surface) {
  for (uint32_t f = 0; f < surface.faces.size(); ++f) faces_.push_back(f);
  nodes_.push_back({{}, 0, static_cast<uint32_t>(faces_.size()), 0});
  for (uint32_t n = 0; n < nodes_.size(); ++n) {
    put_box(nodes_[n]);
    const uint32_t begin = nodes_[n].begin, end = nodes_[n].end;
    if (end - begin <= kLeafFaces) continue;
    const uint32_t middle = split(begin, end, nodes_[n].box);
    nodes_[n].first_child = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({{}, begin, middle, 0});
    nodes_.push_back({{}, middle, end, 0});
  }
}

void TrueDistance::put_box(Node& node) const {
  const double far = std::numeric_limits<double>::infinity();
  node.box = {{far, far, far}, {-far, -far, -far}};
  for (uint32_t i = node.begin; i < node.end; ++i)
    for (const uint32_t corner : surface_.faces[faces_[i]]) {
      const Point p = tools::to_point(surface_.vertices[corner]);
      node.box.low = {std::min(node.box.low.x, p.x), std::min(node.box.low.y, p.y),
                      std::min(node.box.low.z, p.z)};
      node.box.high = {std::max(node.box.high.x, p.x), std::max(node.box.high.y, p.y),
                       std::max(node.box.high.z, p.z)};
    }
}

// By the middle face along the longest side.
uint32_t TrueDistance::split(uint32_t begin, uint32_t end, const Box& box) {
  const Point size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto centre = [&](uint32_t f) {
    double sum = 0;
    for (const uint32_t corner : surface_.faces[f]) {
      const Point p = tools::to_point(surface_.vertices[corner]);
      sum += axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
    return sum;
  };
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
                   [&](uint32_t a, uint32_t b) {
                     const double x = centre(a), y = centre(b);
                     return x < y || (!(y < x) && a < b);
                   });
  return middle;
}

double TrueDistance::operator()(math::Vec3 p_m) const {
  const Point p = tools::to_point(p_m);
  double least2 = std::numeric_limits<double>::infinity();
  uint32_t stack[64];  // one a level and one more: halves of at most 2^32 faces
  uint32_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[stack[--count]];
    if (!(box_distance2(node.box, p) < least2)) continue;
    if (node.first_child != 0) {
      const uint32_t a = node.first_child, b = a + 1;
      const bool a_first = box_distance2(nodes_[a].box, p) <= box_distance2(nodes_[b].box, p);
      stack[count++] = a_first ? b : a;
      stack[count++] = a_first ? a : b;
      continue;
    }
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const tools::Face& f = surface_.faces[faces_[i]];
      least2 = std::min(least2, triangle_distance2(p, tools::to_point(surface_.vertices[f[0]]),
                                                   tools::to_point(surface_.vertices[f[1]]),
                                                   tools::to_point(surface_.vertices[f[2]])));
    }
  }
  return std::sqrt(least2);
}

}  // namespace firmtouch::bench
