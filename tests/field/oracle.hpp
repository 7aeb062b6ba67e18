#pragma once
// Distance by brute force in double, sharing no code with the tools: each point against each
// triangle.
#include <algorithm>
#include <cmath>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

inline double oracle_segment(Point p, Point a, Point b) {
  const Point ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return length(p - (a + ab * t));
}

/// The least of the plane's, where its foot lies within, and the three edges'.
inline double oracle_triangle(Point p, Point a, Point b, Point c) {
  const Point n = cross(b - a, c - a);
  const double n2 = dot(n, n);
  double least =
      std::min({oracle_segment(p, a, b), oracle_segment(p, b, c), oracle_segment(p, c, a)});
  const double u = dot(cross(c - b, p - b), n), v = dot(cross(a - c, p - c), n);
  const double w = dot(cross(b - a, p - a), n);
  if (u >= 0 && v >= 0 && w >= 0) least = std::min(least, std::fabs(dot(p - a, n)) / std::sqrt(n2));
  return least;
}

inline double oracle_distance(const Surface& surface, Point p) {
  double least = 1e300;
  for (const Face& f : surface.faces)
    least = std::min(
        least, oracle_triangle(p, to_point(surface.vertices[f[0]]),
                               to_point(surface.vertices[f[1]]), to_point(surface.vertices[f[2]])));
  return least;
}

}  // namespace firmtouch::tools
