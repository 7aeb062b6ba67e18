#include "footpoint/curve_system.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr double kRounding = 64 * 2.3e-16;

Point point_of(const Points& f, double t) {
  std::vector<Point> level = f.c;
  for (size_t r = 1; r < level.size(); ++r)
    for (size_t i = 0; i + r < level.size(); ++i) level[i] = level[i] * (1 - t) + level[i + 1] * t;
  return level[0];
}

}  // namespace

CurveSystem::CurveSystem(const BezierCurve& curve) : piece(curve) {
  const ControlPoint& first = curve.points.front();
  origin = {first.x, first.y, first.z};
  const bool weighs = is_rational(curve.points);
  Points x(curve.degree, 0);
  Scalars w(curve.degree, 0);
  for (size_t i = 0; i < curve.points.size(); ++i) {
    const ControlPoint& p = curve.points[i];
    w.c[i] = weighs ? p.w : 1;
    x.c[i] = (Point{p.x, p.y, p.z} - origin) * w.c[i];
  }
  const Points tangent = weighs
                             ? difference(product(derivative_u(x), w), product(x, derivative_u(w)))
                             : derivative_u(x);
  a = dot_product(x, tangent);
  b = product(tangent, w);  // weights of 1 raise the degree
  a_slope = derivative_u(a);
  b_slope = derivative_u(b);
  for (size_t i = 0; i < a.c.size(); ++i) {
    scale_a = std::max(scale_a, std::fabs(a.c[i]));
    scale_b = std::max(scale_b, length(b.c[i]));
  }
}

std::vector<double> CurveSystem::coefficients(Point p_m) const {
  const Point q = p_m - origin;
  std::vector<double> f(a.c.size());
  for (size_t i = 0; i < f.size(); ++i) f[i] = a.c[i] - dot(q, b.c[i]);
  return f;
}

double CurveSystem::noise(Point p_m) const {
  return kRounding * (scale_a + length(p_m - origin) * scale_b);
}

void CurveSystem::value(Point p_m, double t, double& f, double& slope) const {
  const Point q = p_m - origin;
  f = value_at(a, t, 0) - dot(q, point_of(b, t));
  slope = value_at(a_slope, t, 0) - dot(q, point_of(b_slope, t));
}

Point CurveSystem::gradient(double t) const { return point_of(b, t); }

}  // namespace firmtouch::tools
