#include <algorithm>

#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/objects.hpp"
#include "firmtouch/servo/fault.hpp"
#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/contact_rows.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/trace/tick.hpp"

namespace firmtouch::host_sim {
namespace {

// Ticks of 1 ms in which the objects move; before and after they stand.
constexpr uint32_t kBegin = 600, kEnd = 680;

// A plate that stands on a slope, so that no coordinate is exact: its own axes in the device frame.
constexpr math::Mat3 kSlope{{{0.36f, -0.8f, 0.48f}, {0.48f, 0.6f, 0.64f}, {-0.8f, 0, 0.6f}}};
constexpr Vec kUp{0.48, 0.64, 0.6};

double height_m(double from_m, double speed_mps, uint32_t tick) {
  const uint32_t moved = std::clamp(tick, kBegin, kEnd) - kBegin;
  return from_m + speed_mps * 0.001 * moved;
}

// A plate whose top is at that height along the slope's axis, facing up or down.
math::RigidTransform plate_at(double top_m, bool faces_down) {
  const auto part = [top_m](double axis) { return static_cast<float>(axis * top_m); };
  math::RigidTransform pose{kSlope, {part(kUp.x), part(kUp.y), part(kUp.z)}};
  if (!faces_down) return pose;
  for (math::Vec3& row : pose.rotation.row) row = {row.x, -row.y, -row.z};
  return pose;
}

// 40 mm at 0.5 m/s.
struct RisingWall {
  static constexpr uint32_t kObjects = 1;
  static constexpr double kFrom_m = -0.025, kSpeed_mps = 0.5;
  static double top_m(uint32_t, uint32_t tick) { return height_m(kFrom_m, kSpeed_mps, tick); }
};

// A floor that the hand presses on, and a roof 26 mm above it that comes down 40 mm.
struct ClosingWalls {
  static constexpr uint32_t kObjects = 2;
  static double top_m(uint32_t object, uint32_t tick) {
    return object == 0 ? height_m(0.003, 0, tick) : height_m(0.029, -0.5, tick);
  }
};

/// A surface policy: the asset's mesh as objects that move by a plan.
template <class Plan>
class MovingSurface : public MeshSurface {
 public:
  void reset() { scene_ = {}; }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    scene::MeshObject shape;
    shape.mesh = &mesh();
    const scene::ProxyContact contact = proxy_contact(request, values, result);
    for (uint32_t i = 0; i < Plan::kObjects; ++i) {
      scene_.object[i].pose = plate_at(Plan::top_m(i, request.tick), i == 1);
    }
    Shapes shapes{shape, scene_.hint};
    scene::touch_objects(contact, {scene_.object, scene_.pair, Plan::kObjects}, shapes,
                         scene_.touch, result.model);
    report_proxy(scene_.touch.touch, request.position_m, result);
  }

 private:
  struct Shapes {
    const scene::MeshObject& shape;
    mesh::Hint* hint;
    float size_m() const { return 0.3f; }
    scene::Near near(uint32_t object, math::Vec3 x_m, query::Budget budget, float needed_m) {
      return scene::MeshTouched{shape, hint[object]}.near(x_m, budget, needed_m);
    }
  };
  struct Scene {
    scene::Object object[Plan::kObjects];
    scene::ObjectPair pair[Plan::kObjects];
    mesh::Hint hint[Plan::kObjects];
    scene::ObjectsTouch touch;
  } scene_;
};

template <class Plan>
RigRun moved(const Rig& rig, Vec start_m, const std::vector<std::string>& script) {
  // With every parameter that a scenario may set.
  Controller<Surfaces<MovingSurface<Plan>, SplineSurface>, Guides<CurveGuide, SplineGuide>>
      controller;
  const AssetFile asset(rig.bake(plate(0.04)));
  if (!controller.open(asset.bytes()).ok()) throw Refused("the bench's plate");
  return rig.run(tick_of(controller), start_m, script, {{"contact_damping", "0 N*s/m"}});
}

// Without damping the force of each tick is K times how far the measured position is behind the
// wall, up to the force limit.
void add_rising_wall(const Rig& rig, bench::Report& report) {
  const RigRun run = moved<RisingWall>(rig, {}, {Rig::hold_s(1.2)});
  const double r = rig.radius_m, stiffness = rig.stiffness_N_per_m;
  double off = 0, late = 0, through = 0, largest_N = 0, faults = 0;
  for (uint32_t i = 0; i < run.size(); ++i) {
    const RigTick& tick = run[i];
    if (!tick.is_on) continue;
    const double top_m = RisingWall::top_m(0, i);
    const double wanted_N = std::max(0.0, stiffness * (top_m + r - dot(kUp, tick.position_m)));
    const double allowed_N = 0.005 * wanted_N + stiffness * 2e-6 * 0.3;
    const double force_N = norm(tick.force_N);
    off = std::max(off, norm(tick.force_N - kUp * wanted_N) / allowed_N);
    if (wanted_N > allowed_N && force_N < wanted_N / 2) ++late;
    if (dot(kUp, tick.proxy_m) < top_m + r - 2e-6 * 0.3) ++through;
    if (tick.faults != 0) ++faults;
    largest_N = std::max(largest_N, force_N);
  }
  const double seat_N = rig.series_N_per_m() * (RisingWall::top_m(0, kEnd) + r);
  const Vec rest_N = mean_force_N(run, 200) - kUp * seat_N;
  report.bar("force in each tick, off the closed form over what is allowed", "wall 0.5 m/s", off,
             "", 1,
             "allowed: 0.5 % + K x 2e-6 of the scene; to " + bench::number_text(largest_N) + " N");
  report.bar("ticks late", "wall 0.5 m/s", late, "", 0);
  report.bar("ticks with the proxy behind the wall", "wall 0.5 m/s", through, "", 0);
  report.bar("force at rest, off the closed form", "wall 0.5 m/s", norm(rest_N), "N",
             0.005 * seat_N + 0.012, "closed form " + bench::number_text(seat_N) + " N");
  report.bar("ticks with a fault", "wall 0.5 m/s", faults, "", 0);
}

void add_closing_walls(const Rig& rig, bench::Report& report) {
  const RigRun run =
      moved<ClosingWalls>(rig, kUp * 0.012, {Rig::hold_s(0.1), rig.to({}, 0.05), Rig::hold_s(0.6)});
  double largest_N = 0, step_N = 0, late_N = 0, gap_m = 0, through = 0;
  uint32_t latched = 0;
  for (uint32_t i = 1; i < run.size(); ++i) {
    const double force_N = norm(run[i].force_N);
    largest_N = std::max(largest_N, force_N);
    step_N = std::max(step_N, norm(run[i].force_N - run[i - 1].force_N));
    const double floor_m = ClosingWalls::top_m(0, i), roof_m = ClosingWalls::top_m(1, i);
    if (latched == 0 && run[i].faults != 0) latched = i, gap_m = roof_m - floor_m;
    if (latched != 0 && i >= latched + 10) late_N = std::max(late_N, force_N);
    const double at_m = dot(kUp, run[i].proxy_m);
    if (run[i].is_on && latched == 0 && (at_m < floor_m || at_m > roof_m)) ++through;
  }
  const bool is_squeezed = run.back().faults == servo::kFaultSqueezed;
  report.bar("faults other than squeezed, or none", "walls that close", is_squeezed ? 0 : 1, "", 0);
  report.bar_at_least("room when the fault is latched, over the tool's size", "walls that close",
                      gap_m / (2 * rig.radius_m), "", 0.9 - 0.0005 / (2 * rig.radius_m),
                      "0.9, less what closes in a tick");
  report.bar("ticks with the proxy behind a wall", "walls that close", through, "", 0);
  report.bar("largest force", "walls that close", largest_N, "N", 8, "force_limit_N");
  report.bar("largest step of the force", "walls that close", step_N, "N", 5.001,
             "slew_limit_N_per_s in a tick");
  report.bar("force 10 ms after the fault", "walls that close", late_N, "N", 0);
}

}  // namespace

// Objects that move, touched by the standard rig's tool, which a hand holds.
void run_moving_bench(const bench::Options& options, bench::Report& report) {
  const Rig rig(0);
  add_rising_wall(rig, report);
  add_closing_walls(rig, report);
  add_material_rows(options.is_long, report);
}

}  // namespace firmtouch::host_sim
