#include "host_sim/report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/inertia.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/step.hpp"
#include "host_sim/device/drawn_links.hpp"
#include "host_sim/plant/sampled_wall.hpp"
#include "host_sim/trace/stable_walls.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kCheckedTriangles = 4e7;  // read by the oracle in total: about half a second
constexpr double kMaxChecked = 1e5;
constexpr double kAtLimit = 0.999;  // of the force limit
// Tolerances, relative to max(diagonal, distance): of a float32 distance, and of the tool position
// in the record.
constexpr double kRounding = 4e-7;
constexpr double kBoundRounding = 1e-7;
constexpr double kSplineFactor = 2.5;   // rational splines promise 1e-6 instead of 4e-7
constexpr double kSplineSamples = 4e2;  // of the oracle, per piece

// Where the model's query was: at the proxy that a surface holds, or at the tool's position of the
// tick that requested the model.
Vec queried_m(const record::TickOutput& out, const Vec& model_m) {
  const bool is_held = (out.state & record::kStateProxy) != 0 &&
                       (out.state & record::kStateContact) != 0 &&
                       (out.state >> record::kStateSignShift & 3u) != 0;
  return is_held ? wide(out.proxy_m) : model_m;
}

void count(Summary& summary, const record::TickOutput& out, uint64_t& visits, double& deviation) {
  const bool is_on = motors_are_on(out);
  if (is_on && (out.state & record::kStateContact) != 0) ++summary.contact_ticks;
  if ((out.state & record::kStateExact) != 0) ++summary.exact_ticks;
  if (is_on && (out.state & record::kStateOnGuide) != 0) {
    ++summary.guide_ticks;
    deviation += static_cast<double>(out.guide_deviation_m);
    summary.worst_guide_deviation_m =
        std::max(summary.worst_guide_deviation_m, static_cast<double>(out.guide_deviation_m));
  }
  if ((out.state & record::kStateProxy) != 0) summary.has_proxy = true;
  summary.peak_force_N = std::max(summary.peak_force_N, norm(wide(out.force_N)));
  if (is_on)
    summary.worst_penetration_m =
        std::max(summary.worst_penetration_m, static_cast<double>(out.penetration_m));
  summary.worst_gap_m =
      std::max(summary.worst_gap_m, std::fabs(static_cast<double>(out.distance_m)) -
                                        static_cast<double>(out.distance_lower_m));
  summary.worst_visits = std::max(summary.worst_visits, out.steps);
  visits += out.steps;
  summary.faults |= out.faults;
}

constexpr uint32_t kHomingBits = record::kStateWallRefused - record::kStateNotHomed;

bool is_scripted_fault(const Event& event) {
  return event.kind <= Event::Kind::kEncoderFault || event.kind == Event::Kind::kFail;
}

size_t checked_ticks(const Environment& environment, size_t ticks) {
  // A spline sample costs about as much as ten triangles.
  const double work = environment.has_mesh()
                          ? environment.triangle_count()
                          : 10 * kSplineSamples * environment.surface().pieces().size();
  return static_cast<size_t>(std::clamp(std::min(kCheckedTriangles / work, kMaxChecked), 20.0,
                                        std::max(20.0, static_cast<double>(ticks))));
}

}  // namespace

Summariser::Summariser(const Scenario& scenario, const Environment& environment,
                       const RunFacts& facts)
    : scenario_(scenario),
      environment_(environment),
      moving_(environment.meshes(),
              static_cast<float>(parameter_value(scenario, params::kTickPeriod))),
      tool_(environment.tool(), static_cast<float>(parameter_value(scenario, params::kTickPeriod))),
      facts_(facts),
      turn_(&environment),
      quality_(facts.rate_Hz, parameter_value(scenario, params::kForceLimit)),
      stiffness_N_per_m_(parameter_value(scenario, params::kContactStiffness)) {
  add_oracles();
  summary_.rate_Hz = facts.rate_Hz;
  summary_.has_surface = environment.has_surface();
  summary_.has_guide = environment.has_guide();
  summary_.force_limit_N = parameter_value(scenario, params::kForceLimit);
  if (scenario.linkage) {
    const StableWalls walls = stable_walls(scenario, environment);
    summary_.stable_contact_N_per_m = walls.contact_N_per_m;
    summary_.stable_guide_N_per_m = walls.guide_N_per_m;
    summary_.stable_both_N_per_m = walls.both_N_per_m;
    summary_.enabled_contact_N_per_m = walls.contact_beside_guide_N_per_m;
    summary_.stable_texture_N = walls.texture_N;
  }
  summary_.tool_radius_m = parameter_value(scenario, params::kToolRadius);
  summary_.budget_units = static_cast<uint32_t>(
      std::min(parameter_value(scenario, params::kTickWork) - double{params::kFixedTickWork},
               (environment.has_surface() ? parameter_value(scenario, params::kMeshWork) : 0) +
                   (environment.has_guide() ? parameter_value(scenario, params::kGuideWork) : 0)));
  if (summary_.has_surface)
    stride_ = 1 + facts.ticks / (checked_ticks(environment, facts.ticks) + 1);
}

void Summariser::add_walls(Summary& summary) const {
  const tools::LinkageDevice& device = *scenario_.linkage;
  const auto walls = [&](const tools::TipFigures& tip) {
    SampledWall wall;
    wall.mass_kg = tip.least_mass_kg, wall.viscous_N_s_per_m = tip.least_damping_N_s_per_m;
    wall.damping_N_s_per_m = parameter_value(scenario_, params::kContactDamping);
    wall.period_s = parameter_value(scenario_, params::kTickPeriod);
    const double share = static_cast<double>(environment_.stiffening().share);
    return Summary::Walls{exact_limit_N_per_m(wall) / share, passive_limit_N_per_m(wall) / share};
  };
  TipFollower follower(device);
  const JointMotion* const at = peak_N_ > 0 ? follower.at(peak_m_) : nullptr;
  if (at == nullptr) return;
  const tools::TipFigures tip = tools::tip_figures(device, *at),
                          worst = tools::least_figures(device);
  if (!(tip.least_mass_kg > 0 && worst.least_mass_kg > 0)) return;
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    summary.peak_joints_rad.push_back(at->angle_rad[k]);
  summary.peak_walls = walls(tip), summary.worst_walls = walls(worst);
}

// Objects of one mesh share one.
void Summariser::add_oracles() {
  const std::vector<PlacedMesh>& meshes = environment_.meshes();
  std::vector<const mesh::Head*> heads;
  Vec low{1e300, 1e300, 1e300}, high = low * -1.0;
  for (const PlacedMesh& placed : meshes) {
    const mesh::Head* const head = &placed.mesh.head();
    const auto known = std::find(heads.begin(), heads.end(), head);
    oracle_of_.push_back(static_cast<size_t>(known - heads.begin()));
    for (uint32_t i = 0; i < placed.mesh.vertices().size(); ++i) {
      const Vec p = placed.vertex_m(i);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (known != heads.end()) continue;
    heads.push_back(head);
    brute_force_.emplace_back(placed.mesh);
  }
  nearest_.resize(meshes.size());
  size_m_ = meshes.size() == 1 ? static_cast<double>(meshes[0].mesh.head().diagonal_m)
            : meshes.empty()
                ? static_cast<double>(
                      environment_.has_surface() ? environment_.surface().head().extent_m : 0.0f)
                : norm(high - low);
}

double Summariser::true_distance_m(Vec at_m) {
  if (!environment_.has_mesh())
    return spline_distance_m(environment_.surface(), at_m - environment_.origin_m());
  double least_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < oracle_of_.size(); ++i)
    least_m = std::min(least_m, brute_force_[oracle_of_[i]].distance_m(
                                    moving_.meshes()[i].to_own(at_m), nearest_[i]));
  return least_m;
}

void Summariser::add_faults(uint32_t risen, double time_s) {
  if (risen == 0) return;
  const bool is_scripted =
      std::any_of(facts_.events.begin(), facts_.events.end(), [&](const Event& event) {
        return is_scripted_fault(event) && std::fabs(event.time_s - time_s) < 1.5 / facts_.rate_Hz;
      });
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
    if ((risen >> bit & 1u) != 0)
      summary_.latched.push_back({servo::fault_name(bit), time_s, is_scripted});
}

void Summariser::add(const RunTick& tick) {
  const record::TickRecord& record = tick.record;
  moving_.take(record);
  tool_.take(record);
  if (!tool_.is_empty() && motors_are_on(record.output))
    summary_.peak_torque_Nm =
        std::max(summary_.peak_torque_Nm, norm(wide(record.output.torque_Nm)));
  const record::TickOutput& out = record.output;
  const double time_s = static_cast<double>(summary_.ticks) / facts_.rate_Hz;
  add_faults(out.faults & ~summary_.faults, time_s);
  count(summary_, out, visits_, deviation_m_);
  const bool is_homed = (out.state & record::kStateNotHomed) == 0;
  const uint32_t homing = is_homed ? 0 : out.state & kHomingBits;
  if (homing == 0 && summary_.homing != 0) summary_.homed_s = time_s;
  summary_.homing = homing;
  summary_.refused_wall_ticks += (out.state & record::kStateWallRefused) != 0 ? 1u : 0u;
  summary_.forced_wall_ticks += (out.state & record::kStateWallForced) != 0 ? 1u : 0u;
  const bool is_on = motors_are_on(out);
  const Vec force_N = wide(out.force_N);
  const Vec contact_N = contact_force_N(
      out, environment_.spring_N_per_m(touched_material(out, &environment_), stiffness_N_per_m_));
  if (is_on && norm(contact_N) > peak_N_) peak_N_ = norm(contact_N), peak_m_ = wide(out.position_m);
  quality_.add(force_N, contact_N, turn_.add_rad(out, contact_N), is_on);
  if (is_on && norm(force_N) > kAtLimit * summary_.force_limit_N) ++summary_.limit_ticks;
  const double load = record.input.last_work_us * 1e-6 * facts_.rate_Hz;
  load_ += load;
  summary_.worst_load = std::max(summary_.worst_load, load);
  instructions_ += tick.instructions;
  summary_.mean_late_s += tick.late_s;
  summary_.worst_late_s = std::max(summary_.worst_late_s, tick.late_s);
  summary_.worst_instructions = std::max(summary_.worst_instructions, tick.instructions);
  // The tick whose position the local model of this one was made from.
  const Made now{(out.state & record::kStateReady) != 0, wide(out.position_m)};
  if ((record.input.flags & record::kFlagModelTaken) != 0) used_ = requested_;
  if ((record.input.flags & record::kFlagModelWanted) != 0) requested_ = now;
  if ((record.input.flags & record::kFlagModelApart) == 0) used_ = requested_ = now;
  // Before, the scene is not where the scenario says.
  if (summary_.has_surface && summary_.ticks >= facts_.setup_ticks && summary_.ticks % stride_ == 0)
    check_certificate(out);
  ++summary_.ticks;
}

void Summariser::check_certificate(const record::TickOutput& out) {
  // Without a position, and after an overload, nothing is queried.
  if ((out.state & record::kStateNotHomed) != 0 || (out.faults & servo::kFaultOverload) != 0)
    return;
  if ((out.state & record::kStateReady) == 0 || !used_.is_ready || out.model_sequence == 0) return;
  // Where spheres are held the record does not say where each of them is.
  if (!tool_.is_empty() && (out.state & record::kStateContact) != 0) return;
  const double truth = true_distance_m(tool_.is_empty() ? queried_m(out, used_.position_m)
                                                        : tool_.nearest_m(out, used_.position_m));
  const double scale = std::max(size_m_, truth) * (environment_.has_mesh() ? 1 : kSplineFactor);
  const double reported = std::fabs(static_cast<double>(out.distance_m)),
               lower = static_cast<double>(out.distance_lower_m);
  if (!(lower <= truth + kBoundRounding * scale) || !(reported >= truth - kRounding * scale))
    ++summary_.wrong_bounds;
  if (truth > kRounding * scale * 1000) ratios_.push_back(lower / truth);
  ++summary_.checked_ticks;
}

Summary Summariser::finish() {
  Summary summary = summary_;
  if (scenario_.linkage) add_walls(summary);
  const double ticks = static_cast<double>(std::max<size_t>(summary.ticks, 1));
  summary.seconds = static_cast<double>(summary.ticks) / facts_.rate_Hz;
  summary.mean_load = load_ / ticks;
  summary.mean_late_s /= ticks;
  summary.mean_visits = static_cast<double>(visits_) / ticks;
  if (summary.guide_ticks > 0)
    summary.mean_guide_deviation_m = deviation_m_ / static_cast<double>(summary.guide_ticks);
  summary.mean_instructions = static_cast<double>(instructions_) / ticks;
  summary.stack_high_bytes = facts_.stack_high_bytes;
  summary.chatter_N = quality_.chatter_N();
  summary.chatter_s = quality_.chatter_s();
  summary.worst_turn_rad = quality_.turn_rad();
  summary.guide_step_N = quality_.guide_step_N();
  const auto middle = ratios_.begin() + static_cast<std::ptrdiff_t>(ratios_.size() / 2);
  std::nth_element(ratios_.begin(), middle, ratios_.end());
  if (!ratios_.empty()) summary.median_ratio = *middle;
  return summary;
}

Summary summarise(const Scenario& scenario, const Environment& environment, const Trace& trace) {
  Summariser summariser(scenario, environment, trace);
  for (const record::TickRecord& record : trace.records) {
    RunTick tick;
    tick.record = record;
    summariser.add(tick);
  }
  return summariser.finish();
}

double Summary::deepest_radii() const {
  return tool_radius_m > 0 ? worst_penetration_m / tool_radius_m : 0;
}

bool Summary::is_bad_contact() const {
  return is_saturated() || is_deep() || chatters() || turns();
}

}  // namespace firmtouch::host_sim
