#pragma once
#include <algorithm>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// Squared distance to a segment, which may be a point.
inline double distance2_to_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
  const Point rest = p - (a + along * t);
  return dot(rest, rest);
}

/// Squared distance to a triangle: of the plane where the foot lies within, else of the nearest
/// side. Nothing is lost on slivers.
inline double distance2_to_triangle(Point p, Point a, Point b, Point c) {
  const Point n = cross(b - a, c - a);
  const double size2 = dot(n, n);
  const bool is_within = size2 > 0 && dot(cross(b - a, p - a), n) >= 0 &&
                         dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  if (is_within) {
    const double height = dot(p - a, n);
    return height * height / size2;
  }
  return std::min({distance2_to_segment(p, a, b), distance2_to_segment(p, b, c),
                   distance2_to_segment(p, c, a)});
}

}  // namespace firmtouch::tools
