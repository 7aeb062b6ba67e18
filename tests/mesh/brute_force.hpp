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
inline math::Vec3 narrow(Point p) { return tools::to_vec3(p); }

inline tools::Surface moved(tools::Surface surface, double scale, Point shift) {
  for (math::Vec3& v : surface.vertices) v = narrow(wide(v) * scale + shift);
  return surface;
}

struct Truth {
  double distance = 0;  // unsigned
  bool inside = false;
};

/// Angles from -pi to pi added as the product of complex numbers, whose turns are counted: a sum of
/// arc tangents without their time.
class AngleSum {
 public:
  void add(double x, double y) {  // of the direction (x, y)
    const double re = x_ * x - y_ * y, im = x_ * y + y_ * x;
    const double size = std::fabs(re) + std::fabs(im);
    if (!(size > 0)) return;  // no direction: on a corner or an edge
    if (y >= 0 && y_ >= 0 && im < 0) turns_ += 1;
    if (y < 0 && y_ < 0 && im >= 0) turns_ -= 1;
    x_ = re / size, y_ = im / size;
  }
  double total() const { return 2 * M_PI * turns_ + std::atan2(y_, x_); }

 private:
  double x_ = 1, y_ = 0;
  int turns_ = 0;
};

class BruteForce {
 public:
  explicit BruteForce(const tools::Surface& surface) : surface_(surface) {
    for (const tools::Face& f : surface.faces)
      reach_.push_back(std::max(length(at(f[1]) - at(f[0])), length(at(f[2]) - at(f[0]))));
  }

  Truth operator()(Point p) const {
    struct Seen {
      Point from_p;
      double distance;
    };
    std::vector<Seen> seen;
    seen.reserve(surface_.vertices.size());
    for (uint32_t i = 0; i < surface_.vertices.size(); ++i)
      seen.push_back({at(i) - p, length(at(i) - p)});
    double best = 1e300;
    AngleSum winding;
    for (size_t i = 0; i < surface_.faces.size(); ++i) {
      const tools::Face& f = surface_.faces[i];
      const auto& [u, lu] = seen[f[0]];
      const auto& [v, lv] = seen[f[1]];
      const auto& [w, lw] = seen[f[2]];
      winding.add(lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv,
                  dot(u, cross(v, w)));
      if (lu * (1 - 1e-14) - reach_[i] * (1 + 1e-14) > best) continue;  // no point of it is nearer
      best = std::min(best, length(closest_of(p, at(f[0]), at(f[1]), at(f[2])) - p));
    }
    return {best, winding.total() > M_PI};
  }

 private:
  Point at(uint32_t vertex) const { return wide(surface_.vertices[vertex]); }

  const tools::Surface& surface_;
  std::vector<double> reach_;  // of each face's first corner to its farthest point
};
inline Truth brute_force(const tools::Surface& surface, Point p) { return BruteForce(surface)(p); }

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
    queries.push_back(narrow(p));
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
