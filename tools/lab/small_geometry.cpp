#include "lab/small_geometry.hpp"

#include <cmath>

namespace firmtouch::lab {
namespace {

using tools::Point;

// The point nearest to the origin of the plane, line or point through `corners` (at most three).
// False: it lies outside of the corners, or they do not span it.
bool nearest_inside(const std::vector<Point>& corners, Point& nearest) {
  if (corners.size() == 1) return nearest = corners[0], true;
  if (corners.size() == 2) {
    const Point along = corners[1] - corners[0];
    const double t = -dot(corners[0], along), whole = dot(along, along);
    if (!(t > 0 && t < whole)) return false;
    return nearest = corners[0] + along * (t / whole), true;
  }
  const Point normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double size2 = dot(normal, normal);
  if (!(size2 > 0)) return false;
  nearest = normal * (dot(normal, corners[0]) / size2);
  for (size_t k = 0; k < 3; ++k) {
    const Point from = corners[k], to = corners[(k + 1) % 3];
    if (!(dot(cross(to - from, nearest - from), normal) > 0)) return false;
  }
  return true;
}

double volume(Point a, Point b, Point c) { return dot(a, cross(b, c)); }

bool holds_origin(const std::vector<Point>& s) {
  const double all = volume(s[1] - s[0], s[2] - s[0], s[3] - s[0]);
  if (!(std::fabs(all) > 0)) return false;
  for (size_t k = 0; k < 4; ++k) {
    std::vector<Point> with = s;
    with[k] = {};
    if (volume(with[1] - with[0], with[2] - with[0], with[3] - with[0]) / all < 0) return false;
  }
  return true;
}

// The nearest point of the simplex; it keeps the corners of the face on which that lies.
Point reduce(std::vector<Point>& simplex) {
  if (simplex.size() == 4 && holds_origin(simplex)) return {};
  double least = HUGE_VAL;
  Point best;
  std::vector<Point> kept;
  for (unsigned subset = 1; subset < 1u << simplex.size(); ++subset) {
    std::vector<Point> corners;
    for (size_t k = 0; k < simplex.size(); ++k)
      if (subset >> k & 1u) corners.push_back(simplex[k]);
    Point nearest;
    if (corners.size() > 3 || !nearest_inside(corners, nearest)) continue;
    if (dot(nearest, nearest) < least)
      least = dot(nearest, nearest), best = nearest, kept = corners;
  }
  simplex = kept;
  return best;
}

}  // namespace

// Jacobi's rotations of the covariance; the axis of the least variance.
Point normal_of_best_plane(const std::vector<Point>& points) {
  Point centre;
  for (const Point& p : points) centre = centre + p * (1.0 / static_cast<double>(points.size()));
  double m[3][3] = {}, axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Point& p : points) {
    const Point d = p - centre;
    const double v[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) m[i][k] += v[i] * v[k];
  }
  for (int turn = 0; turn < 60; ++turn) {
    const int p = turn % 3, q = (p + 1) % 3;
    if (!(std::fabs(m[p][q]) > 0)) continue;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    const auto rotate = [c, s](double& a, double& b) {
      const double was = a;
      a = c * was - s * b;
      b = s * was + c * b;
    };
    for (int k = 0; k < 3; ++k) rotate(m[k][p], m[k][q]);
    for (int k = 0; k < 3; ++k) rotate(m[p][k], m[q][k]);
    for (int k = 0; k < 3; ++k) rotate(axes[p][k], axes[q][k]);
  }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (m[k][k] < m[least][least]) least = k;
  return {axes[least][0], axes[least][1], axes[least][2]};
}

Point nearest_of_hull(const std::vector<Point>& points) {
  std::vector<Point> simplex{points[0]};
  Point nearest = points[0];
  for (size_t step = 0; step < 20 * points.size() + 100; ++step) {
    const double size2 = dot(nearest, nearest);
    if (!(size2 > 1e-28)) return {};
    const Point* farthest = &points[0];
    for (const Point& p : points)
      if (dot(p, nearest) < dot(*farthest, nearest)) farthest = &p;
    if (dot(*farthest, nearest) >= size2 * (1 - 1e-12)) return nearest;
    simplex.push_back(*farthest);
    const Point next = reduce(simplex);
    if (dot(next, next) >= size2) return nearest;  // rounding: no nearer
    nearest = next;
  }
  return nearest;
}

}  // namespace firmtouch::lab
