#include "host_sim/report/run_charts.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/servo/fault.hpp"
#include "host_sim/device/drawn_links.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr const char* kBlue = "var(--force)";
constexpr const char* kOrange = "var(--second)";
constexpr const char* kGrey = "var(--third)";
constexpr const char* kGreen = "var(--good)";

using Output = record::TickOutput;

double in_double(float value) { return static_cast<double>(value); }
double length(const float (&v)[3]) {
  return norm({in_double(v[0]), in_double(v[1]), in_double(v[2])});
}

// A value of the controller's output, in `scale` of its unit.
std::function<double(const RunTick&)> output(float Output::*field, double scale) {
  return [=](const RunTick& tick) { return in_double(tick.record.output.*field) * scale; };
}

double signed_lower_mm(const RunTick& tick) {
  const Output& out = tick.record.output;
  return std::copysign(in_double(out.distance_lower_m), in_double(out.distance_m)) * 1e3;
}

std::vector<RunChart> surface_charts() {
  return {{"Penetration of the tool's sphere",
           "mm",
           "The contact force is a function of this depth, so the tool penetrates a softer surface "
           "farther. With the motors off (grey) nothing holds the hand.",
           {{"into the surface", kOrange, output(&Output::penetration_m, 1e3), true}}},
          {"Distance of the tool's centre to the surface",
           "mm",
           "",
           {{"reported (upper bound), negative inside", kBlue, output(&Output::distance_m, 1e3),
             false, 2.6},
            {"certified lower bound", kOrange, signed_lower_mm, false, 1.1}},
           3}};
}

// Of the Jacobian, where the record has the tip; 0 where it cannot be.
std::function<double(const RunTick&)> condition(const tools::LinkageDevice& device) {
  return [tip = TipFollower(device)](const RunTick& tick) mutable {
    const float(&at_m)[3] = tick.record.output.position_m;
    const JointMotion* at = tip.at({in_double(at_m[0]), in_double(at_m[1]), in_double(at_m[2])});
    return at != nullptr ? reciprocal_condition(tip.device(), *at) : 0.0;
  };
}

RunChart condition_chart(const tools::LinkageDevice& device) {
  return {"Reciprocal condition of the linkage",
          "",
          "1: it moves alike in all directions; 0: a singularity. Below " +
              fixed(in_double(device.limits.full_from), 2) + " its force fades, from " +
              fixed(in_double(device.limits.gone_at), 2) + " down there is none.",
          {{"at the tool", kGreen, condition(device), false, 1.2}}};
}

std::vector<RunChart> charts_of(const Environment& environment,
                                const tools::LinkageDevice* linkage) {
  std::vector<RunChart> charts = {
      {"Force",
       "N",
       "",
       {{"of the simulated hand", kGrey, [](const RunTick& tick) { return norm(tick.hand_N); },
         false, 1.1},
        {"at the tool", kBlue,
         [](const RunTick& tick) { return length(tick.record.output.force_N); }, true, 1.7}}}};
  if (environment.has_surface())
    for (RunChart& chart : surface_charts()) charts.push_back(std::move(chart));
  charts.push_back(
      {"Visits a tick",
       "visits",
       "Surface and guide queries together, logarithmic scale.",
       {{"tree nodes read", kBlue,
         [](const RunTick& tick) { return static_cast<double>(tick.record.output.steps); }, true,
         1.2}},
       0,
       true});
  if (environment.has_guide())
    charts.push_back(
        {"Distance to the guide",
         "mm",
         "A virtual spring and damper acts across the guide; along it the hand is free.",
         {{"of the tool's centre", kGreen, output(&Output::guide_deviation_m, 1e3), true}}});
  charts.push_back(
      {"Speed",
       "mm/s",
       "",
       {{"of the tool, as estimated from the encoders", kBlue,
         [](const RunTick& tick) { return length(tick.record.output.velocity_mps) * 1e3; }, false,
         1.2}},
       1});
  if (linkage != nullptr) charts.push_back(condition_chart(*linkage));
  charts.push_back(
      {"Instructions a tick",
       "instr.",
       "Instructions of the whole tick. An emulator counts instructions, not cycles.",
       {{"counted on the controller", kBlue,
         [](const RunTick& tick) { return static_cast<double>(tick.instructions); }, false, 1.2}},
       0});
  return charts;
}

std::string note_of_distance(const Summary& s) {
  std::string note =
      "The true distance lies between the two lines. Checked against an oracle in double on " +
      grouped(s.checked_ticks) + " ticks: " +
      (s.wrong_bounds == 0 ? "always between." : grouped(s.wrong_bounds) + " times outside.");
  return note + " Exact answers: " + grouped(s.exact_ticks) + " of " + grouped(s.ticks) +
         " ticks; far from the surface a query stops early, and its bound is looser.";
}

}  // namespace

RunCharts::RunCharts(const Environment& environment, const RunFacts& facts,
                     const tools::LinkageDevice* linkage)
    : facts_(facts),
      ticks_per_bin_(1 + (facts.ticks + facts.spare_ticks - 1) / static_cast<uint32_t>(kMaxBins)),
      bins_(1 + (facts.ticks + facts.spare_ticks - 1) / ticks_per_bin_),
      charts_(charts_of(environment, linkage)) {
  min_gap_s_ = std::max(0.004, static_cast<double>(bins_) * ticks_per_bin_ / facts.rate_Hz / 4096);
  for (RunChart& chart : charts_)
    for (Curve& curve : chart.curves) curve.values = {bins_, ticks_per_bin_ == 1};
}

void RunCharts::add(const RunTick& tick) {
  const uint32_t number = ticks_++;
  // Before its parameters are set, the controller's outputs are meaningless.
  if (number < facts_.setup_ticks) return;
  const size_t bin = number / ticks_per_bin_;
  const size_t first = number == facts_.setup_ticks ? 0 : bin;
  for (RunChart& chart : charts_)
    for (Curve& curve : chart.curves) {
      const double value = curve.of(tick);
      for (size_t i = first; i <= bin; ++i) curve.values.add(i, value);
    }
  const Output& out = tick.record.output;
  const double time_s = number / facts_.rate_Hz;
  const bool is_on = motors_are_on(out);
  add_span(axis_.contact_s, is_on && (out.state & record::kStateContact) != 0, time_s);
  add_span(axis_.guide_s, is_on && (out.state & record::kStateOnGuide) != 0, time_s);
  add_span(axis_.off_s, out.faults != 0, time_s);
  add_faults(out.faults, time_s);
}

void RunCharts::add_span(chart::TimeAxis::Spans& spans, bool holds, double time_s) const {
  if (!holds) return;
  const double end_s = time_s + 1 / facts_.rate_Hz;
  if (!spans.empty() && time_s - spans.back().second < min_gap_s_)
    spans.back().second = end_s;
  else
    spans.emplace_back(time_s, end_s);
}

// Each fault once.
void RunCharts::add_faults(uint32_t faults, double time_s) {
  const uint32_t risen = faults & ~faults_;
  faults_ |= risen;
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
    if ((risen >> bit & 1u) != 0)
      axis_.events.emplace_back(time_s, std::string("fault: ") + servo::fault_name(bit));
}

void RunCharts::finish(const Summary& summary) {
  bins_ = 1 + (facts_.ticks - 1) / ticks_per_bin_;
  axis_.seconds = static_cast<double>(bins_) * ticks_per_bin_ / facts_.rate_Hz;
  for (RunChart& chart : charts_)
    for (Curve& curve : chart.curves) curve.values.shorten(bins_);
  if (summary.worst_instructions == 0) charts_.pop_back();
  charts_.front().note = "Force at the tool after all limits; the force limit is " +
                         fixed(summary.force_limit_N, 1) +
                         " N. Grey background: after a fault the motors are off.";
  for (RunChart& chart : charts_) {
    if (chart.decimals == 3) chart.note = note_of_distance(summary);
  }
  for (size_t i = 0; i < axis_.events.size() && i < summary.latched.size(); ++i)
    if (summary.latched[i].is_scripted) axis_.events[i].second += " (part of the scenario)";
}

chart::Chart chart_of(const RunChart& from) {
  chart::Chart chart{from.title, from.unit, {}, from.is_logarithmic, from.decimals};
  for (const Curve& curve : from.curves)
    chart.series.push_back(
        {curve.label, curve.colour, curve.values.values(), curve.is_area, curve.width});
  return chart;
}

}  // namespace firmtouch::host_sim
