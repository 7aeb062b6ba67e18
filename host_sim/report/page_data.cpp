#include "host_sim/report/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {
namespace {

constexpr size_t kCursorSteps = 1200;  // places of the cursor: finer than its pixels
constexpr double kFullScale = 32767;

// Positions go as shares of the stage's sphere: centre 0, radius 1.
Vec placed(const Stage& stage, Vec p) { return (p - stage.centre) * (1 / stage.radius_m); }

std::string point_text(const Stage& stage, Vec p) {
  if (std::isnan(p.x)) return "null";
  const Vec q = placed(stage, p);
  return "[" + fixed(q.x, 4) + "," + fixed(q.y, 4) + "," + fixed(q.z, 4) + "]";
}

std::string points_text(const Stage& stage, const std::vector<Vec>& points, size_t stride) {
  std::string text = "[";
  for (size_t i = 0; i < points.size(); i += stride)
    text += (i > 0 ? "," : "") + point_text(stage, points[i]);
  return text + "]";
}

std::string mesh_text(const Stage& stage, bool closed) {
  std::vector<int16_t> vertices;
  for (const Vec& v : stage.vertices) {
    const Vec q = placed(stage, v);
    for (const double c : {q.x, q.y, q.z})
      vertices.push_back(static_cast<int16_t>(std::lround(std::clamp(c, -1.0, 1.0) * kFullScale)));
  }
  const bool is_wide = stage.vertices.size() > 65536;
  std::vector<uint16_t> narrow;
  std::vector<uint32_t> wide;
  for (const auto& t : stage.triangles)
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

std::string path_text(const Stage& stage, const Path& path) {
  std::string text = "{\"key\":\"" + path.key + "\",\"colour\":\"" + hex_of(path.colour) +
                     "\",\"width\":" + fixed(path.width, 1) +
                     ",\"points\":" + points_text(stage, path.points, 1);
  if (!path.values.empty()) {
    text += ",\"colours\":[";
    for (size_t i = 0; i < path.values.size(); ++i)
      text += (i > 0 ? ",\"" : "\"") + hex_of(heat(path.values[i])) + "\"";
    text += "]";
  }
  return text + "}";
}

std::string series_text(const Report& report, const Stage& stage, const RunCharts& run) {
  const size_t n = report.trace.records.size();
  const size_t stride = std::max<size_t>(1, n / kCursorSteps);
  // The cursor begins where the force is greatest.
  const std::vector<double>& force = run.charts.front().series.back().values;
  const size_t start =
      static_cast<size_t>(std::max_element(force.begin(), force.end()) - force.begin()) / stride;
  std::string text = "{\"step\":" + fixed(static_cast<double>(stride) / report.trace.rate_Hz, 6) +
                     ",\"start\":" + std::to_string(start) +
                     ",\"device\":" + points_text(stage, report.trace.device_m, stride) +
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

std::string data_of(const Report& report, const Stage& stage, const RunCharts& run) {
  const bool closed = report.world.has_mesh() && report.world.mesh().is_signed() &&
                      stage.triangles.size() == stage.source_triangles;
  std::string text = "{\"toolRadius\":" + fixed(stage.tool_radius_m / stage.radius_m, 5) +
                     ",\"mesh\":" + mesh_text(stage, closed) + ",\"paths\":[";
  for (size_t i = 0; i < stage.paths.size(); ++i)
    text += (i > 0 ? "," : "") + path_text(stage, stage.paths[i]);
  return text + "],\"series\":" + series_text(report, stage, run) + "}";
}

}  // namespace firmtouch::host_sim
