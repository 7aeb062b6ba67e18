#pragma once
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Closest point of a triangle. Source: Ericson 2005, "Real-time collision detection", 5.1.5.
inline Point closest_of(Point p, Point a, Point b, Point c) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp),
               d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

inline Point closest_by_force(const Surface& surface, Point p) {
  Point best;
  double least = 1e300;
  for (const Face& f : surface.faces) {
    const Point q = closest_of(p, to_point(surface.vertices[f[0]]),
                               to_point(surface.vertices[f[1]]), to_point(surface.vertices[f[2]]));
    const double distance2 = dot(q - p, q - p);
    if (distance2 < least) least = distance2, best = q;
  }
  return best;
}

}  // namespace firmtouch::tools
