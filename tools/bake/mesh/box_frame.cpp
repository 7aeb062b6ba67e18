#include "bake/mesh/box_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// A frame along the axes costs nothing: another one must have less than this part of its area.
constexpr double kMinGain = 0.8;
constexpr size_t kMaxFrames = 48;
// Axes whose cosine exceeds this are tried once.
constexpr double kSameAxis = 0.9999;
// The middle of what mesh::is_sound() accepts.
constexpr double kAxisLength = 1 - 0.75 * 0x1p-15;

Point at(const Surface& surface, uint32_t vertex) { return to_point(surface.vertices[vertex]); }
Point unit(Point v) { return v * (1 / length(v)); }

double box_area(const Surface& surface, const Frame& frame, double margin_m) {
  std::vector<Point> framed;
  for (const math::Vec3& v : surface.vertices) framed.push_back(along(frame, to_point(v)));
  double sum = 0;
  for (const Face& face : surface.faces)
    sum += half_box_area(framed[face[0]], framed[face[1]], framed[face[2]], margin_m);
  return sum;
}

// Along a face and its edge k.
Frame frame_of(const Surface& surface, const Face& face, size_t k) {
  const Point a = at(surface, face[k]), b = at(surface, face[(k + 1) % 3]),
              c = at(surface, face[(k + 2) % 3]);
  const Point along = unit(b - a), normal = unit(cross(b - a, c - a));
  return {{along, cross(normal, along), normal}};
}

// Of the largest faces, the largest first.
std::vector<Frame> candidates(const Surface& surface) {
  std::vector<double> area(surface.faces.size());
  for (size_t f = 0; f < area.size(); ++f) {
    const Face& face = surface.faces[f];
    const Point a = at(surface, face[0]);
    area[f] = length(cross(at(surface, face[1]) - a, at(surface, face[2]) - a));
  }
  std::vector<size_t> order(area.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t f, size_t g) {
    return area[f] > area[g] || (!(area[g] > area[f]) && f < g);
  });
  std::vector<Frame> frames;
  for (const size_t f : order)
    for (size_t k = 0; k < 3 && frames.size() < kMaxFrames; ++k) {
      const Frame frame = frame_of(surface, surface.faces[f], k);
      const bool is_known = std::any_of(frames.begin(), frames.end(), [&](const Frame& other) {
        return std::fabs(dot(frame.axis[0], other.axis[0])) > kSameAxis &&
               std::fabs(dot(frame.axis[2], other.axis[2])) > kSameAxis;
      });
      if (!is_known) frames.push_back(frame);
    }
  return frames;
}

}  // namespace

double half_box_area(Point a, Point b, Point c, double margin_m) {
  const auto side = [margin_m](double x, double y, double z) {
    return std::max({x, y, z}) - std::min({x, y, z}) + margin_m;
  };
  const double x = side(a.x, b.x, c.x), y = side(a.y, b.y, c.y), z = side(a.z, b.z, c.z);
  return x * y + y * z + z * x;
}

std::optional<Frame> best_box_frame(const Surface& surface) {
  const double margin_m = kBoxMargin * diagonal_m(surface.vertices);
  double least = kMinGain * box_area(surface, {}, margin_m);
  std::optional<Frame> best;
  for (const Frame& frame : candidates(surface)) {
    const double area = box_area(surface, frame, margin_m);
    if (area < least) least = area, best = frame;
  }
  return best;
}

mesh::BoxFrame stored(const Frame& frame, const Surface& surface) {
  Point low = at(surface, 0), high = low;
  for (const math::Vec3& v : surface.vertices) {
    low = {std::min(low.x, double{v.x}), std::min(low.y, double{v.y}),
           std::min(low.z, double{v.z})};
    high = {std::max(high.x, double{v.x}), std::max(high.y, double{v.y}),
            std::max(high.z, double{v.z})};
  }
  const math::Vec3 centre_m = to_vec3((low + high) * 0.5);
  mesh::BoxFrame stored{{centre_m.x, centre_m.y, centre_m.z}, {}};
  for (size_t k = 0; k < 3; ++k) {
    const math::Vec3 axis = to_vec3(frame.axis[k] * kAxisLength);
    stored.axis[k][0] = axis.x, stored.axis[k][1] = axis.y, stored.axis[k][2] = axis.z;
  }
  return stored;
}

Surface in_box_frame(const Surface& surface, const mesh::BoxFrame& frame) {
  Surface framed = surface;
  for (math::Vec3& v : framed.vertices) v = mesh::turned(frame, v);
  return framed;
}

}  // namespace firmtouch::tools
