#include "host_sim/report/scene3d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "firmtouch/params/table.hpp"
#include "host_sim/device/drawn_links.hpp"

namespace firmtouch::host_sim {
namespace {

// A browser rotates this many smoothly without a graphics card.
constexpr uint32_t kMaxShownTriangles = 120000;
constexpr uint32_t kMaxSamples = 6000;
constexpr size_t kSamplesPerPoint = 2;   // of a drawn path
constexpr double kMinShownForce = 0.04;  // of the largest force; weaker contact is not drawn
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr Colour kPart{176, 186, 201}, kTouchedPart{140, 176, 214};
constexpr Colour kGuideColour{31, 138, 91}, kDeviceColour{37, 99, 235}, kHandColour{138, 147, 166},
    kTouchColour{232, 93, 38}, kLinkColour{128, 104, 196};
constexpr double kLinkWidth = 5;

Vec narrow(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// The object of each vertex; 0 where there is one surface.
std::vector<uint32_t> owners_of(const Scene3d& scene3d) {
  std::vector<uint32_t> owners(scene3d.vertices.size());
  uint32_t t = 0;
  for (uint32_t i = 0; i < scene3d.objects.size(); ++i)
    for (; t < scene3d.objects[i].end; ++t)
      for (const uint32_t corner : scene3d.triangles[t]) owners[corner] = i;
  return owners;
}

// Vertex clustering: vertices of an object in one grid cell are merged; degenerate triangles are
// removed.
void simplify(Scene3d& scene3d, Vec low, double cell_m) {
  const std::vector<uint32_t> owners = owners_of(scene3d);
  std::map<std::array<int64_t, 4>, uint32_t> cells;
  std::vector<uint32_t> cell_of(scene3d.vertices.size());
  std::vector<Vec> merged;
  std::vector<double> weight;
  for (size_t i = 0; i < scene3d.vertices.size(); ++i) {
    const Vec at = (scene3d.vertices[i] - low) * (1 / cell_m);
    const std::array<int64_t, 4> key = {std::llround(at.x), std::llround(at.y), std::llround(at.z),
                                        owners[i]};
    const auto [place, is_new] = cells.try_emplace(key, static_cast<uint32_t>(merged.size()));
    if (is_new) merged.push_back({}), weight.push_back(0);
    cell_of[i] = place->second;
    merged[place->second] = merged[place->second] + scene3d.vertices[i];
    weight[place->second] += 1;
  }
  for (size_t i = 0; i < merged.size(); ++i) merged[i] = merged[i] * (1 / weight[i]);
  std::vector<std::array<uint32_t, 3>> kept;
  std::vector<uint32_t> ends(scene3d.objects.size());
  for (const auto& t : scene3d.triangles) {
    const std::array<uint32_t, 3> k = {cell_of[t[0]], cell_of[t[1]], cell_of[t[2]]};
    if (k[0] == k[1] || k[1] == k[2] || k[2] == k[0]) continue;
    kept.push_back(k);
    if (!ends.empty()) ends[owners[t[0]]] = static_cast<uint32_t>(kept.size());
  }
  for (size_t i = 0; i < ends.size(); ++i)  // one without a triangle ends where the last one does
    scene3d.objects[i].end = i > 0 ? std::max(ends[i], scene3d.objects[i - 1].end) : ends[i];
  scene3d.vertices = std::move(merged);
  scene3d.triangles = std::move(kept);
}

void add_mesh(Scene3d& scene3d, const PlacedMesh& placed, bool is_object) {
  placed.append_to(scene3d.vertices, scene3d.triangles);
  if (is_object)
    scene3d.objects.push_back({placed.name, static_cast<uint32_t>(scene3d.triangles.size())});
}

void add_surface(Scene3d& scene3d, const Environment& environment,
                 const std::vector<PlacedMesh>& meshes) {
  if (!environment.has_surface()) return;
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  scene3d.vertices = environment.tessellation().vertices;
  scene3d.triangles = environment.tessellation().triangles;
  for (Vec& p : scene3d.vertices) p = p + environment.origin_m();
  for (const PlacedMesh& placed : meshes) add_mesh(scene3d, placed, !placed.name.empty());
  for (const Vec& p : scene3d.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  scene3d.source_triangles = static_cast<uint32_t>(scene3d.triangles.size());
  scene3d.centre = (low + high) * 0.5;
  scene3d.radius_m = norm(high - low) / 2;
  for (double cells = 300; scene3d.triangles.size() > kMaxShownTriangles; cells *= 0.8)
    simplify(scene3d, low, 2 * scene3d.radius_m / cells);
}

// On an object, which may move: on the tool's sphere about the proxy, against the force.
Vec touched_m(const RunPaths::Sample& sample, double tool_radius_m) {
  return sample.proxy_m - unit(sample.force_N) * tool_radius_m;
}

Path touch_path(const Environment& environment, const RunPaths& run, double tool_radius_m) {
  Path path{"touch", "contact points, coloured by force", kTouchColour, 6.5, {}, {}};
  for (size_t i = 0; i < run.samples().size(); i += kSamplesPerPoint) {
    const RunPaths::Sample& sample = run.samples()[i];
    const double share = norm(sample.force_N) / run.peak_N();
    const bool touches = sample.touches && share > kMinShownForce;
    if (!touches && (path.points.empty() || std::isnan(path.points.back().x))) continue;
    path.points.push_back(!touches ? Vec{kNone, 0, 0}
                          : environment.meshes().size() > 1
                              ? touched_m(sample, tool_radius_m)
                              : environment.nearest(sample.tool_m).point_m);
    path.values.push_back(share);
  }
  return path;
}

}  // namespace

Colour heat(double share) {
  // Amber to deep red: visible on grey in both themes.
  constexpr double kStops[4][3] = {{255, 214, 102}, {250, 150, 50}, {226, 60, 40}, {140, 10, 50}};
  const double at = std::clamp(share, 0.0, 1.0) * 3;
  const size_t k = std::min<size_t>(2, static_cast<size_t>(at));
  const double f = at - static_cast<double>(k);
  const auto channel = [&](size_t c) {
    return static_cast<uint8_t>(std::lround(kStops[k][c] + (kStops[k + 1][c] - kStops[k][c]) * f));
  };
  return {channel(0), channel(1), channel(2)};
}

namespace {

Scene3d scene_with(const Environment& environment, const std::vector<PlacedMesh>& meshes,
                   double tool_radius_m) {
  Scene3d scene3d;
  scene3d.tool_radius_m = tool_radius_m;
  add_surface(scene3d, environment, meshes);
  if (environment.has_guide())
    scene3d.paths.push_back({"guide", "guide", kGuideColour, 2.4, environment.guide_m(), {}});
  return scene3d;
}

}  // namespace

Scene3d surface_scene(const Environment& environment, double tool_radius_m) {
  return scene_with(environment, environment.meshes(), tool_radius_m);
}

Colour part_colour(const Scene3d& scene3d, uint32_t triangle) {
  for (const ShownObject& object : scene3d.objects)
    if (triangle < object.end) return object.ticks > 0 ? kTouchedPart : kPart;
  return kPart;
}

RunPaths::RunPaths(const Environment& environment, const Scenario& scenario, const RunFacts& facts)
    : facts_(facts),
      stride_(1 + (facts.ticks + facts.spare_ticks - 1) / kMaxSamples),
      moving_(environment.meshes(),
              static_cast<float>(parameter_value(scenario, params::kTickPeriod))),
      tool_(environment.tool(), static_cast<float>(parameter_value(scenario, params::kTickPeriod))),
      peak_meshes_(environment.meshes()),
      peak_spheres_(tool_.placed({})),
      held_shift_(environment.materials().empty() ? record::kStateObjectShift
                                                  : record::kStateMaterialShift),
      held_mask_(environment.materials().empty() ? 31u : 255u),
      held_ticks_(environment.materials().empty() ? environment.meshes().size()
                                                  : environment.materials().size()),
      linkage_(scenario.linkage ? &*scenario.linkage : nullptr) {}

size_t RunPaths::first() const {
  return std::min<size_t>((facts_.setup_ticks + stride_ - 1) / stride_, samples_.size());
}

void RunPaths::add(const RunTick& tick, const HeldProxy& held) {
  const record::TickOutput& out = tick.record.output;
  const Vec force_N = narrow(out.force_N);
  moving_.take(tick.record);
  tool_.take(tick.record);
  const uint32_t held_by = out.state >> held_shift_ & held_mask_;
  if (held_by > 0 && held_by <= held_ticks_.size() && motors_are_on(out))
    ++held_ticks_[held_by - 1];
  if (norm(force_N) > peak_N_ || ticks_ == 0) {
    peak_N_ = std::max(peak_N_, norm(force_N));
    peak_device_m_ = tick.device_m;
    peak_meshes_ = moving_.meshes();
    peak_spheres_ = tool_.placed({});
    if (linkage_ != nullptr) peak_joints_m_ = host_sim::joints_m(*linkage_, tick.joints);
  }
  if (ticks_++ % stride_ != 0) return;
  samples_.push_back({tick.device_m, narrow(out.position_m), tick.target_m, force_N,
                      narrow(out.proxy_m), (out.state & record::kStateContact) != 0,
                      tool_.turn_rad(), held});
  if (linkage_ == nullptr) return;
  for (const Vec& joint : host_sim::joints_m(*linkage_, tick.joints)) joints_m_.push_back(joint);
}

namespace {

// The chains at the largest force; the scene is then about part and links of the whole run.
void add_links(Scene3d& scene3d, const RunPaths& run) {
  if (run.joints_m().empty()) return;
  scene3d.paths.push_back({"links", "links of the device", kLinkColour, kLinkWidth, {}, {}, true});
  for (size_t i = 0; i < run.peak_joints_m().size(); i += 2)
    for (const Vec& p : {run.peak_joints_m()[i], run.peak_joints_m()[i + 1], run.peak_device_m(),
                         Vec{kNone, 0, 0}})
      scene3d.paths.back().points.push_back(p);
  Vec low = run.peak_device_m(), high = low;
  const auto take = [&](const Vec& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const Vec& p : scene3d.vertices) take(p);
  for (const Vec& p : run.joints_m()) take(p);
  scene3d.centre = (low + high) * 0.5;
  scene3d.radius_m = norm(high - low) / 2;
}

}  // namespace

Scene3d make_scene3d(const Environment& environment, const RunPaths& run, double tool_radius_m) {
  Scene3d scene3d = scene_with(environment, run.peak_meshes(), tool_radius_m);
  scene3d.spheres = run.peak_spheres();
  for (size_t i = 0; i < scene3d.objects.size(); ++i)
    scene3d.objects[i].ticks = run.held_ticks()[i];
  for (size_t i = 0; i < environment.materials().size(); ++i)
    scene3d.materials.push_back({environment.materials()[i], run.held_ticks()[i]});
  Path device{"device", "tool centre, true path", kDeviceColour, 2, {}, {}};
  Path tool{"tool", "tool centre, from the encoders", {14, 165, 190}, 1.2, {}, {}};
  Path hand{"hand", "target of the simulated hand", kHandColour, 1.4, {}, {}};
  for (size_t i = run.first(); i < run.samples().size(); i += kSamplesPerPoint) {
    device.points.push_back(run.samples()[i].device_m);
    tool.points.push_back(run.samples()[i].tool_m);
    hand.points.push_back(run.samples()[i].target_m);
  }
  if (scene3d.triangles.empty() && !device.points.empty()) {
    scene3d.centre = device.points.front();
    for (const Vec& p : device.points)
      scene3d.radius_m = std::max(scene3d.radius_m, norm(p - scene3d.centre));
  }
  scene3d.paths.push_back(std::move(hand));
  scene3d.paths.push_back(std::move(device));
  scene3d.paths.push_back(std::move(tool));
  if (environment.has_surface())
    scene3d.paths.push_back(touch_path(environment, run, tool_radius_m));
  add_links(scene3d, run);
  return scene3d;
}

}  // namespace firmtouch::host_sim
