#include "host_sim/report/vtk_export.hpp"

#include <cstring>
#include <vector>

#include "host_sim/device/drawn_links.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {
namespace {

enum Part { kTip, kProxy, kLink };  // values of the array `part`

Vec wide(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// Surfaces where they are now, each triangle's object, and the guide.
PolyData scene_of(const Environment& environment, const std::vector<PlacedMesh>& meshes) {
  PolyData data;
  for (const Vec& p : environment.tessellation().vertices)
    data.points_m.push_back(p + environment.origin_m());
  data.triangles = environment.tessellation().triangles;
  for (const PlacedMesh& placed : meshes) placed.append_to(data.points_m, data.triangles);
  if (environment.has_guide()) {
    data.lines.emplace_back();
    for (const Vec& p : environment.guide_m()) {
      data.lines[0].push_back(static_cast<uint32_t>(data.points_m.size()));
      data.points_m.push_back(p);
    }
  }
  return data;
}

// The links of a linkage whose tip is where the record has it; none where it cannot be there.
void add_links(TipFollower& tip, Vec tip_m, PolyData& to) {
  const JointMotion* at = tip.at(tip_m);
  if (at == nullptr) return;
  const std::vector<Vec> joints = joints_m(tip.device(), *at);
  for (size_t i = 0; i < joints.size(); i += 2) {
    const uint32_t first = static_cast<uint32_t>(to.points_m.size());
    to.points_m.insert(to.points_m.end(), {joints[i], joints[i + 1]});
    to.lines.push_back({first, first + 1, kTip});
  }
}

PolyData tick_of(const record::TickRecord& record, double time_s, float tool_radius_m,
                 std::optional<TipFollower>& tip) {
  const record::TickOutput& out = record.output;
  PolyData data;
  data.points_m = {wide(out.position_m), wide(out.proxy_m)};
  data.verts = {{kTip}, {kProxy}};
  data.lines = {{kTip, kProxy}};
  if (tip) add_links(*tip, wide(out.position_m), data);
  PolyData::Values part{"part", 1, {kTip, kProxy}}, force{"force_N", 3, {}},
      velocity{"velocity_mps", 3, {}};
  part.values.resize(data.points_m.size(), kLink);
  force.values.assign(out.force_N, out.force_N + 3);
  velocity.values.assign(out.velocity_mps, out.velocity_mps + 3);
  force.values.resize(3 * data.points_m.size());
  velocity.values.resize(3 * data.points_m.size());
  data.of_points = {part, force, velocity};
  const auto of_whole = [&](const char* name, double value) {
    data.of_whole.push_back({name, 1, {value}});
  };
  of_whole("TimeValue", time_s);
  of_whole("penetration_m", static_cast<double>(out.penetration_m));
  of_whole("tool_radius_m", static_cast<double>(tool_radius_m));
  of_whole("is_on", motors_are_on(out) ? 1 : 0);
  of_whole("faults", out.faults);
  return data;
}

bool is_moved(const std::vector<PlacedMesh>& from, const std::vector<PlacedMesh>& to) {
  for (size_t i = 0; i < to.size(); ++i)
    if (std::memcmp(&from[i].object.pose, &to[i].object.pose, sizeof to[i].object.pose) != 0)
      return true;
  return false;
}

}  // namespace

uint32_t export_vtk(const Log& log, const Environment& environment, const VtkExport& what,
                    const std::string& folder, const std::function<void(double)>& progress) {
  MovingMeshes moving(environment.meshes(), static_cast<float>(what.period_s));
  std::vector<PlacedMesh> written = moving.meshes();
  std::optional<TipFollower> tip;
  if (what.linkage) tip.emplace(*what.linkage);
  std::vector<TimedFile> files;
  std::string scene;
  uint32_t ticks = 0;
  for (size_t i = 0; i < log.records.size(); ++i) {
    const record::TickRecord& record = log.records[i];
    moving.take(record);
    if (i % what.every != 0) continue;
    const std::string number = std::to_string(record.input.tick) + ".vtp";
    const double time_s = record.input.tick * what.period_s;
    if (scene.empty() || is_moved(written, moving.meshes())) {
      scene = "scene_" + number;
      written = moving.meshes();
      write_file(folder + "/" + scene, vtp_of(scene_of(environment, written)));
    }
    write_file(folder + "/tick_" + number,
               vtp_of(tick_of(record, time_s, what.tool_radius_m, tip)));
    files.push_back({time_s, 0, scene});
    files.push_back({time_s, 1, "tick_" + number});
    ++ticks;
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(log.records.size()));
  }
  write_file(folder + "/run.pvd", pvd_of(files));
  if (progress) progress(1);
  return ticks;
}

}  // namespace firmtouch::host_sim
