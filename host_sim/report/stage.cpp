#include "host_sim/report/stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kMaxShownTriangles =
    120000;  // a browser turns this many smoothly without a graphics card
constexpr size_t kMaxPathPoints = 3000;
constexpr double kFelt = 0.04;  // of the largest force: a fainter touch is not drawn
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr Colour kGuideColour{31, 138, 91}, kDeviceColour{37, 99, 235}, kHandColour{138, 147, 166},
    kTouchColour{232, 93, 38};

Vec narrow(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// Vertices that share a cell of a grid become one; triangles that lose a corner go.
void thin_out(Stage& stage, Vec low, double cell_m) {
  std::map<std::array<int64_t, 3>, uint32_t> cells;
  std::vector<uint32_t> cell_of(stage.vertices.size());
  std::vector<Vec> merged;
  std::vector<double> weight;
  for (size_t i = 0; i < stage.vertices.size(); ++i) {
    const Vec at = (stage.vertices[i] - low) * (1 / cell_m);
    const std::array<int64_t, 3> key = {std::llround(at.x), std::llround(at.y), std::llround(at.z)};
    const auto [place, is_new] = cells.try_emplace(key, static_cast<uint32_t>(merged.size()));
    if (is_new) merged.push_back({}), weight.push_back(0);
    cell_of[i] = place->second;
    merged[place->second] = merged[place->second] + stage.vertices[i];
    weight[place->second] += 1;
  }
  for (size_t i = 0; i < merged.size(); ++i) merged[i] = merged[i] * (1 / weight[i]);
  std::vector<std::array<uint32_t, 3>> kept;
  for (const auto& t : stage.triangles) {
    const std::array<uint32_t, 3> k = {cell_of[t[0]], cell_of[t[1]], cell_of[t[2]]};
    if (k[0] != k[1] && k[1] != k[2] && k[2] != k[0]) kept.push_back(k);
  }
  stage.vertices = std::move(merged);
  stage.triangles = std::move(kept);
}

void take_surface(Stage& stage, const World& world) {
  const mesh::View& mesh = world.mesh();
  if (!world.has_surface()) return;
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  stage.vertices = world.shell().vertices;
  stage.triangles = world.shell().triangles;
  if (world.has_mesh())
    for (const mesh::Vertex& v : mesh.vertices())
      stage.vertices.push_back(
          {static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)});
  for (Vec& p : stage.vertices) {
    p = p + world.origin_m();
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (uint32_t i = 0; world.has_mesh() && i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    stage.triangles.push_back({t.corner[0], t.corner[1], t.corner[2]});
  }
  stage.source_triangles = static_cast<uint32_t>(stage.triangles.size());
  stage.centre = (low + high) * 0.5;
  stage.radius_m = norm(high - low) / 2;
  for (double cells = 300; stage.triangles.size() > kMaxShownTriangles; cells *= 0.8)
    thin_out(stage, low, 2 * stage.radius_m / cells);
}

// The points of the run that a path keeps: evenly spread in time.
size_t stride_of(const Trace& trace) {
  return std::max<size_t>(1, trace.records.size() / kMaxPathPoints);
}

Path touch_path(const World& world, const Trace& trace) {
  Path path{"touch", "touch on the part, coloured by force", kTouchColour, 6.5, {}, {}};
  double most = 1e-9;
  for (const record::TickRecord& r : trace.records)
    most = std::max(most, norm(narrow(r.output.force_N)));
  for (size_t i = 0; i < trace.records.size(); i += stride_of(trace)) {
    const record::TickOutput& out = trace.records[i].output;
    const bool touches =
        (out.state & record::kStateContact) != 0 && norm(narrow(out.force_N)) > kFelt * most;
    if (!touches && (path.points.empty() || std::isnan(path.points.back().x))) continue;
    path.points.push_back(touches ? world.nearest(narrow(out.position_m)).point_m
                                  : Vec{kNone, 0, 0});
    path.values.push_back(norm(narrow(out.force_N)) / most);
  }
  return path;
}

}  // namespace

Colour heat(double share) {
  // Amber to deep red: readable on the part's grey in both themes.
  constexpr double kStops[4][3] = {{255, 214, 102}, {250, 150, 50}, {226, 60, 40}, {140, 10, 50}};
  const double at = std::clamp(share, 0.0, 1.0) * 3;
  const size_t k = std::min<size_t>(2, static_cast<size_t>(at));
  const double f = at - static_cast<double>(k);
  const auto channel = [&](size_t c) {
    return static_cast<uint8_t>(std::lround(kStops[k][c] + (kStops[k + 1][c] - kStops[k][c]) * f));
  };
  return {channel(0), channel(1), channel(2)};
}

Stage make_stage(const World& world, const Trace& trace, double tool_radius_m) {
  Stage stage;
  stage.tool_radius_m = tool_radius_m;
  take_surface(stage, world);
  if (world.has_guide())
    stage.paths.push_back({"guide", "guide", kGuideColour, 2.4, world.guide_m(), {}});
  Path device{"device", "device path (tool's centre)", kDeviceColour, 2, {}, {}};
  Path tool{"tool", "tool path, as the encoders see it", {14, 165, 190}, 1.2, {}, {}};
  Path hand{"hand", "where the hand aims", kHandColour, 1.4, {}, {}};
  for (size_t i = trace.setup_ticks; i < trace.records.size(); i += stride_of(trace)) {
    device.points.push_back(trace.device_m[i]);
    tool.points.push_back(narrow(trace.records[i].output.position_m));
    hand.points.push_back(trace.target_m[i]);
  }
  if (stage.triangles.empty() && !device.points.empty()) {
    stage.centre = device.points.front();
    for (const Vec& p : device.points)
      stage.radius_m = std::max(stage.radius_m, norm(p - stage.centre));
  }
  stage.paths.push_back(std::move(hand));
  stage.paths.push_back(std::move(device));
  stage.paths.push_back(std::move(tool));
  if (world.has_surface()) stage.paths.push_back(touch_path(world, trace));
  return stage;
}

}  // namespace firmtouch::host_sim
