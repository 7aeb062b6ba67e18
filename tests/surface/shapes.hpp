#pragma once
// Small surfaces made by hand, and oracles for surfaces that share no code with the tools.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/test.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

inline Surface numbered(std::vector<math::Vec3> vertices, std::vector<Face> faces) {
  Surface surface{std::move(vertices), std::move(faces), {}};
  for (uint32_t f = 0; f < surface.faces.size(); ++f) surface.source.push_back(f);
  return surface;
}

/// Triangles of up to ten vertices, written as "021 013 ...".
inline std::vector<Face> faces_of(const char* text) {
  std::vector<Face> faces;
  for (uint32_t k = 0; *text != 0; ++text) {
    if (*text == ' ') continue;
    if (k % 3 == 0) faces.emplace_back();
    faces.back()[k++ % 3] = static_cast<uint32_t>(*text - '0');
  }
  return faces;
}

inline Surface tetrahedron() {
  return numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, faces_of("021 013 123 032"));
}

/// A cube of side 2 * half about `centre`, outward; quads 0123 from below, then as the file formats
/// below have them.
inline Surface cube(math::Vec3 centre = {0, 0, 0}, float half = 1) {
  std::vector<math::Vec3> vertices;
  for (int k = 0; k < 8; ++k) {
    vertices.push_back({centre.x + ((k & 1) != 0 ? half : -half),
                        centre.y + ((k & 2) != 0 ? half : -half),
                        centre.z + ((k & 4) != 0 ? half : -half)});
  }
  return numbered(vertices, faces_of("023 031 457 476 015 054 267 273 046 062 137 175"));
}

inline void append(Surface& to, const Surface& more) {
  const uint32_t first = static_cast<uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const Face& f : more.faces) {
    to.source.push_back(static_cast<uint32_t>(to.faces.size()));
    to.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
}

inline void turn(Face& face) { std::swap(face[1], face[2]); }

/// Every directed edge once, and its opposite once.
inline bool is_closed_and_alike(const Surface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Face& f : surface.faces) {
    for (uint32_t k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return !edges.empty();
}

inline double volume_of(const Surface& surface) {
  double sum = 0;
  for (const Face& f : surface.faces) {
    sum += dot(to_point(surface.vertices[f[0]]),
               cross(to_point(surface.vertices[f[1]]), to_point(surface.vertices[f[2]])));
  }
  return sum / 6;
}

/// The winding number by solid angles (van Oosterom and Strackee 1983).
inline double winding_by_angles(const Surface& surface, Point p) {
  double sum = 0;
  for (const Face& f : surface.faces) {
    const Point a = to_point(surface.vertices[f[0]]) - p, b = to_point(surface.vertices[f[1]]) - p,
                c = to_point(surface.vertices[f[2]]) - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * 3.14159265358979323846);
}

inline bool same(const Surface& a, const Surface& b) {
  const auto equal = [](const math::Vec3& v, const math::Vec3& w) {
    return !(v.x < w.x || v.x > w.x || v.y < w.y || v.y > w.y || v.z < w.z || v.z > w.z);
  };
  return a.faces == b.faces && a.source == b.source && a.vertices.size() == b.vertices.size() &&
         std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), equal);
}

inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}
inline bool says(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return says(line, part); });
}

/// The folder of real models; without one the running test is skipped (return then).
inline const char* models_folder() {
  const char* folder = std::getenv("FIRMTOUCH_MODELS");
  if (folder != nullptr && folder[0] != 0) return folder;
  firmtouch::test::skip("FIRMTOUCH_MODELS names no folder of real models");
  return nullptr;
}

}  // namespace firmtouch::tools
