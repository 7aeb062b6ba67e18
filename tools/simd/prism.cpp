#include "simd/prism.hpp"

#include <algorithm>
#include <cmath>

#include "surface/point.hpp"

namespace firmtouch::simd {
using tools::Point;
using tools::to_point;
using tools::to_vec3;

namespace {

// A little less than mesh/prism.hpp counts with: what is proven here is computed in double.
constexpr double kMaxBeyond = 3 * 0x1p-24;

// As it is stored: rounding moves a unit vector by 0.87 units at most.
Point stored_direction(Point v) {
  const double l = length(v);
  return l > 0 ? to_point(to_vec3(v * (1 / l))) : Point{};
}

float rounded_up(double v) {
  const float f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, HUGE_VALF) : f;
}

}  // namespace

void put_prism(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m, float (&row)[kPrismArrays]) {
  const Point a = to_point(a_m), b = to_point(b_m), c = to_point(c_m);
  const Point ab = b - a, ac = c - a, bc = c - b;
  const double max_beyond = kMaxBeyond * std::max({length(ab), length(ac), length(bc)});
  const auto put = [&row](uint32_t k, Point p) {
    const math::Vec3 v = to_vec3(p);
    row[k] = v.x, row[k + 1] = v.y, row[k + 2] = v.z;
  };
  Point n = stored_direction(cross(ab, ac));
  if (!(std::max(std::fabs(dot(n, ab)), std::fabs(dot(n, ac))) <= max_beyond)) n = {};
  put(0, a);
  put(3, n);
  row[15] = 0;
  const Point edge[] = {ab, ac * -1, bc};
  for (uint32_t k = 0; k < 3; ++k) {
    Point s = stored_direction(cross(edge[k], n));
    const double beyond = std::max({0.0, dot(s, ab), dot(s, ac)});
    if (k == 2)
      row[15] = rounded_up(beyond);
    else if (!(beyond <= max_beyond))
      s = {};
    put(6 + 3 * k, s);
  }
}

}  // namespace firmtouch::simd
