#include "host_sim/report/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {
namespace {

constexpr size_t kCursorSteps = 1200;  // positions of the time cursor: finer than its pixels
constexpr double kFullScale = 32767;

// Positions are scaled to the scene's bounding sphere: centre 0, radius 1.
Vec normalized(const Scene3d& scene3d, Vec p) {
  return (p - scene3d.centre) * (1 / scene3d.radius_m);
}

std::string point_text(const Scene3d& scene3d, Vec p) {
  if (std::isnan(p.x)) return "null";
  const Vec q = normalized(scene3d, p);
  return "[" + fixed(q.x, 4) + "," + fixed(q.y, 4) + "," + fixed(q.z, 4) + "]";
}

std::string points_text(const Scene3d& scene3d, const std::vector<Vec>& points, size_t stride) {
  std::string text = "[";
  for (size_t i = 0; i < points.size(); i += stride)
    text += (i > 0 ? "," : "") + point_text(scene3d, points[i]);
  return text + "]";
}

std::string mesh_text(const Scene3d& scene3d, bool closed) {
  std::vector<int16_t> vertices;
  for (const Vec& v : scene3d.vertices) {
    const Vec q = normalized(scene3d, v);
    for (const double c : {q.x, q.y, q.z})
      vertices.push_back(static_cast<int16_t>(std::lround(std::clamp(c, -1.0, 1.0) * kFullScale)));
  }
  const bool is_wide = scene3d.vertices.size() > 65536;
  std::vector<uint16_t> narrow;
  std::vector<uint32_t> wide;
  for (const auto& t : scene3d.triangles)
    for (const uint32_t corner : t) {
      if (is_wide)
        wide.push_back(corner);
      else
        narrow.push_back(static_cast<uint16_t>(corner));
    }
  return std::string("{\"closed\":") + (closed ? "true" : "false") +
         ",\"wide\":" + (is_wide ? "true" : "false") + ",\"vertices\":\"" +
         base64_of(vertices.data(), vertices.size() * 2) + "\",\"triangles\":\"" +
         (is_wide ? base64_of(wide.data(), wide.size() * 4)
                  : base64_of(narrow.data(), narrow.size() * 2)) +
         "\"}";
}

std::string path_text(const Scene3d& scene3d, const Path& path) {
  std::string text = "{\"key\":\"" + path.key + "\",\"colour\":\"" + hex_of(path.colour) +
                     "\",\"width\":" + fixed(path.width, 1) +
                     ",\"points\":" + points_text(scene3d, path.points, 1);
  if (!path.values.empty()) {
    text += ",\"colours\":[";
    for (size_t i = 0; i < path.values.size(); ++i)
      text += (i > 0 ? ",\"" : "\"") + hex_of(heat(path.values[i])) + "\"";
    text += "]";
  }
  return text + "}";
}

std::string series_text(const Report& report, const Scene3d& scene3d, const RunCharts& run) {
  const size_t n = report.trace.records.size();
  const size_t stride = std::max<size_t>(1, n / kCursorSteps);
  // The cursor starts at the largest force.
  const std::vector<double>& force = run.charts.front().series.back().values;
  const size_t start =
      static_cast<size_t>(std::max_element(force.begin(), force.end()) - force.begin()) / stride;
  std::string text = "{\"step\":" + fixed(static_cast<double>(stride) / report.trace.rate_Hz, 6) +
                     ",\"start\":" + std::to_string(start) +
                     ",\"device\":" + points_text(scene3d, report.trace.device_m, stride) +
                     ",\"charts\":[";
  for (size_t c = 0; c < run.charts.size(); ++c) {
    text += c > 0 ? ",[" : "[";
    for (size_t s = 0; s < run.charts[c].series.size(); ++s) {
      text += s > 0 ? ",[" : "[";
      const std::vector<double>& values = run.charts[c].series[s].values;
      for (size_t i = 0; i < n; i += stride)
        text += (i > 0 ? ",\"" : "\"") + fixed(values[i], run.charts[c].decimals) + "\"";
      text += "]";
    }
    text += "]";
  }
  return text + "]}";
}

}  // namespace

std::string hex_of(Colour colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text;
}

std::string data_of(const Report& report, const Scene3d& scene3d, const RunCharts& run) {
  const bool closed = report.environment.has_mesh() && report.environment.mesh().is_signed() &&
                      scene3d.triangles.size() == scene3d.source_triangles;
  std::string text = "{\"toolRadius\":" + fixed(scene3d.tool_radius_m / scene3d.radius_m, 5) +
                     ",\"mesh\":" + mesh_text(scene3d, closed) + ",\"paths\":[";
  for (size_t i = 0; i < scene3d.paths.size(); ++i)
    text += (i > 0 ? "," : "") + path_text(scene3d, scene3d.paths[i]);
  return text + "],\"series\":" + series_text(report, scene3d, run) + "}";
}

}  // namespace firmtouch::host_sim
