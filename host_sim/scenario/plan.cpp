#include "host_sim/scenario/plan.hpp"

#include <algorithm>
#include <cstdio>

#include "bake/spline/spline_pole.hpp"
#include "device/line_reader.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/scene/tool.hpp"
#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {
namespace {

// Shares of the diagonal. The demo's part of 0.14 m gets a tool of 3 mm.
constexpr double kToolRadius = 0.0212;
constexpr double kHover = 0.18;  // initial height of the hand above the guide's start
constexpr double kSnap = 0.04, kRelease = 0.12;
constexpr double kPressDeep = 0.045;   // depth of the hand's aim below the surface
constexpr double kMaxPress_m = 0.016;  // 4 N on the default spring and grip
constexpr double kContact_N_per_m = 1200, kGuide_N_per_m = 400;
constexpr auto kForceLimit_N = static_cast<double>(params::kTable[params::kForceLimit].initial);
constexpr double kStableShare = 0.95;  // of the stiffest wall that a linkage renders
constexpr double kHold_s = 0.4, kFirstPress_s = 1.6, kLastPress_s = 2;
constexpr double kRoundTime_s = 4.0;      // once along the guide
constexpr double kMaxSpeed = 0.9;         // diagonals per second: a faster hand leaves the guide
constexpr double kMaxSpeed_mps = 0.25;    // a person follows an edge no faster
constexpr double kMaxToolRadius_m = 0.1;  // limit of the parameter table

class TextLines {
 public:
  template <class... T>
  void add(const char* format, T... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    text_ += text;
    text_ += '\n';
  }
  void line(const std::string& text) { text_ += text + "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct Box {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void take(Vec p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

Box box_of(const Environment& environment) {
  Box box;
  for (const Vec& p : environment.tessellation().vertices) box.take(p + environment.origin_m());
  for (const PlacedMesh& placed : environment.meshes())
    for (uint32_t i = 0; i < placed.mesh.vertices().size(); ++i) box.take(placed.vertex_m(i));
  for (const Vec& p : environment.guide_m()) box.take(p);
  return box;
}

// Surface normal at the point nearest to `p`; without a surface, the direction away from the box's
// centre.
Vec outward(const Environment& environment, Vec p, const Box& box) {
  return environment.has_surface() ? environment.nearest(p).normal
                                   : unit(p - (box.low + box.high) * 0.5);
}

// Whether a linkage has its whole force all along the guide.
bool reaches_guide(const Environment& environment, const PlannedDevice& device) {
  if (device.linkage == nullptr) return true;
  JointMotion at = middle_of(*device.linkage);
  for (Vec p : environment.guide_m()) {
    if (device.is_planar()) p.z = 0;
    if (!find_angles_from(*device.linkage, p, at) ||
        reciprocal_condition(*device.linkage, at) <
            static_cast<double>(device.linkage->limits.full_from))
      return false;
  }
  return true;
}

// Speed and duration of following the guide; all zero if there is none.
struct GuideRun {
  double speed_mps = 0, time_s = 0, approach_s = 0;
  Vec end;
};

GuideRun plan_guide_run(const Environment& environment, Vec start, double diagonal,
                        bool is_followed) {
  if (!is_followed) return {0, 0, 0, start};
  const double length = environment.guide_length_m();
  GuideRun run;
  run.speed_mps = std::min({length / kRoundTime_s, kMaxSpeed * diagonal, kMaxSpeed_mps});
  run.time_s = std::min(length / run.speed_mps, 3 * kRoundTime_s);
  run.approach_s = norm(start - environment.guide_at(0)) / run.speed_mps;
  run.end = environment.guide_at(2 * run.speed_mps * run.time_s);
  return run;
}

// What a linkage renders of a wall; `stable` of 0: all.
double rendered(double wanted, double stable) {
  return stable > 0 ? std::min(wanted, kStableShare * stable) : wanted;
}

double force_limit_N(const PlannedDevice& device) {
  return rendered(kForceLimit_N, device.stable_texture_N);
}

void add_walls(TextLines& out, const PlannedDevice& device) {
  out.add("contact_stiffness %.0f N/m\nguide_stiffness %.0f N/m",
          rendered(kContact_N_per_m, device.stable_contact_N_per_m),
          rendered(kGuide_N_per_m, device.stable_guide_N_per_m));
  if (!(force_limit_N(device) < kForceLimit_N)) return;
  out.line("# up to this force the texture is stable on the linkage; lower or longer waves or a");
  out.line("# higher device_damping, if the linkage has it, allow more");
  out.add("force_limit %.3g N", force_limit_N(device));
}

// Each sphere after the first needs as much more.
void add_work(TextLines& out, size_t spheres) {
  if (spheres < 2) return;
  const auto more = static_cast<double>((spheres - 1) * scene::kSphereWork);
  const auto with_more = [more](uint32_t number) {
    return static_cast<double>(params::kTable[number].initial) + more;
  };
  out.add("# for %zu spheres\nmesh_work %.0f\ntick_work %.0f", spheres,
          with_more(params::kMeshWork), with_more(params::kTickWork));
}

void add_axes(TextLines& out, const Box& box, double diagonal) {
  const Vec middle = (box.low + box.high) * 0.5;
  const Vec half = {std::max(0.5, (box.high.x - box.low.x) + diagonal),
                    std::max(0.5, (box.high.y - box.low.y) + diagonal),
                    std::max(0.5, (box.high.z - box.low.z) + diagonal)};
  out.line("mass 0.075 kg\nviscous_friction 0.5 N*s/m\ncoulomb_friction 0.02 N");
  out.line("encoder_quantum 10 um\nmotor_limit 12 N");
  out.add("origin_x %.5g m\norigin_y %.5g m\norigin_z %.5g m", middle.x, middle.y, middle.z);
  out.add("workspace_half_x %.4g m\nworkspace_half_y %.4g m\nworkspace_half_z %.4g m", half.x,
          half.y, half.z);
}

void add_setting(TextLines& out, const Environment& environment, const Box& box, double diagonal,
                 double tool_m, const PlannedDevice& device) {
  out.line("rate 1000 Hz\n\n# the device");
  if (device.linkage == nullptr) {
    add_axes(out, box, diagonal);
  } else {  // the start is at the middle of its joints' ranges
    const Vec origin = environment.scene_m();
    out.line("device " + tools::path_word(device.file));
    out.add("scene_x %.6g m\nscene_y %.6g m\nscene_z %.6g m", origin.x, origin.y, origin.z);
  }
  out.add("\n# the surface and the guide\ntool_radius %.4g mm", tool_m * 1e3);
  add_walls(out, device);
  add_work(out, environment.tool().size());
  if (environment.has_surface() && !environment.has_mesh()) {
    const Orientation orientation = orientation_of(environment.tessellation());
    out.add("surface_closed %d\nsurface_turned %d", orientation.is_closed ? 1 : 0,
            orientation.normals_inward ? 1 : 0);
    // A patch needs more work than a triangle, and on the normal at a pole a ring of them.
    const bool has_pole = !tools::poles_of(environment.surface()).empty();
    const uint32_t work = has_pole ? tools::kPoleWork : 5120;
    out.add("mesh_work %u\ntick_work %u", work, work + 480);
  }
  out.add("guide_snap %.4g mm\nguide_release %.4g mm", kSnap * diagonal * 1e3,
          kRelease * diagonal * 1e3);
}

// Presses `deep_m` into the surface at the point nearest to `from`.
void add_press(TextLines& out, const Environment& environment, Vec from, double tool_m,
               double deep_m, double time_s) {
  const Environment::Surface under = environment.nearest(from);
  const Vec aim = under.point_m + under.normal * (tool_m - deep_m);
  out.add("press %.6g %.6g %.6g m for %.4g s", aim.x, aim.y, aim.z, time_s);
}

}  // namespace

double diagonal_m(const Environment& environment) {
  const Box box = box_of(environment);
  return norm(box.high - box.low);
}

Vec planned_start_m(const Environment& environment, const PlannedDevice& device) {
  const Box box = box_of(environment);
  const double hover = kHover * norm(box.high - box.low);
  const Vec middle = (box.low + box.high) * 0.5;
  const Vec away = device.is_planar() ? Vec{0, -1, 0} : Vec{0, 0, 1};
  const Vec beside = device.is_planar() ? Vec{middle.x, box.low.y - hover, middle.z}
                                        : Vec{middle.x, middle.y, box.high.z + hover};
  const Vec first = environment.has_guide()     ? environment.guide_at(0)
                    : environment.has_surface() ? environment.nearest(beside).point_m
                                                : beside;
  Vec out = outward(environment, first, box);
  if (device.is_planar()) out = unit(Vec{out.x, out.y, 0} + away * 1e-9);
  return first + out * hover;
}

std::string plan_scenario(const Environment& environment, const std::string& asset,
                          const PlannedDevice& device) {
  const Box box = box_of(environment);
  const double diagonal = norm(box.high - box.low);
  const double tool = std::min(kToolRadius * diagonal, kMaxToolRadius_m);
  const double deep =
      std::min(kPressDeep * diagonal, kMaxPress_m * force_limit_N(device) / kForceLimit_N);
  const Vec start = planned_start_m(environment, device);
  const bool is_followed = environment.has_guide() && reaches_guide(environment, device);
  const GuideRun run = plan_guide_run(environment, start, diagonal, is_followed);
  TextLines out;
  out.line(
      "# A hand touches the asset. Written by `firmtouch-sim scenario` from the bounding box.");
  out.line("asset " + tools::path_word(asset));
  add_setting(out, environment, box, diagonal, tool, device);
  out.line("\n# the hand\nhand_stiffness 400 N/m\nhand_damping 4 N*s/m");
  out.add("start %.6g %.6g %.6g m\nhold for %.4g s", start.x, start.y, start.z, kHold_s);
  if (environment.has_surface())
    add_press(out, environment, start, tool, 1.3 * deep, kFirstPress_s);
  if (is_followed)
    out.add("follow guide at %.4g mm/s for %.4g s", run.speed_mps * 1e3, run.time_s);
  else if (environment.has_guide())
    out.line("# not followed: the linkage does not reach the whole guide with its whole force");
  if (!environment.has_surface()) return out.text();
  if (is_followed)
    out.add("follow guide at %.4g mm/s for %.4g s pressing %.4g mm", run.speed_mps * 1e3,
            run.time_s, deep * 1e3);
  add_press(out, environment, run.end, tool, deep, kLastPress_s);
  if (device.linkage != nullptr && device.linkage->is_homed)
    out.line(
        "\n# no emergency stop: its time counts from the start of the run, and homing delays the "
        "hand");
  else
    out.add("\n# the operator, in the middle of the last press\nat %.4g s emergency_stop",
            kHold_s + kFirstPress_s + run.approach_s + 2 * run.time_s + kLastPress_s / 2);
  return out.text();
}

}  // namespace firmtouch::host_sim
