#include "spline/shell_sides.hpp"

#include <algorithm>
#include <cmath>

// By triangles: their signed volume says to which side a shell's normals point by itself, the solid
// angles that they cover from a point of another shell whether that lies within.

namespace firmtouch::tools {
namespace {

constexpr int kCuts = 6;        // of a surface between two knots
constexpr size_t kPlaces = 24;  // of a shell, where it is evaluated
constexpr double kDoubt = 0.2;  // a winding number farther from an integer decides nothing
constexpr double kPi = 3.14159265358979324;

struct Triangle {
  Point a, b, c;
};

std::vector<double> cuts_of(const std::vector<double>& knots, double low, double high) {
  std::vector<double> at;
  for (size_t k = 0; k + 1 < knots.size(); ++k) {
    const double from = std::max(knots[k], low), to = std::min(knots[k + 1], high);
    if (!(from < to)) continue;
    for (int i = at.empty() ? 0 : 1; i <= kCuts; ++i) at.push_back(from + (to - from) * i / kCuts);
  }
  return at;
}

void add_triangles(const SplineSurface& s, std::vector<Triangle>& triangles) {
  const std::vector<double> us = cuts_of(s.knots_u, s.u0, s.u1),
                            vs = cuts_of(s.knots_v, s.v0, s.v1);
  std::vector<Point> before, row;
  for (const double v : vs) {
    row.clear();
    for (const double u : us) row.push_back(point_at(s, u, v));
    for (size_t i = 0; i + 1 < before.size(); ++i) {
      Triangle low{before[i], before[i + 1], row[i + 1]}, high{before[i], row[i + 1], row[i]};
      if (s.is_turned) std::swap(low.b, low.c), std::swap(high.b, high.c);
      triangles.push_back(low);
      triangles.push_back(high);
    }
    before = row;
  }
}

double turns_about(const std::vector<Triangle>& triangles, const Point& p) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Point a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * kPi);
}

// Six times, from a point of its own.
double volume_of(const std::vector<Triangle>& triangles) {
  double sum = 0;
  const Point& from = triangles.front().a;
  for (const Triangle& t : triangles) sum += dot(t.a - from, cross(t.b - from, t.c - from));
  return sum;
}

// -1 where one shell lies within another, 1 where without, 0 where nearly as much within as
// without. Where they touch, rounding says which.
int crossing(const std::vector<Triangle>& own, const std::vector<Triangle>& other) {
  size_t within = 0, without = 0;
  for (size_t k = 0; k < kPlaces; ++k) {
    const Triangle& t = own[(2 * k + 1) * own.size() / (2 * kPlaces)];
    const double turns = std::abs(turns_about(other, (t.a + t.b + t.c) * (1.0 / 3)));
    if (std::abs(turns - std::round(turns)) > kDoubt) continue;  // it lies on the other
    (std::lround(turns) % 2 != 0 ? within : without) += 1;
  }
  if (within > 4 * without) return -1;
  return without > 4 * within ? 1 : 0;
}

}  // namespace

std::vector<int> sides_of_shells(const SplineModel& model,
                                 const std::vector<std::vector<size_t>>& shells) {
  std::vector<std::vector<Triangle>> triangles(shells.size());
  for (size_t i = 0; i < shells.size(); ++i)
    for (const size_t s : shells[i]) add_triangles(model.surfaces[s], triangles[i]);
  std::vector<int> sides;
  for (size_t i = 0; i < shells.size(); ++i) {
    int side = volume_of(triangles[i]) > 0 ? 1 : -1;
    for (size_t other = 0; other < shells.size(); ++other)
      if (other != i) side *= crossing(triangles[i], triangles[other]);
    sides.push_back(side);
  }
  return sides;
}

}  // namespace firmtouch::tools
