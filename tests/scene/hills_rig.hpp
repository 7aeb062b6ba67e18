#pragma once
// Blocks with a level or hilly top, and a hand that goes around on them.
#include <cmath>
#include <vector>

#include "scene/proxy_rig.hpp"

namespace firmtouch::scene_test {

// A block of 0.1 x 0.1 m, of 2 n^2 triangles on its top, whose height is `z_m(x, y)`.
template <class Height>
tools::Surface hilly(int n, const Height& z_m) {
  tools::Surface surface;
  const auto add = [&](double x, double y, double z) {
    surface.vertices.push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    return static_cast<uint32_t>(surface.vertices.size() - 1);
  };
  const auto at = [n](int i, int j) { return static_cast<uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 0.1 * i / n - 0.05, y = 0.1 * j / n - 0.05;
      add(x, y, z_m(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      surface.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::vector<uint32_t> rim, low;
  for (int i = 0; i < n; ++i) rim.push_back(at(i, 0));
  for (int j = 0; j < n; ++j) rim.push_back(at(n, j));
  for (int i = n; i > 0; --i) rim.push_back(at(i, n));
  for (int j = n; j > 0; --j) rim.push_back(at(0, j));
  for (const uint32_t v : rim)
    low.push_back(
        add(ProxyRig::wide(surface.vertices[v].x), ProxyRig::wide(surface.vertices[v].y), -0.03));
  const uint32_t middle = add(0, 0, -0.03);
  for (size_t k = 0; k < rim.size(); ++k) {
    const size_t next = (k + 1) % rim.size();
    surface.faces.push_back({rim[k], low[k], low[next]});
    surface.faces.push_back({rim[k], low[next], rim[next]});
    surface.faces.push_back({middle, low[next], low[k]});
  }
  return surface;
}

inline double flat(double, double) { return 0; }
inline double hills(double x, double y) { return 0.004 * std::sin(80 * x) * std::cos(60 * y); }

// Comes down in 100 ticks, then goes around at `step_m` a tick, 2 mm deeper than `top_m`.
inline Vec3 round_hand(uint32_t tick, double step_m, double top_m) {
  const double turn = tick < 100 ? 0 : (tick - 100) * step_m / 0.03;
  const double z = tick < 100 ? top_m + 0.008 - 0.0001 * tick : top_m - 0.002;
  return {static_cast<float>(0.03 * std::cos(turn)), static_cast<float>(0.03 * std::sin(turn)),
          static_cast<float>(z)};
}

}  // namespace firmtouch::scene_test
