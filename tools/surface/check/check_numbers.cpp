#include <algorithm>
#include <cstdio>

#include "surface/check/mending.hpp"
#include "surface/edges.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kSmallestExtent_m = 1e-6, kLargestExtent_m = 1e6;

// 1e-6 m as float32 is a little less, and an extent is the difference of two such roundings.
constexpr double kOfTheLimit = 1e-6;

// Float32 rounds a coordinate by up to 6e-8 of its size. Where that exceeds this share of the mean
// edge, the edges' directions are off by about as many radians (0.6 degrees) and the shape is no
// longer the one that was drawn.
constexpr double kRoundingOfEdge = 0.01;

bool is_finite(const math::Vec3& v) { return v.x - v.x <= 0 && v.y - v.y <= 0 && v.z - v.z <= 0; }

std::string metres(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g m", value);
  return text;
}

}  // namespace

void refuse_bad_numbers(const Surface& surface, CheckReport& report) {
  if (surface.faces.empty()) {
    report.refused.push_back("has no faces: export it as a mesh");
    return;
  }
  uint32_t count = 0, first = 0;
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    if (is_finite(surface.vertices[v])) continue;
    if (count++ == 0) first = v;
  }
  if (count != 0) {
    report.refused.push_back(counted(count, "vertex has", "vertices have") +
                             " coordinates that are not finite, first vertex " +
                             std::to_string(first) + ": mend or remove them");
  }
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    for (const uint32_t v : surface.faces[f]) {
      if (v < surface.vertices.size()) continue;
      report.refused.push_back("face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                               " of " + std::to_string(surface.vertices.size()) +
                               ": its index is out of range");
      return;
    }
  }
}

void refuse_bad_size(const Surface& surface, CheckReport& report) {
  if (surface.faces.empty()) {
    if (report.usable()) report.refused.push_back("has no face with an area: is it a mesh?");
    return;
  }
  Point low = to_point(surface.vertices[0]), high = low;
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double extent_m = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  if (!(extent_m >= kSmallestExtent_m * (1 - kOfTheLimit) &&
        extent_m <= kLargestExtent_m * (1 + kOfTheLimit))) {
    report.refused.push_back("is " + metres(extent_m) + " large, beyond what is rendered (" +
                             metres(kSmallestExtent_m) + " to " + metres(kLargestExtent_m) +
                             "): choose another --unit or scale it");
    return;
  }
  const double mean_m = mean_edge_m(surface);
  const double reach_m = std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z});
  if (!(reach_m * 0x1p-24 <= kRoundingOfEdge * mean_m)) {
    report.refused.push_back("lies " + metres(reach_m) + " from the origin with a size of " +
                             metres(extent_m) + " and edges of " + metres(mean_m) +
                             ": 32-bit coordinates lose its shape there; move it to the origin");
  }
}

void drop_unused_vertices(Surface& surface, CheckReport& report) {
  std::vector<uint32_t> to(surface.vertices.size(), kNone);
  for (const Face& face : surface.faces) {
    for (const uint32_t v : face) to[v] = 0;
  }
  uint32_t left = 0, unused = 0, first = 0;
  report.vertex_source.clear();
  const bool was_read = !surface.faces.empty();
  for (uint32_t v = 0; v < to.size(); ++v) {
    if (to[v] == kNone) {
      if (unused++ == 0) first = v;
      continue;
    }
    to[v] = left;
    report.vertex_source.push_back(v);
    surface.vertices[left++] = surface.vertices[v];
  }
  surface.vertices.resize(left);
  for (Face& face : surface.faces) {
    for (uint32_t& v : face) v = to[v];
  }
  if (unused != 0 && was_read) {
    report.mended.push_back("dropped " + counted(unused, "vertex", "vertices") +
                            " that no face uses, first vertex " + std::to_string(first));
  }
}

}  // namespace firmtouch::tools
