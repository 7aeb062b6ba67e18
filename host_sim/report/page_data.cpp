#include "host_sim/report/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::host_sim {
namespace {

constexpr double kFullScale = 32767;
// Positions are scaled to the scene's bounding sphere: centre 0, radius 1. Paths may leave it.
constexpr double kPathReach = 4;
constexpr double kMaxTurn_rad = 6.2831853;
constexpr int16_t kBreak = -32768;  // a path is interrupted

Vec normalized(const Scene3d& scene3d, Vec p) {
  return (p - scene3d.centre) * (1 / scene3d.radius_m);
}

void add_scaled(std::vector<int16_t>& list, Vec v, double reach) {
  for (const double c : {v.x, v.y, v.z})
    list.push_back(
        static_cast<int16_t>(std::lround(std::clamp(c / reach, -1.0, 1.0) * kFullScale)));
}

template <class T>
std::string packed(const std::vector<T>& list) {
  return "\"" + base64_of(list.data(), list.size() * sizeof(T)) + "\"";
}

std::string points_text(const Scene3d& scene3d, const std::vector<Vec>& points) {
  std::vector<int16_t> list;
  for (const Vec& p : points) {
    if (std::isnan(p.x))
      list.insert(list.end(), 3, kBreak);
    else
      add_scaled(list, normalized(scene3d, p), kPathReach);
  }
  return packed(list);
}

std::string mesh_text(const Scene3d& scene3d, bool is_closed) {
  std::vector<int16_t> vertices;
  for (const Vec& v : scene3d.vertices) add_scaled(vertices, normalized(scene3d, v), 1);
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
  std::string touched;  // first and end of the triangles of each object that was touched
  for (size_t i = 0; i < scene3d.objects.size(); ++i)
    if (scene3d.objects[i].ticks > 0)
      touched += (touched.empty() ? "[" : ",[") +
                 std::to_string(i == 0 ? 0 : scene3d.objects[i - 1].end) + "," +
                 std::to_string(scene3d.objects[i].end) + "]";
  return std::string("{\"closed\":") + (is_closed ? "true" : "false") +
         ",\"wide\":" + (is_wide ? "true" : "false") + ",\"vertices\":" + packed(vertices) +
         ",\"triangles\":" + (is_wide ? packed(wide) : packed(narrow)) + ",\"touched\":[" +
         touched + "]}";
}

std::string path_text(const Scene3d& scene3d, const Path& path) {
  std::string text = "{\"key\":" + json_text(path.key) + ",\"colour\":\"" + hex_of(path.colour) +
                     "\",\"width\":" + fixed(path.width, 1) +
                     (path.has_joints ? ",\"joints\":true" : "") +
                     ",\"points\":" + points_text(scene3d, path.points);
  if (!path.values.empty()) {
    text += ",\"colours\":[";
    for (size_t i = 0; i < path.values.size(); ++i)
      text += (i > 0 ? ",\"" : "\"") + hex_of(heat(path.values[i])) + "\"";
    text += "]";
  }
  return text + "}";
}

// A character a sample: HeldProxy::kind. Of those with planes the hand from the proxy, in parts of
// the farthest, and the normals, one after the other. Friction where it changes, with its sample.
std::string held_text(const std::vector<RunPaths::Sample>& samples) {
  double farthest_m = 1e-12;
  for (const RunPaths::Sample& sample : samples)
    if (!sample.held.normals.empty()) farthest_m = std::max(farthest_m, norm(sample.held.hand_m));
  std::vector<int16_t> vectors;
  std::string kinds, frictions, last;
  for (size_t i = 0; i < samples.size(); ++i) {
    const HeldProxy& held = samples[i].held;
    kinds += held.kind;
    if (held.normals.empty()) continue;
    add_scaled(vectors, held.hand_m, farthest_m);
    for (const Vec& normal : held.normals) add_scaled(vectors, normal, 1);
    const std::string friction =
        fixed(held.friction_static, 3) + "," + fixed(held.friction_dynamic, 3) + "]";
    if (friction != last)
      frictions += (frictions.empty() ? "[" : ",[") + std::to_string(i) + "," + friction;
    last = friction;
  }
  return "{\"kinds\":\"" + kinds + "\",\"farthest_mm\":" + fixed(farthest_m * 1e3, 6) +
         ",\"vectors\":" + packed(vectors) + ",\"friction\":[" + frictions + "]}";
}

std::string samples_text(const Report& report, const Scene3d& scene3d) {
  std::vector<int16_t> device, force, turn, joints;
  for (const RunPaths::Sample& sample : report.paths.samples()) {
    add_scaled(device, normalized(scene3d, sample.device_m), kPathReach);
    add_scaled(force, sample.force_N, report.paths.peak_N());
    add_scaled(turn, sample.turn_rad, kMaxTurn_rad);
  }
  for (const Vec& joint : report.paths.joints_m())
    add_scaled(joints, normalized(scene3d, joint), kPathReach);
  return "{\"step_s\":" + fixed(report.paths.ticks_per_sample() / report.facts.rate_Hz, 6) +
         ",\"first\":" + std::to_string(report.paths.first()) +
         ",\"peak_N\":" + fixed(report.paths.peak_N(), 6) + ",\"device\":" + packed(device) +
         ",\"force\":" + packed(force) + ",\"held\":" + held_text(report.paths.samples()) +
         (report.environment.tool().empty() ? "" : ",\"turn\":" + packed(turn)) +
         (report.paths.joints_m().empty() ? "" : ",\"joints\":" + packed(joints)) + "}";
}

std::string spans_text(const chart::TimeAxis::Spans& spans) {
  std::string text;
  for (const auto& [from, to] : spans)
    text += (text.empty() ? "[" : ",[") + fixed(from, 4) + "," + fixed(to, 4) + "]";
  return "[" + text + "]";
}

std::string axis_text(const chart::TimeAxis& axis) {
  std::string events;
  for (const auto& [time, text] : axis.events)
    events += (events.empty() ? "[" : ",[") + fixed(time, 4) + "," + json_text(text) + "]";
  return "{\"contact\":" + spans_text(axis.contact_s) + ",\"guide\":" + spans_text(axis.guide_s) +
         ",\"off\":" + spans_text(axis.off_s) + ",\"events\":[" + events + "]}";
}

std::string chart_text(const RunChart& chart) {
  std::string curves;
  for (const Curve& curve : chart.curves)
    curves += (curves.empty() ? "{\"label\":" : ",{\"label\":") + json_text(curve.label) +
              ",\"colour\":" + json_text(curve.colour) +
              ",\"area\":" + (curve.is_area ? "true" : "false") +
              ",\"width\":" + fixed(curve.width, 1) + ",\"low\":" + packed(curve.values.low()) +
              ",\"high\":" + packed(curve.values.high()) + "}";
  return "{\"title\":" + json_text(chart.title) + ",\"unit\":" + json_text(chart.unit) +
         ",\"note\":" + json_text(chart.note) + ",\"decimals\":" + std::to_string(chart.decimals) +
         ",\"log\":" + (chart.is_logarithmic ? "true" : "false") + ",\"curves\":[" + curves + "]}";
}

}  // namespace

std::string hex_of(Colour colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text;
}

std::string scene_data_of(const Scene3d& scene3d, const Environment& environment) {
  const std::vector<PlacedMesh>& meshes = environment.meshes();
  const bool is_closed = !meshes.empty() && scene3d.triangles.size() == scene3d.source_triangles &&
                         std::all_of(meshes.begin(), meshes.end(), [](const PlacedMesh& placed) {
                           return placed.mesh.is_signed();
                         });
  std::string paths;
  for (const Path& path : scene3d.paths)
    paths += (paths.empty() ? "" : ",") + path_text(scene3d, path);
  std::string spheres;
  for (const scene::SphereLayout& sphere : environment.tool()) {
    spheres += spheres.empty() ? "[" : ",[";
    for (const float at_m : sphere.at_m)
      spheres += fixed(static_cast<double>(at_m) / scene3d.radius_m, 5) + ",";
    spheres += fixed(static_cast<double>(sphere.radius_m) / scene3d.radius_m, 5) + "]";
  }
  return "\"toolRadius\":" + fixed(scene3d.tool_radius_m / scene3d.radius_m, 5) + ",\"spheres\":[" +
         spheres + "],\"centre\":[" + fixed(scene3d.centre.x, 6) + "," +
         fixed(scene3d.centre.y, 6) + "," + fixed(scene3d.centre.z, 6) +
         "],\"radius_m\":" + fixed(scene3d.radius_m, 6) +
         ",\"mesh\":" + mesh_text(scene3d, is_closed) + ",\"paths\":[" + paths + "]";
}

std::string data_of(const Report& report, const Scene3d& scene3d) {
  // The cursor starts at the largest force.
  const std::vector<RunPaths::Sample>& samples = report.paths.samples();
  const auto most = std::max_element(
      samples.begin(), samples.end(),
      [](const auto& a, const auto& b) { return norm(a.force_N) < norm(b.force_N); });
  const double start_s = static_cast<double>(most - samples.begin()) *
                         report.paths.ticks_per_sample() / report.facts.rate_Hz;
  std::string charts;
  for (const RunChart& chart : report.charts.charts())
    charts += (charts.empty() ? "" : ",") + chart_text(chart);
  const double bin_s = report.charts.ticks_per_bin() / report.facts.rate_Hz;
  return "{\"bin_s\":" + fixed(bin_s, 6) + ",\"start_s\":" + fixed(start_s, 6) + "," +
         scene_data_of(scene3d, report.environment) +
         ",\"samples\":" + samples_text(report, scene3d) +
         ",\"axis\":" + axis_text(report.charts.axis()) + ",\"charts\":[" + charts + "]}";
}

}  // namespace firmtouch::host_sim
