#include "bench/segments.hpp"

#include <algorithm>
#include <cmath>

#include "surface/point.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {
namespace {

using tools::Point;

// `unit`: -1 to 1 is a box twice the model's.
math::Vec3 placed(const Model& model, const double (&unit)[3]) {
  const mesh::Head& head = model.view.head();
  float p[3];
  for (int k = 0; k < 3; ++k) {
    const double low = static_cast<double>(head.low_m[k]),
                 high = static_cast<double>(head.high_m[k]);
    p[k] = static_cast<float>((low + high) / 2 + unit[k] * (high - low));
  }
  return {p[0], p[1], p[2]};
}

}  // namespace

std::vector<FloatSegment> across_box(const Model& model, size_t count, uint64_t seed) {
  tools::Random random(seed);
  const auto on_side = [&](uint32_t side) {
    double at[3];
    for (double& x : at) x = random.between(-1, 1);
    at[side / 2] = side % 2 == 0 ? -1 : 1;
    return placed(model, at);
  };
  std::vector<FloatSegment> all;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t from = random.below(6);
    const uint32_t to = (from + 1 + random.below(5)) % 6;
    const math::Vec3 a_m = on_side(from);
    all.push_back({a_m, on_side(to)});
  }
  return all;
}

std::vector<FloatSegment> anywhere(const Model& model, size_t count, uint64_t seed) {
  tools::Random random(seed);
  const auto inside = [&] {
    double at[3];
    for (double& x : at) x = random.between(-0.55, 0.55);
    return placed(model, at);
  };
  std::vector<FloatSegment> all;
  for (size_t i = 0; i < count; ++i) {
    const math::Vec3 a_m = inside();
    all.push_back({a_m, inside()});
  }
  return all;
}

bool all_crossings_in_double(const tools::Surface& surface, const FloatSegment& segment,
                             std::vector<double>& t) {
  constexpr double kGrazing = 1e-9;
  const Point a = tools::to_point(segment.a_m), along = tools::to_point(segment.b_m) - a;
  for (const tools::Face& face : surface.faces) {
    const Point p = tools::to_point(surface.vertices[face[0]]) - a,
                q = tools::to_point(surface.vertices[face[1]]) - a,
                r = tools::to_point(surface.vertices[face[2]]) - a;
    const double x = dot(along, cross(p, q)), y = dot(along, cross(q, r)),
                 z = dot(along, cross(r, p));
    const double slack = kGrazing * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    const double low = std::min({x, y, z}), high = std::max({x, y, z});
    if (low < -slack && high > slack) continue;
    const double sum = x + y + z, at = dot(p, cross(q, r)) / sum;
    if (at < -1e-6 || at > 1 + 1e-6) continue;
    if (!(low > slack || high < -slack) || std::fabs(at) < 1e-6 || std::fabs(at - 1) < 1e-6)
      return false;
    t.push_back(at);
  }
  std::sort(t.begin(), t.end());
  return true;
}

}  // namespace firmtouch::bench
