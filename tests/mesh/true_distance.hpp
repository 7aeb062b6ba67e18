#pragma once
#include <algorithm>
#include <cmath>

#include "brute_force.hpp"

namespace firmtouch::mesh_test {

// Ericson's region tests lose a sliver of height 1e-6 even in double. Here: the nearest of the
// three sides and, where the foot lies inside, the plane, in an orthonormal frame of the triangle
// and 64 bits of mantissa.
inline double true_distance(Point p, Point a, Point b, Point c) {
  using Wide = long double;
  struct W {
    Wide x, y, z;
  };
  const auto from_p = [&](Point v) { return W{Wide{v.x} - p.x, Wide{v.y} - p.y, Wide{v.z} - p.z}; };
  const auto times = [](W u, W v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
  const auto minus = [](W u, W v, Wide s) {
    return W{u.x - v.x * s, u.y - v.y * s, u.z - v.z * s};
  };
  const W corners[3] = {from_p(a), from_p(b), from_p(c)};
  Wide best2 = 1e300L;
  for (int k = 0; k < 3; ++k) {
    const W from = corners[k], side = minus(corners[(k + 1) % 3], from, 1);
    const Wide t = std::min(Wide{1}, std::max(Wide{0}, -times(from, side) / times(side, side)));
    const W foot = minus(from, side, -t);
    best2 = std::min(best2, times(foot, foot));
  }
  const W ab = minus(corners[1], corners[0], 1), ac = minus(corners[2], corners[0], 1);
  const Wide l2 = times(ab, ab), x = -times(corners[0], ab) / l2, xc = times(ac, ab) / l2;
  const W h = minus(ac, ab, xc), e = minus(corners[0], ab, -x);
  const Wide h2 = times(h, h);
  if (h2 > 0) {
    const Wide w = -times(e, h) / h2;
    if (w >= 0 && x - w * xc >= 0 && x + w * (1 - xc) <= 1) {
      const W foot = minus(e, h, -w);
      best2 = std::min(best2, times(foot, foot));
    }
  }
  return static_cast<double>(std::sqrt(best2));
}

}  // namespace firmtouch::mesh_test
