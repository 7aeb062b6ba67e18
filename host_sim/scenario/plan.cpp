#include "host_sim/scenario/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host_sim/scenario/words.hpp"

namespace firmtouch::host_sim {
namespace {

// All of these are shares of the diagonal; the demo's part of 0.14 m gets its design's own 3 mm
// tool.
constexpr double kToolRadius = 0.0212;
constexpr double kHover = 0.18;  // where the hand begins, above the guide's start
constexpr double kSnap = 0.04, kRelease = 0.12;
constexpr double kPressDeep = 0.045;   // how far behind the surface the hand aims
constexpr double kMaxPress_m = 0.016;  // 4 N on the default spring and grip
constexpr double kHold_s = 0.4, kFirstPress_s = 1.6, kLastPress_s = 2;
constexpr double kRoundTime_s = 4.0;  // once along the guide
constexpr double kMaxSpeed = 0.9;  // diagonals a second: beyond it a hand would not follow a guide
constexpr double kMaxSpeed_mps = 0.25;    // a person who follows an edge is no faster
constexpr double kMaxToolRadius_m = 0.1;  // as the parameter table has it

class Lines {
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

Box box_of(const World& world) {
  Box box;
  for (const Vec& p : world.shell().vertices) box.take(p + world.origin_m());
  if (world.has_mesh())
    for (const mesh::Vertex& v : world.mesh().vertices())
      box.take(
          Vec{static_cast<double>(v.x_m), static_cast<double>(v.y_m), static_cast<double>(v.z_m)} +
          world.origin_m());
  for (const Vec& p : world.guide_m()) box.take(p);
  return box;
}

// Away from the surface at the place nearest to `p`; away from the middle of all where there is
// none.
Vec outward(const World& world, Vec p, const Box& box) {
  return world.has_surface() ? world.nearest(p).normal : unit(p - (box.low + box.high) * 0.5);
}

// The hand's way along the guide, and how long it takes; all zero where there is none.
struct Way {
  double speed_mps = 0, time_s = 0, approach_s = 0;
  Vec end;
};

Way way_along(const World& world, Vec start, double diagonal) {
  if (!world.has_guide()) return {0, 0, 0, start};
  const double length = world.guide_length_m();
  Way way;
  way.speed_mps = std::min({length / kRoundTime_s, kMaxSpeed * diagonal, kMaxSpeed_mps});
  way.time_s = std::min(length / way.speed_mps, 3 * kRoundTime_s);
  way.approach_s = norm(start - world.guide_at(0)) / way.speed_mps;
  way.end = world.guide_at(2 * way.speed_mps * way.time_s);
  return way;
}

void add_setting(Lines& out, const World& world, const Box& box, double diagonal, double tool_m) {
  const Vec middle = (box.low + box.high) * 0.5;
  const Vec half = {std::max(0.5, (box.high.x - box.low.x) + diagonal),
                    std::max(0.5, (box.high.y - box.low.y) + diagonal),
                    std::max(0.5, (box.high.z - box.low.z) + diagonal)};
  out.add("rate 1000 Hz\n\n# the device");
  out.add("mass 0.075 kg\nviscous_friction 0.5 N*s/m\ncoulomb_friction 0.02 N");
  out.add("encoder_quantum 10 um\nmotor_limit 12 N");
  out.add("origin_x %.5g m\norigin_y %.5g m\norigin_z %.5g m", middle.x, middle.y, middle.z);
  out.add("workspace_half_x %.4g m\nworkspace_half_y %.4g m\nworkspace_half_z %.4g m", half.x,
          half.y, half.z);
  out.add("\n# what is felt\ntool_radius %.4g mm", tool_m * 1e3);
  out.add("contact_stiffness 1200 N/m\nguide_stiffness 400 N/m");
  if (world.has_surface() && !world.has_mesh()) {
    const Sides sides = sides_of(world.shell());
    out.add("surface_closed %d\nsurface_turned %d", sides.is_closed ? 1 : 0,
            sides.is_turned ? 1 : 0);
    out.add("mesh_steps 2048");  // a surface's part takes more than a triangle
  }
  out.add("guide_snap %.4g mm\nguide_release %.4g mm", kSnap * diagonal * 1e3,
          kRelease * diagonal * 1e3);
}

// Presses `deep_m` behind the surface nearest to `from`.
void add_press(Lines& out, const World& world, Vec from, double tool_m, double deep_m,
               double time_s) {
  const World::Surface under = world.nearest(from);
  const Vec aim = under.point_m + under.normal * (tool_m - deep_m);
  out.add("press %.6g %.6g %.6g m for %.4g s", aim.x, aim.y, aim.z, time_s);
}

}  // namespace

double diagonal_m(const World& world) {
  const Box box = box_of(world);
  return norm(box.high - box.low);
}

std::string plan_scenario(const World& world, const std::string& asset) {
  const Box box = box_of(world);
  const double diagonal = norm(box.high - box.low);
  const double tool = std::min(kToolRadius * diagonal, kMaxToolRadius_m);
  const double deep = std::min(kPressDeep * diagonal, kMaxPress_m);
  const Vec middle = (box.low + box.high) * 0.5;
  const Vec top = {middle.x, middle.y, box.high.z + kHover * diagonal};
  const Vec first = world.has_guide()     ? world.guide_at(0)
                    : world.has_surface() ? world.nearest(top).point_m
                                          : top;
  const Vec start = first + outward(world, first, box) * (kHover * diagonal);
  const Way way = way_along(world, start, diagonal);
  Lines out;
  out.line("# A hand explores the asset: made from its bounding box by `firmtouch-sim scenario`.");
  out.line("asset " + path_word(asset));
  add_setting(out, world, box, diagonal, tool);
  out.add("\n# the hand\nhand_stiffness 400 N/m\nhand_damping 4 N*s/m");
  out.add("start %.6g %.6g %.6g m\nhold for %.4g s", start.x, start.y, start.z, kHold_s);
  if (world.has_surface()) add_press(out, world, start, tool, 1.3 * deep, kFirstPress_s);
  if (world.has_guide())
    out.add("follow guide at %.4g mm/s for %.4g s", way.speed_mps * 1e3, way.time_s);
  if (!world.has_surface()) return out.text();
  if (world.has_guide())
    out.add("follow guide at %.4g mm/s for %.4g s pressing %.4g mm", way.speed_mps * 1e3,
            way.time_s, deep * 1e3);
  add_press(out, world, way.end, tool, deep, kLastPress_s);
  out.add("\n# the operator, in the middle of the last press\nat %.4g s emergency_stop",
          kHold_s + kFirstPress_s + way.approach_s + 2 * way.time_s + kLastPress_s / 2);
  return out.text();
}

}  // namespace firmtouch::host_sim
