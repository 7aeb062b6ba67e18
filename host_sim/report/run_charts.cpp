#include "host_sim/report/run_charts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "firmtouch/servo/fault.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr const char* kBlue = "var(--force)";
constexpr const char* kOrange = "var(--second)";
constexpr const char* kGrey = "var(--third)";
constexpr const char* kGreen = "var(--good)";

using Output = record::TickOutput;

Vec wide(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::vector<double> values(const Trace& trace, const std::function<double(const Output&)>& of) {
  std::vector<double> list;
  list.reserve(trace.records.size());
  for (const record::TickRecord& r : trace.records) list.push_back(of(r.output));
  // Before its parameters are set, the controller's outputs are meaningless.
  const size_t setup = std::min(trace.setup_ticks, list.size() - 1);
  std::fill(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(setup), list[setup]);
  return list;
}

std::vector<double> lengths(const std::vector<Vec>& vectors) {
  std::vector<double> list;
  for (const Vec& v : vectors) list.push_back(norm(v));
  return list;
}

TimeAxis::Spans spans(const Trace& trace, const std::function<bool(const Output&)>& holds) {
  TimeAxis::Spans list;
  for (size_t i = 0; i < trace.records.size(); ++i) {
    if (!holds(trace.records[i].output)) continue;
    const double from = static_cast<double>(i) / trace.rate_Hz, to = from + 1 / trace.rate_Hz;
    // Gaps of a few ticks are invisible at this scale.
    if (!list.empty() && from - list.back().second < 0.004)
      list.back().second = to;
    else
      list.emplace_back(from, to);
  }
  return list;
}

std::vector<std::pair<double, std::string>> fault_events(const Trace& trace) {
  std::vector<std::pair<double, std::string>> list;
  uint32_t before = 0;
  for (size_t i = 0; i < trace.records.size(); ++i) {
    const uint32_t risen = trace.records[i].output.faults & ~before;
    before |= risen;
    for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
      if ((risen >> bit & 1u) != 0)
        list.emplace_back(static_cast<double>(i) / trace.rate_Hz,
                          std::string("fault: ") + servo::fault_name(bit));
  }
  return list;
}

Chart force_chart(const Report& report) {
  Chart chart{"Force", "N", {}, false, 0, "", 2};
  chart.series.push_back(
      {"of the simulated hand", kGrey, lengths(report.trace.hand_N), false, 1.1});
  chart.series.push_back(
      {"at the tool", kBlue,
       values(report.trace, [](const Output& o) { return norm(wide(o.force_N)); }), true, 1.7});
  return chart;
}

Chart distance_chart(const Report& report) {
  Chart chart{"Distance of the tool's centre to the surface", "mm", {}, false, 0, "", 3};
  chart.series.push_back(
      {"reported (upper bound), negative inside", kBlue,
       values(report.trace,
              [](const Output& o) { return static_cast<double>(o.distance_m) * 1e3; }),
       false, 2.6});
  chart.series.push_back({"certified lower bound", kOrange,
                          values(report.trace,
                                 [](const Output& o) {
                                   return std::copysign(static_cast<double>(o.distance_lower_m),
                                                        static_cast<double>(o.distance_m)) *
                                          1e3;
                                 }),
                          false, 1.1});
  return chart;
}

Chart visits_chart(const Report& report) {
  Chart chart{"Visits a tick",
              "visits",
              {},
              true,
              static_cast<double>(report.summary.budget_visits),
              "",
              0};
  chart.limit_label = "budget " + std::to_string(report.summary.budget_visits);
  chart.series.push_back(
      {"tree nodes read", kBlue,
       values(report.trace, [](const Output& o) { return static_cast<double>(o.steps); }), true,
       1.2});
  return chart;
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

RunCharts make_charts(const Report& report) {
  const Trace& trace = report.trace;
  RunCharts run;
  run.axis.seconds = report.summary.seconds;
  const auto with_motors_on = [](uint32_t bit) {
    return [bit](const Output& o) { return motors_are_on(o) && (o.state & bit) != 0; };
  };
  run.axis.contact_s = spans(trace, with_motors_on(record::kStateContact));
  run.axis.guide_s = spans(trace, with_motors_on(record::kStateOnGuide));
  run.axis.off_s = spans(trace, [](const Output& o) { return o.faults != 0; });
  run.axis.events = fault_events(trace);
  const auto add = [&](Chart chart, std::string note) {
    run.charts.push_back(std::move(chart));
    run.notes.push_back(std::move(note));
  };
  add(force_chart(report), "Force at the tool after all limits; the force limit is " +
                               fixed(report.summary.force_limit_N, 1) +
                               " N. Grey background: after a fault the motors are off.");
  if (report.summary.has_surface) {
    Chart depth{"Penetration of the tool's sphere", "mm", {}, false, 0, "", 2};
    depth.series.push_back(
        {"into the surface", kOrange,
         values(trace, [](const Output& o) { return static_cast<double>(o.penetration_m) * 1e3; }),
         true, 1.6});
    add(std::move(depth),
        "Penalty contact: the contact force is a function of this depth, so the tool penetrates a "
        "softer surface farther. With the motors off (grey) nothing holds the hand.");
    add(distance_chart(report), note_of_distance(report.summary));
  }
  add(visits_chart(report),
      "Surface and guide query together, logarithmic scale. A tick never exceeds its budget.");
  if (report.summary.has_guide) {
    Chart off{"Distance to the guide", "mm", {}, false, 0, "", 2};
    off.series.push_back(
        {"of the tool's centre", kGreen,
         values(trace,
                [](const Output& o) { return static_cast<double>(o.guide_deviation_m) * 1e3; }),
         true, 1.6});
    add(std::move(off),
        "A virtual spring and damper acts across the guide; along it the hand is free.");
  }
  Chart speed{"Speed", "mm/s", {}, false, 0, "", 1};
  speed.series.push_back(
      {"of the tool, as estimated from the encoders", kBlue,
       values(trace, [](const Output& o) { return norm(wide(o.velocity_mps)) * 1e3; }), false,
       1.2});
  add(std::move(speed), "");
  if (report.summary.worst_instructions > 0) {
    Chart work{"Instructions a tick", "instr.", {}, false, 0, "", 0};
    work.series.push_back(
        {"counted on " + trace.controller, kBlue,
         std::vector<double>(trace.instructions.begin(), trace.instructions.end()), false, 1.2});
    add(std::move(work),
        "Instructions of the whole tick. An emulator counts instructions, not cycles.");
  }
  return run;
}

}  // namespace firmtouch::host_sim
