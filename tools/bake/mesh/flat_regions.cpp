#include "bake/mesh/flat_regions.hpp"

#include <algorithm>
#include <numeric>

#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// Corners of a region may be farther from the plane of its first face, which is that of three
// rounded corners, than from its own.
constexpr double kFirstPlane = 2;

class Finder {
 public:
  Finder(const Surface& surface, const std::vector<uint32_t>& mates, double max_m)
      : surface_(surface), mates_(mates), max_m_(max_m) {
    regions_.of_face.assign(surface.faces.size(), kNone);
    for (const Face& face : surface.faces) normals_.push_back(normal_of(face));
  }

  FlatRegions find() {
    std::vector<uint32_t> order(normals_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [this](uint32_t f, uint32_t g) {
      const double x = dot(normals_[f], normals_[f]), y = dot(normals_[g], normals_[g]);
      return x > y || (!(y > x) && f < g);
    });
    for (const uint32_t f : order)
      if (regions_.of_face[f] == kNone && length(normals_[f]) > 0) grow(f);
    return std::move(regions_);
  }

 private:
  Point at(uint32_t vertex) const { return to_point(surface_.vertices[vertex]); }
  Point normal_of(const Face& face) const {
    return cross(at(face[1]) - at(face[0]), at(face[2]) - at(face[0]));
  }

  // How far the corners of `faces`, and `origin`, lie apart along `normal`.
  double span_m(const std::vector<uint32_t>& faces, Point normal, Point origin) const {
    const Point n = normal * (1 / length(normal));
    double low = 0, high = 0;
    for (const uint32_t f : faces)
      for (const uint32_t corner : surface_.faces[f]) {
        const double off = dot(at(corner) - origin, n);
        low = std::min(low, off), high = std::max(high, off);
      }
    return high - low;
  }

  void grow(uint32_t seed) {
    const auto region = static_cast<uint32_t>(regions_.thickness_m.size());
    const Point origin = at(surface_.faces[seed][0]), normal = normals_[seed];
    std::vector<uint32_t> faces{seed};
    Point sum;
    regions_.of_face[seed] = region;
    for (size_t i = 0; i < faces.size(); ++i) {
      sum = sum + normals_[faces[i]];
      for (uint32_t h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
        if (mates_[h] == kNone) continue;
        const uint32_t next = mates_[h] / 3;
        if (regions_.of_face[next] != kNone || !(dot(normals_[next], normal) > 0)) continue;
        if (!(span_m({next}, normal, origin) <= kFirstPlane * max_m_)) continue;
        regions_.of_face[next] = region;
        faces.push_back(next);
      }
    }
    const double thickness_m = span_m(faces, sum, origin) * (1 + 0x1p-20);
    if (faces.size() > 1 && thickness_m <= max_m_)
      return regions_.thickness_m.push_back(thickness_m);
    for (const uint32_t f : faces) regions_.of_face[f] = kNone;
  }

  const Surface& surface_;
  const std::vector<uint32_t>& mates_;
  double max_m_;
  std::vector<Point> normals_;
  FlatRegions regions_;
};

}  // namespace

FlatRegions flat_regions(const Surface& surface, const std::vector<uint32_t>& mates, double max_m) {
  return Finder(surface, mates, max_m).find();
}

}  // namespace firmtouch::tools
