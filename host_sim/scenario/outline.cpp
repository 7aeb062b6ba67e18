#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host_sim/scenario/plan.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr size_t kPoints = 800;  // of the resulting line
constexpr int kSmoothings = 6;   // averaging passes, so that single triangles do not shake the hand

using EdgeKey = std::array<uint32_t, 2>;
EdgeKey key_of(uint32_t a, uint32_t b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

struct Cut {
  std::map<EdgeKey, Vec> point;                  // where the plane crosses an edge
  std::map<EdgeKey, std::vector<EdgeKey>> next;  // joined by a triangle
};

Vec vertex(const mesh::View& mesh, uint32_t i) {
  const mesh::Vertex& v = mesh.vertices()[i];
  return {static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)};
}

// A vertex on the plane counts as above it, so that every triangle has no or two crossings.
Cut cut_by(const mesh::View& mesh, Vec normal, double offset) {
  Cut cut;
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    std::vector<EdgeKey> crossed;
    for (size_t k = 0; k < 3; ++k) {
      const EdgeKey edge = key_of(t.corner[k], t.corner[(k + 1) % 3]);
      const Vec a = vertex(mesh, edge[0]), b = vertex(mesh, edge[1]);
      const double ha = dot(a, normal) - offset, hb = dot(b, normal) - offset;
      if ((ha >= 0) == (hb >= 0)) continue;
      cut.point[edge] = a + (b - a) * (ha / (ha - hb));
      crossed.push_back(edge);
    }
    if (crossed.size() != 2) continue;
    cut.next[crossed[0]].push_back(crossed[1]);
    cut.next[crossed[1]].push_back(crossed[0]);
  }
  return cut;
}

double length_of(const std::vector<Vec>& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += norm(line[i] - line[i - 1]);
  return length;
}

std::vector<Vec> longest_loop(Cut& cut) {
  std::vector<Vec> best;
  double max_length = 0;
  std::map<EdgeKey, bool> seen;
  for (const auto& [first, at] : cut.point) {
    if (seen[first]) continue;
    std::vector<Vec> loop;
    for (EdgeKey here = first;;) {
      seen[here] = true;
      loop.push_back(cut.point[here]);
      const std::vector<EdgeKey>& ways = cut.next[here];
      const auto way =
          std::find_if(ways.begin(), ways.end(), [&](const EdgeKey& e) { return !seen[e]; });
      if (way == ways.end()) break;
      here = *way;
    }
    loop.push_back(loop.front());
    const double length = length_of(loop);
    if (length > max_length) max_length = length, best = std::move(loop);
  }
  return best;
}

std::vector<Vec> resample(const std::vector<Vec>& line, size_t count) {
  const double step = length_of(line) / static_cast<double>(count);
  std::vector<Vec> even{line.front()};
  double length_so_far = 0;
  for (size_t i = 1; i < line.size(); ++i) {
    const double span = norm(line[i] - line[i - 1]);
    while (span > 0 && length_so_far + span >= step * static_cast<double>(even.size()) &&
           even.size() < count)
      even.push_back(line[i - 1] +
                     (line[i] - line[i - 1]) *
                         ((step * static_cast<double>(even.size()) - length_so_far) / span));
    length_so_far += span;
  }
  return even;
}

}  // namespace

std::vector<Vec> outline(const Environment& environment, double height_m) {
  if (!environment.has_mesh()) return {};
  const mesh::Head& head = environment.mesh().head();
  double extent[3], middle[3];
  for (size_t k = 0; k < 3; ++k) {
    extent[k] = static_cast<double>(head.high_m[k]) - static_cast<double>(head.low_m[k]);
    middle[k] = (static_cast<double>(head.high_m[k]) + static_cast<double>(head.low_m[k])) / 2;
  }
  // Across the shortest side: that plane gives the longest loop.
  const size_t thin = static_cast<size_t>(std::min_element(extent, extent + 3) - extent);
  const Vec normal = {thin == 0 ? 1.0 : 0.0, thin == 1 ? 1.0 : 0.0, thin == 2 ? 1.0 : 0.0};
  Cut cut = cut_by(environment.mesh(), normal, middle[thin]);
  std::vector<Vec> loop = longest_loop(cut);
  if (loop.size() < 4) return {};
  loop = resample(loop, kPoints);
  for (Vec& p : loop) {
    const Environment::Surface surface =
        environment.nearest(environment.meshes().front().to_device(p));
    p = surface.point_m - environment.scene_m() + surface.normal * height_m;
  }
  for (int round = 0; round < kSmoothings; ++round) {
    std::vector<Vec> smooth(loop.size());
    for (size_t i = 0; i < loop.size(); ++i)
      smooth[i] =
          (loop[i] * 2 + loop[(i + 1) % loop.size()] + loop[(i + loop.size() - 1) % loop.size()]) *
          0.25;
    loop = std::move(smooth);
  }
  loop.push_back(loop.front());
  return loop;
}

}  // namespace firmtouch::host_sim
