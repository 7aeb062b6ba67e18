#include "spline/make_walk_about.hpp"

#include <algorithm>
#include <cmath>

#include "spline/sample_splines.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kStep = 0.002;  // of the extent
constexpr int kSamples = 16;     // of a piece, in one direction

std::vector<Point> points_on(const SplineModel& model) {
  const auto share = [](int i) { return static_cast<double>(i) / kSamples; };
  std::vector<Point> points;
  for (const SplineCurve& curve : model.curves)
    for (const BezierCurve& piece : bezier_pieces(curve))
      for (int i = 0; i <= kSamples; ++i) points.push_back(point_at(piece, share(i)));
  for (const SplineSurface& surface : model.surfaces)
    for (const BezierPatch& piece : bezier_pieces(surface))
      for (int i = 0; i <= kSamples; ++i)
        for (int j = 0; j <= kSamples; ++j) points.push_back(point_at(piece, share(i), share(j)));
  return points;
}

}  // namespace

std::vector<math::Vec3> make_walk_about(const SplineModel& model, uint64_t seed, uint32_t points) {
  const std::vector<Point> on_it = points_on(model);
  Point low = on_it[0], high = low;
  for (const Point p : on_it) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const bool is_flat = model.surfaces.empty() && !(high.z > low.z);
  // About a surface without height the walk does not stay in its plane.
  if (!is_flat && !(high.z > low.z)) high.z = std::nextafter(low.z, HUGE_VAL);
  const std::vector<Point> path =
      wandering_path(seed, points, kStep, is_flat ? 0.5 : -0.2, is_flat ? 0.5 : 1.2);
  std::vector<math::Vec3> walk;
  for (const Point p : path_about(path, low, high)) walk.push_back(to_vec3(p));
  return walk;
}

}  // namespace firmtouch::tools
