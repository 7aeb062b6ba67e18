#include "host_sim/plant/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/triangle_distance.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr size_t kBlock = 32;
constexpr double kFar_m = std::numeric_limits<double>::infinity();

Vec corner(const mesh::View& mesh, uint32_t i) {
  const mesh::Vertex& v = mesh.vertices()[i];
  return {static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)};
}

Vec least(Vec a, Vec b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec most(Vec a, Vec b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

BruteForce::BruteForce(const mesh::View& mesh) {
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    const Vec a = corner(mesh, t.corner[0]), b = corner(mesh, t.corner[1]),
              c = corner(mesh, t.corner[2]);
    const Box box{least(least(a, b), c), most(most(a, b), c)};
    if (i % kBlock == 0)
      blocks_.push_back(box);
    else
      blocks_.back() = {least(blocks_.back().low_m, box.low_m),
                        most(blocks_.back().high_m, box.high_m)};
    triangles_.push_back({{a, b, c}, box});
  }
}

bool BruteForce::is_farther(const Box& box, Vec p, double distance2_m2) {
  const auto outside2 = [](double x, double low, double high) {
    const double off = std::max({low - x, x - high, 0.0});
    return off * off;
  };
  return outside2(p.x, box.low_m.x, box.high_m.x) + outside2(p.y, box.low_m.y, box.high_m.y) +
             outside2(p.z, box.low_m.z, box.high_m.z) >
         distance2_m2;
}

double BruteForce::distance_m(Vec p_m, size_t& nearest) const {
  double best = kFar_m;
  const auto measure = [&](size_t i) {
    const Triangle& t = triangles_[i];
    const double distance2_m2 =
        tools::distance2_to_triangle(p_m, t.corner_m[0], t.corner_m[1], t.corner_m[2]);
    if (distance2_m2 < best) best = distance2_m2, nearest = i;
  };
  if (nearest < triangles_.size()) measure(nearest);
  for (size_t block = 0; block < blocks_.size(); ++block) {
    if (is_farther(blocks_[block], p_m, best)) continue;
    const size_t end = std::min((block + 1) * kBlock, triangles_.size());
    for (size_t i = block * kBlock; i < end; ++i)
      if (!is_farther(triangles_[i].box, p_m, best)) measure(i);
  }
  return std::sqrt(best);
}

}  // namespace firmtouch::host_sim
