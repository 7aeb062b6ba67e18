#pragma once
// The oracle: brute force in double. Distance by Ericson's region tests, side by the winding
// number: no part of the library's method.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "surface/check/check.hpp"
#include "surface/closest_by_force.hpp"
#include "surface/random.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/surface.hpp"

namespace firmtouch::mesh_test {

using tools::Point;
using tools::Random;
inline Point wide(math::Vec3 v) { return tools::to_point(v); }

struct Truth {
  double distance = 0;  // unsigned
  bool inside = false;
};

inline Truth brute_force(const tools::Surface& surface, Point p) {
  double best2 = 1e300, winding = 0;
  for (const tools::Face& f : surface.faces) {
    const Point a = wide(surface.vertices[f[0]]), b = wide(surface.vertices[f[1]]),
                c = wide(surface.vertices[f[2]]);
    const Point r = closest_of(p, a, b, c) - p;
    best2 = std::min(best2, dot(r, r));
    const Point u = a - p, v = b - p, w = c - p;
    const double lu = length(u), lv = length(v), lw = length(w);
    winding += std::atan2(dot(u, cross(v, w)),
                          lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv);
  }
  return {std::sqrt(best2), winding > M_PI};
}

inline double diagonal(const tools::Surface& surface) {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const math::Vec3& v : surface.vertices) {
    low = {std::min(low.x, double{v.x}), std::min(low.y, double{v.y}),
           std::min(low.z, double{v.z})};
    high = {std::max(high.x, double{v.x}), std::max(high.y, double{v.y}),
            std::max(high.z, double{v.z})};
  }
  return length(high - low);
}

/// Queries where it hurts: beside faces, edges and vertices at distances down to nothing, all
/// around, and far away.
inline std::vector<math::Vec3> hard_queries(const tools::Surface& surface, size_t count,
                                            uint64_t seed) {
  Random random(seed);
  const double size = diagonal(surface);
  Point centre{};
  for (const math::Vec3& v : surface.vertices)
    centre = centre + wide(v) * (1.0 / static_cast<double>(surface.vertices.size()));
  std::vector<math::Vec3> queries;
  for (size_t i = 0; i < count; ++i) {
    const tools::Face& f = surface.faces[random.below(static_cast<uint32_t>(surface.faces.size()))];
    const Point a = wide(surface.vertices[f[0]]), b = wide(surface.vertices[f[1]]),
                c = wide(surface.vertices[f[2]]);
    double u = random.between(0, 1), v = random.between(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (i % 5 == 1) v = 0;
    if (i % 5 == 2) u = v = 0;
    Point p = a + (b - a) * u + (c - a) * v;
    const double reach = size * std::pow(10.0, random.between(-7, -1));
    const Point shift{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    if (i % 5 < 3) p = p + shift * reach;
    if (i % 5 == 3) p = centre + shift * (0.75 * size);
    if (i % 5 == 4) p = centre + shift * (size * std::pow(10.0, random.between(0, 4)));
    queries.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  return queries;
}

/// Folder of real models, or empty: those tests are then left out (and said to be, by tools/test).
inline std::string models_folder() {
  const char* folder = std::getenv("FIRMTOUCH_MODELS");
  return folder == nullptr ? std::string() : folder;
}
inline bool long_run() { return std::getenv("FIRMTOUCH_LONG") != nullptr; }

/// A model of that folder, mended as the baker does it; no faces where it is not there.
inline tools::Surface real_model(const std::string& file) {
  if (models_folder().empty()) return {};
  tools::Imported imported =
      tools::read_surface((std::filesystem::path(models_folder()) / file).string(), 1.0);
  if (!imported.problem.empty()) return {};
  const tools::CheckReport report = tools::check_and_mend(imported.surface, {});
  return report.usable() ? imported.surface : tools::Surface{};
}

}  // namespace firmtouch::mesh_test
