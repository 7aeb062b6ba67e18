#pragma once
// Random NURBS of every kind that a file may hold: any degree, uneven and repeated knots, knots
// that do not touch the ends, weights or none.
#include <vector>

#include "spline/spline.hpp"
#include "surface/random.hpp"

namespace firmtouch::spline_test {

/// `most`: the highest multiplicity of an inner knot.
inline std::vector<double> random_knots(tools::Random& random, int degree, size_t points,
                                        int most) {
  std::vector<double> knots;
  const bool is_clamped = random.below(4) != 0;
  double at = random.between(-2, 2);
  uint32_t left = static_cast<uint32_t>(degree) + 1;  // of the present knot
  if (!is_clamped) left = 1;
  const size_t inner_end = points;  // knots[points] ends the range
  while (knots.size() < points + static_cast<size_t>(degree) + 1) {
    const bool is_last = is_clamped && knots.size() >= inner_end;
    if (!is_last && left == 0) {
      at += random.between(0.05, 0.4);
      left = 1 + random.below(static_cast<uint32_t>(most));
      if (knots.size() + left > inner_end) left = 1;
    }
    if (is_last && knots.size() == inner_end) at += 0.3;
    knots.push_back(at);
    if (left > 0) --left;
  }
  return knots;
}

inline tools::ControlPoint random_point(tools::Random& random, bool weighs) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1),
          weighs ? random.between(0.2, 5) : 1.0};
}

inline tools::SplineCurve random_curve(tools::Random& random, int degree, int most) {
  tools::SplineCurve curve;
  curve.degree = degree;
  const size_t points = static_cast<size_t>(degree) + 1 + random.below(12);
  const bool weighs = random.below(2) == 0;
  curve.knots = random_knots(random, degree, points, most);
  for (size_t i = 0; i < points; ++i) curve.points.push_back(random_point(random, weighs));
  curve.t0 = curve.knots[static_cast<size_t>(degree)];
  curve.t1 = curve.knots[points];
  return curve;
}

inline tools::SplineSurface random_surface(tools::Random& random, int degree_u, int degree_v,
                                           int most) {
  tools::SplineSurface s;
  s.degree_u = degree_u, s.degree_v = degree_v;
  s.count_u = static_cast<size_t>(degree_u) + 1 + random.below(5);
  s.count_v = static_cast<size_t>(degree_v) + 1 + random.below(5);
  s.knots_u = random_knots(random, degree_u, s.count_u, most);
  s.knots_v = random_knots(random, degree_v, s.count_v, most);
  const bool weighs = random.below(2) == 0;
  for (size_t i = 0; i < s.count_u * s.count_v; ++i)
    s.points.push_back(random_point(random, weighs));
  s.u0 = s.knots_u[static_cast<size_t>(degree_u)], s.u1 = s.knots_u[s.count_u];
  s.v0 = s.knots_v[static_cast<size_t>(degree_v)], s.v1 = s.knots_v[s.count_v];
  return s;
}

}  // namespace firmtouch::spline_test
