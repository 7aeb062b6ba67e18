#include "spline/sample_splines.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/math/elementary.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {

SplineCurve winding_curve(uint64_t seed, size_t n, bool is_planar, bool weighs) {
  Random random(seed);
  SplineCurve c;
  c.degree = 3;
  for (int k = 0; k < 4; ++k) c.knots.push_back(0);
  for (size_t k = 4; k < n; ++k)
    c.knots.push_back((static_cast<double>(k) - 3 + random.between(-0.3, 0.3)) /
                      (static_cast<double>(n) - 3));
  for (int k = 0; k < 4; ++k) c.knots.push_back(1);
  double x = 0.5, y = 0.5, heading = 0;
  for (size_t i = 0; i < n; ++i) {
    c.points.push_back(
        {x, y, is_planar ? 0 : random.between(0, 1), weighs ? random.between(0.4, 2.5) : 1});
    heading += random.between(-1.2, 2.2);
    const double step = random.between(0.1, 0.45);
    const auto inside = [](double to) { return to < 0 ? -to : to > 1 ? 2 - to : to; };
    const auto angle_rad = static_cast<float>(heading);
    x = inside(x + step * static_cast<double>(math::cosine(angle_rad)));
    y = inside(y + step * static_cast<double>(math::sine(angle_rad)));
  }
  return c;
}

SplineSurface hilly_surface(uint64_t seed, size_t n, double rise, bool weighs) {
  Random random(seed);
  SplineSurface s;
  s.degree_u = s.degree_v = 3;
  s.count_u = s.count_v = n;
  for (int k = -3; k <= static_cast<int>(n); ++k)
    s.knots_u.push_back(std::clamp(static_cast<double>(k), 0.0, static_cast<double>(n) - 3));
  s.knots_v = s.knots_u;
  s.u1 = s.v1 = static_cast<double>(n) - 3;
  const double last = static_cast<double>(n) - 1;
  for (size_t j = 0; j < n; ++j)
    for (size_t i = 0; i < n; ++i)
      s.points.push_back({static_cast<double>(i) / last, static_cast<double>(j) / last,
                          random.between(-rise, rise), weighs ? random.between(0.5, 2) : 1});
  return s;
}

std::vector<Point> wandering_path(uint64_t seed, size_t positions, double step, double low_z,
                                  double high_z) {
  Random random(seed);
  std::vector<Point> path;
  Point at{0.5, 0.5, 0.5 * (low_z + high_z)}, heading{1, 0, 0};
  for (size_t k = 0; k < positions; ++k) {
    path.push_back(at);
    const bool flat = !(high_z > low_z);
    heading = heading + Point{random.bell(), random.bell(), flat ? 0 : random.bell()} * 0.08;
    heading = heading * (1 / length(heading));
    at = at + heading * step;
    const auto turn = [](double& x, double& h, double low, double high) {
      if (x < low || x > high) h = x < low ? std::fabs(h) : -std::fabs(h);
      x = std::clamp(x, low, high);
    };
    turn(at.x, heading.x, -0.2, 1.2);
    turn(at.y, heading.y, -0.2, 1.2);
    if (!flat) turn(at.z, heading.z, low_z, high_z);
  }
  return path;
}

std::vector<Point> path_about(const std::vector<Point>& path, Point low, Point high) {
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const Point middle = (low + high) * 0.5;
  std::vector<Point> points;
  for (const Point& p : path) {
    const Point d = (p - Point{0.5, 0.5, 0.5}) * extent;
    points.push_back(middle + (high.z > low.z ? d : Point{d.x, d.y, 0}));
  }
  return points;
}

}  // namespace firmtouch::tools
