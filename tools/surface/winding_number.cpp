#include "surface/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace firmtouch::tools {
namespace {

// The ray goes along (kSkewX, kSkewY, 1): not along an axis, where the faces and edges of machined
// parts lie.
constexpr double kSkewX = 0.0739177, kSkewY = 0.1270433;

// The plane across the ray has a grid of 2^51 steps, so fine that it moves nothing that counts and
// so coarse that differences are exact.
constexpr double kGridHalf = 0x1p50;

Point project(Point p, double steps_per_m) {
  return {std::floor((p.x - kSkewX * p.z) * steps_per_m + 0.5),
          std::floor((p.y - kSkewY * p.z) * steps_per_m + 0.5), p.z};
}

double grid_of(const Surface& surface) {
  double most = 0;
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    most = std::max({most, std::fabs(p.x) + std::fabs(p.z), std::fabs(p.y) + std::fabs(p.z)});
  }
  double steps_per_m = 1;
  while (most * steps_per_m > kGridHalf) steps_per_m *= 0.5;
  while (most > 0 && most * steps_per_m * 2 <= kGridHalf) steps_per_m *= 2;
  return steps_per_m;
}

std::vector<Point> project_all(const Surface& surface, double steps_per_m) {
  std::vector<Point> projected;
  for (const math::Vec3& v : surface.vertices)
    projected.push_back(project(to_point(v), steps_per_m));
  return projected;
}

// a * b = high + low exactly, without a fused multiply-add. Source: Dekker 1971, as in Shewchuk
// 1997, theorem 18.
struct Product {
  double high, low;
};

Product exact_product(double a, double b) {
  const auto split = [](double x) {
    const double big = x * 134217729.0;  // 2^27 + 1
    return big - (big - x);
  };
  const double high = a * b, a1 = split(a), b1 = split(b), a2 = a - a1, b2 = b - b1;
  return {high, a2 * b2 - (((high - a1 * b1) - a2 * b1) - a1 * b2)};
}

std::vector<Box> boxes_of(const std::vector<Point>& projected, const Surface& surface,
                          const std::vector<bool>& chosen) {
  std::vector<Box> boxes;
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    if (!chosen.empty() && !chosen[f]) continue;
    const Point a = projected[surface.faces[f][0]], b = projected[surface.faces[f][1]],
                c = projected[surface.faces[f][2]];
    boxes.push_back(
        {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
         {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}});
  }
  return boxes;
}

// Twice the area of (p, a, b) in the projection; `left` gets its exact sign. A point on the line is
// thought moved along x by next to nothing and along y by next to nothing of that, the same for
// every edge.
double edge_area(Point a, Point b, Point p, bool& left) {
  const Product one = exact_product(a.x - p.x, b.y - p.y),
                two = exact_product(a.y - p.y, b.x - p.x);
  const double high = one.high - two.high, low = one.low - two.low;
  if (high > 0 || high < 0) {
    left = high > 0;
  } else if (low > 0 || low < 0) {
    left = low > 0;
  } else {
    left = a.y > b.y || (!(a.y < b.y) && a.x < b.x);
  }
  return high + low;
}

}  // namespace

WindingNumber::WindingNumber(const Surface& surface, const std::vector<bool>& chosen)
    : steps_per_m_(grid_of(surface)),
      projected_(project_all(surface, steps_per_m_)),
      tree_(boxes_of(projected_, surface, chosen)) {
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    if (chosen.empty() || chosen[f]) triangles_.push_back({{face[0], face[1], face[2]}});
  }
}

int WindingNumber::at(Point p) const {
  const Point q = project(p, steps_per_m_);
  found_.clear();
  tree_.overlaps({q, {q.x, q.y, std::numeric_limits<double>::infinity()}}, found_);
  int winding = 0;
  for (const uint32_t t : found_) {
    const uint32_t* c = triangles_[t].corner;
    bool left[3];
    const Point a = projected_[c[0]], b = projected_[c[1]], d = projected_[c[2]];
    const double wa = edge_area(b, d, q, left[0]), wb = edge_area(d, a, q, left[1]),
                 wd = edge_area(a, b, q, left[2]);
    if (left[0] != left[1] || left[1] != left[2]) continue;
    const double above = wa * (a.z - q.z) + wb * (b.z - q.z) +
                         wd * (d.z - q.z);  // the height of the crossing times the area
    if (left[0] ? above > 0 : above < 0) winding += left[0] ? 1 : -1;
  }
  return winding;
}

}  // namespace firmtouch::tools
