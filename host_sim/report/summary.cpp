#include "host_sim/report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmtouch/params/table.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/step.hpp"
#include "host_sim/plant/brute_force.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kCheckedTriangles = 4e7;  // read by the oracle in total: about half a second
// Tolerances, relative to max(diagonal, distance): of a float32 distance, and of the tool position
// in the record.
constexpr double kRounding = 4e-7;
constexpr double kBoundRounding = 1e-7;
constexpr double kSplineFactor = 2.5;   // rational splines promise 1e-6 instead of 4e-7
constexpr double kSplineSamples = 4e2;  // of the oracle, per piece

Vec wide(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// For each tick, the tick whose position its local model was made from.
std::vector<size_t> model_ticks(const Trace& trace) {
  std::vector<size_t> made(trace.records.size());
  size_t used = 0, requested = 0;
  for (size_t i = 0; i < trace.records.size(); ++i) {
    const uint32_t flags = trace.records[i].input.flags;
    if ((flags & record::kFlagModelTaken) != 0) used = requested;
    if ((flags & record::kFlagModelWanted) != 0) requested = i;
    if ((flags & record::kFlagModelApart) == 0) used = requested = i;
    made[i] = used;
  }
  return made;
}

// Where the model's query was: at the proxy that a surface holds, or at the tool's position of the
// tick that requested the model.
const float (&queried_m(const record::TickOutput& out, const record::TickOutput& model))[3] {
  const bool is_held = (out.state & record::kStateProxy) != 0 &&
                       (out.state & record::kStateContact) != 0 &&
                       (out.state >> record::kStateSignShift & 3u) != 0;
  return is_held ? out.proxy_m : model.position_m;
}

void check_certificates(Summary& summary, const Environment& environment, const Trace& trace) {
  const mesh::View& mesh = environment.mesh();
  const bool is_mesh = environment.has_mesh();
  const double size_m =
      static_cast<double>(is_mesh ? mesh.head().diagonal_m : environment.surface().head().extent_m);
  // A spline sample costs about as much as ten triangles.
  const double work = is_mesh ? mesh.head().triangle_count
                              : 10 * kSplineSamples * environment.surface().pieces().size();
  const size_t count = static_cast<size_t>(
      std::clamp(kCheckedTriangles / work, 20.0, static_cast<double>(trace.records.size())));
  const size_t stride = std::max<size_t>(1, trace.records.size() / count);
  const std::vector<size_t> made = model_ticks(trace);
  std::vector<double> ratios;
  for (size_t i = 0; i < trace.records.size(); i += stride) {
    const record::TickOutput& out = trace.records[i].output;
    if ((out.state & record::kStateReady) == 0) continue;
    const record::TickOutput& model = trace.records[made[i]].output;
    if ((model.state & record::kStateReady) == 0 || out.model_sequence == 0) continue;
    const Vec at = wide(queried_m(out, model)) - environment.origin_m();
    const double truth =
        is_mesh ? brute_force_distance_m(mesh, at) : spline_distance_m(environment.surface(), at);
    const double scale = std::max(size_m, truth) * (is_mesh ? 1 : kSplineFactor);
    const double reported = std::fabs(static_cast<double>(out.distance_m)),
                 lower = static_cast<double>(out.distance_lower_m);
    if (!(lower <= truth + kBoundRounding * scale) || !(reported >= truth - kRounding * scale))
      ++summary.wrong_bounds;
    if (truth > kRounding * scale * 1000) ratios.push_back(lower / truth);
    ++summary.checked_ticks;
  }
  if (ratios.empty()) return;
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  summary.median_ratio = ratios[ratios.size() / 2];
}

void count(Summary& summary, const record::TickOutput& out, double time_s, uint64_t& visits,
           double& deviation) {
  const bool is_on = motors_are_on(out);
  if (is_on && (out.state & record::kStateContact) != 0) ++summary.contact_ticks;
  if ((out.state & record::kStateExact) != 0) ++summary.exact_ticks;
  if (is_on && (out.state & record::kStateOnGuide) != 0) {
    ++summary.guide_ticks;
    deviation += static_cast<double>(out.guide_deviation_m);
    summary.worst_guide_deviation_m =
        std::max(summary.worst_guide_deviation_m, static_cast<double>(out.guide_deviation_m));
  }
  summary.peak_force_N = std::max(summary.peak_force_N, norm(wide(out.force_N)));
  if (is_on)
    summary.worst_penetration_m =
        std::max(summary.worst_penetration_m, static_cast<double>(out.penetration_m));
  summary.worst_gap_m =
      std::max(summary.worst_gap_m, std::fabs(static_cast<double>(out.distance_m)) -
                                        static_cast<double>(out.distance_lower_m));
  summary.worst_visits = std::max(summary.worst_visits, out.steps);
  visits += out.steps;
  if (out.faults != 0 && summary.fault_s < 0) summary.fault_s = time_s;
  summary.faults |= out.faults;
}

}  // namespace

Summary summarise(const Scenario& scenario, const Environment& environment, const Trace& trace) {
  Summary summary;
  summary.ticks = trace.records.size();
  summary.rate_Hz = trace.rate_Hz;
  summary.seconds = static_cast<double>(summary.ticks) / trace.rate_Hz;
  summary.has_surface = environment.has_surface();
  summary.has_guide = environment.has_guide();
  summary.force_limit_N = parameter_value(scenario, params::kForceLimit);
  summary.budget_visits = static_cast<uint32_t>(
      (environment.has_surface() ? parameter_value(scenario, params::kMeshSteps) : 0) +
      (environment.has_guide() ? parameter_value(scenario, params::kCurveSteps) : 0));
  uint64_t visits = 0, instructions = 0;
  double deviation = 0;
  for (size_t i = 0; i < trace.records.size(); ++i) {
    count(summary, trace.records[i].output, static_cast<double>(i) / trace.rate_Hz, visits,
          deviation);
    const double load = trace.records[i].input.last_work_us * 1e-6 * trace.rate_Hz;
    summary.mean_load += load;
    summary.worst_load = std::max(summary.worst_load, load);
  }
  const double ticks = static_cast<double>(std::max<size_t>(summary.ticks, 1));
  summary.mean_load /= ticks;
  summary.mean_visits = static_cast<double>(visits) / ticks;
  if (summary.guide_ticks > 0)
    summary.mean_guide_deviation_m = deviation / static_cast<double>(summary.guide_ticks);
  for (const uint32_t n : trace.instructions) {
    instructions += n;
    summary.worst_instructions = std::max(summary.worst_instructions, n);
  }
  summary.mean_instructions = static_cast<double>(instructions) / ticks;
  summary.stack_high_bytes = trace.stack_high_bytes;
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
    if ((summary.faults >> bit & 1u) != 0)
      summary.fault_names +=
          (summary.fault_names.empty() ? "" : ", ") + std::string(servo::fault_name(bit));
  if (summary.has_surface) check_certificates(summary, environment, trace);
  return summary;
}

std::string load_text(const Summary& s) {
  char text[64];
  std::snprintf(text, sizeof text, "mean %.0f %%, worst %.0f %% of the period", s.mean_load * 100,
                s.worst_load * 100);
  return s.worst_load > 0 ? text : "not measured (lock-step)";
}

std::string text_of(const Summary& s, const Trace& trace) {
  std::string text;
  const auto line = [&](const char* format, auto... values) {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, format, values...);
    text += buffer;
  };
  line("  ticks          %zu at %g Hz (%.4g s), controller: %s\n", s.ticks, s.rate_Hz, s.seconds,
       trace.controller.c_str());
  line(
      "  contact        %zu ticks with the motors on; peak force %.2f N (limit %.2f N); deepest "
      "penetration %.2f mm\n",
      s.contact_ticks, s.peak_force_N, s.force_limit_N, s.worst_penetration_m * 1e3);
  if (s.has_guide)
    line("  guide          %zu ticks on it; mean deviation %.2f mm, worst %.2f mm\n", s.guide_ticks,
         s.mean_guide_deviation_m * 1e3, s.worst_guide_deviation_m * 1e3);
  line("  visits a tick  mean %.1f, worst %u, budget %u (tree nodes read)\n", s.mean_visits,
       s.worst_visits, s.budget_visits);
  if (s.has_surface)
    line(
        "  certificate    lower <= true distance <= upper bound: %zu of %zu checked ticks (oracle "
        "in double)\n",
        s.checked_ticks - s.wrong_bounds, s.checked_ticks);
  if (s.worst_instructions > 0)
    line("  instructions   mean %.0f a tick, worst %u; stack %u bytes\n", s.mean_instructions,
         s.worst_instructions, s.stack_high_bytes);
  line("  load           %s\n", load_text(s).c_str());
  if (trace.compared)
    text += trace.difference ? "  same bits      NO: see below\n"
                             : "  same bits      yes: every output bit of every tick is equal to "
                               "the in-process controller's\n";
  if (s.fault_s >= 0)
    line("  fault          %s, latched at %.3f s\n", s.fault_names.c_str(), s.fault_s);
  return text;
}

}  // namespace firmtouch::host_sim
