#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::tools {

/// A point or vector in double, for the offline tools.
struct Point {
  double x = 0, y = 0, z = 0;
};

inline Point to_point(math::Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline math::Vec3 to_vec3(Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point a) { return std::sqrt(dot(a, a)); }

/// Of the bounding box of points, of which there is at least one.
inline double diagonal_m(const std::vector<math::Vec3>& points_m) {
  Point low = to_point(points_m[0]), high = low;
  for (const math::Vec3& point_m : points_m) {
    const Point p = to_point(point_m);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

}  // namespace firmtouch::tools
