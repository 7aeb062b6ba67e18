#include <filesystem>
#include <limits>

#include "firmtouch/params/table.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/report/page_parts.hpp"
#include "host_sim/report/report.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/stage.hpp"

namespace firmtouch::host_sim {
namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string claim(const std::string& name, const std::string& big, const std::string& text) {
  return "<li><span class=\"name\">" + name + "</span><span class=\"big\">" + big + "</span><p>" +
         text + "</p></li>";
}

std::string certificate_claim(const Summary& s) {
  if (!s.has_surface)
    return claim("Certificate", "<span class=\"open\">no surface</span>",
                 "This asset has no mesh to keep a distance to.");
  const bool holds = s.wrong_bounds == 0;
  return claim("Certificate",
               std::string("<span class=\"") + (holds ? "yes" : "no") + "\">" +
                   (holds ? "holds" : grouped(s.wrong_bounds) + " wrong") + "</span> <small>on " +
                   grouped(s.judged_ticks) + " ticks</small>",
               "Every answer carries a certified lower bound. Judged in this run against brute "
               "force over all triangles, in double: "
               "lower &le; truth &le; told. Median bound: " +
                   fixed(s.median_ratio * 100, 2) + " % of the truth.");
}

std::string steps_claim(const Summary& s) {
  return claim("Steps",
               std::to_string(s.worst_steps) + " <small>of " + std::to_string(s.budget_steps) +
                   " at worst</small>",
               "A tick reads at most its budget of tree nodes, whatever the shape: fixed memory, "
               "no heap, a bound known beforehand. Mean: " +
                   fixed(s.mean_steps, 1) + ".");
}

std::string core_of(const std::string& controller) {
  if (controller.compare(0, 11, "mps2-an500 ") == 0) return " on the Cortex-M7";
  if (controller.compare(0, 14, "netduinoplus2 ") == 0) return " on the Cortex-M4F";
  return "";
}

std::string bits_claim(const Report& report) {
  const Trace& trace = report.trace;
  if (trace.compared && !trace.difference)
    return claim("Same bits" + core_of(trace.controller),
                 "<span class=\"yes\">all equal</span> <small>" + grouped(trace.records.size()) +
                     " ticks</small>",
                 "Verified in this run: every output bit of every tick from " +
                     html_of(trace.controller) + " equals the in-process controller&rsquo;s.");
  if (trace.difference)
    return claim("Same bits", "<span class=\"no\">they differ</span>",
                 "First at tick " + std::to_string(trace.difference->tick) + " in " +
                     html_of(trace.difference->field) + ".");
  return claim(
      "Same bits on the Cortex-M7", "<span class=\"open\">not compared</span>",
      "This run was in-process. <code>tools/test</code> compares every bit with an emulated "
      "Cortex-M7; so does <code>--controller qemu:mps2-an500</code> here.");
}

std::string contact_claim(const Summary& s) {
  return claim("Contact", "penalty <small>up to " + fixed(s.peak_force_N, 2) + " N</small>",
               "A spring on the depth of the tool&rsquo;s sphere, from the signed distance; no "
               "proxy yet. Deepest while the motors were on: " +
                   fixed(s.worst_penetration_m * 1e3, 2) +
                   " mm. A wall thinner than twice that could be pushed through.");
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>";
}

std::string table(const Report& report, const Stage& stage) {
  const Summary& s = report.summary;
  const Scenario& scenario = report.scenario;
  const auto value = [&](uint32_t parameter, int decimals) {
    return fixed(parameter_value(scenario, parameter), decimals);
  };
  std::string rows;
  if (s.has_surface) rows += row("Part", grouped(stage.source_triangles) + " triangles");
  if (s.has_guide)
    rows += row("Guide", grouped(report.world.guide_m().size()) + " points, " +
                             fixed(report.world.guide_length_m() * 1e3, 1) + " mm");
  rows += row("Asset in flash", grouped(report.asset_bytes) + " bytes");
  rows += row("Controller state in RAM", grouped(sizeof(Controller)) + " bytes");
  rows += row("Ticks", grouped(s.ticks) + " at " + fixed(s.rate_Hz, 0) + " Hz");
  rows += row("in contact, motors on", grouped(s.contact_ticks));
  if (s.has_guide) rows += row("on the guide, motors on", grouped(s.guide_ticks));
  rows += row("Peak force", fixed(s.peak_force_N, 2) + " N of " + fixed(s.force_limit_N, 1) + " N");
  rows += row("Deepest penetration, motors on", fixed(s.worst_penetration_m * 1e3, 2) + " mm");
  if (s.has_guide)
    rows +=
        row("Mean distance to the guide, on it", fixed(s.mean_guide_deviation_m * 1e3, 2) + " mm");
  rows += row("Steps a tick: mean, worst, budget", fixed(s.mean_steps, 1) + ", " +
                                                       std::to_string(s.worst_steps) + ", " +
                                                       std::to_string(s.budget_steps));
  if (s.worst_instructions > 0) {
    rows += row(
        "Instructions a tick: mean, worst",
        grouped(static_cast<uint64_t>(s.mean_instructions)) + ", " + grouped(s.worst_instructions));
    rows += row("Deepest stack", grouped(s.stack_high_bytes) + " bytes");
  }
  rows += row("Stiffness, damping", value(params::kContactStiffness, 0) + " N/m, " +
                                        value(params::kContactDamping, 1) + " N&middot;s/m");
  rows += row("Tool radius", fixed(stage.tool_radius_m * 1e3, 2) + " mm");
  rows +=
      row("Device", fixed(scenario.device.mass_kg * 1e3, 0) + " g, " +
                        fixed(scenario.device.encoder_quantum_m * 1e6, 0) + " &micro;m a count");
  rows +=
      row("Faults latched",
          s.fault_s < 0 ? "none" : html_of(s.fault_names) + " at " + fixed(s.fault_s, 3) + " s");
  return "<table>" + rows + "</table>";
}

std::string legend(const Stage& stage) {
  std::string html = "<div class=\"legend\">";
  for (const Path& path : stage.paths)
    html += "<label><input type=\"checkbox\" checked data-path=\"" + path.key +
            "\"><i style=\"background:" +
            (path.values.empty() ? hex_of(path.colour)
                                 : "linear-gradient(90deg," + hex_of(heat(0.05)) + "," +
                                       hex_of(heat(0.4)) + "," + hex_of(heat(1)) + ")") +
            "\"></i>" + path.label + "</label>";
  return html +
         "<label class=\"upright\"><input type=\"checkbox\" id=\"upright\" autocomplete=\"off\">y "
         "is up</label></div>";
}

std::string plots(const RunCharts& run) {
  std::string html;
  for (size_t i = 0; i < run.charts.size(); ++i) {
    const Chart& chart = run.charts[i];
    html += "<section class=\"card plot\"><header><h2>" + chart.title + "</h2><div class=\"keys\">";
    for (const Series& s : chart.series)
      html += "<span><i style=\"background:" + s.colour + "\"></i>" + html_of(s.label) +
              "<span class=\"value\"></span></span>";
    if (i == 0)
      html +=
          "<span><i style=\"background:var(--second)\"></i>in contact</span><span><i "
          "style=\"background:var(--good)\"></i>on the guide</span>";
    html += "</div><span class=\"now\"></span></header>" +
            svg_of(chart, run.axis, {}, static_cast<int>(i));
    if (!run.notes[i].empty()) html += "<p>" + run.notes[i] + "</p>";
    html += "</section>";
  }
  return html;
}

std::string lede(const Report& report) {
  const Summary& s = report.summary;
  std::string text = "A simulated hand explores <b>" + html_of(file_name(report.asset_path)) +
                     "</b> for " + fixed(s.seconds, 1) + " s: " + grouped(s.ticks) +
                     " ticks of the controller that runs on the board. ";
  text +=
      "Every distance comes with a <b>certificate</b>, every tick keeps its <b>step budget</b>, "
      "and the outputs are made to be "
      "<b>the same bits</b> on every machine. ";
  return text + "What is felt is <b>penalty contact</b>" +
         (s.has_guide ? " and a guide&rsquo;s virtual spring." : ".");
}

// For readers without scripts.
std::string noscript(const Stage& stage) {
  const std::string png = png_of(
      draw(stage, 720, 500, {238, 241, 245}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  return "<noscript><img alt=\"the part with its paths\" style=\"width:100%\" "
         "src=\"data:image/png;base64," +
         base64_of(png.data(), png.size()) + "\"></noscript>";
}

}  // namespace

std::string page_of(const Report& report) {
  const Stage stage =
      make_stage(report.world, report.trace, parameter_value(report.scenario, params::kToolRadius));
  const RunCharts run = make_charts(report);
  const std::string name = html_of(file_name(report.asset_path));
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">"
      "<title>Firmtouch: " +
      name + "</title><link rel=\"icon\" href=\"data:,\"><style>\n" + std::string(kReportCss) +
      "</style></head>\n<body><main>";
  html += "<p class=\"brand\"><b>Firmtouch</b> run report</p><h1>Touching " + name +
          "</h1><p class=\"lede\">" + lede(report) + "</p>";
  html += "<ul class=\"claims\">" + certificate_claim(report.summary) +
          steps_claim(report.summary) + bits_claim(report) + contact_claim(report.summary) +
          "</ul>\n";
  html +=
      "<div class=\"top\"><section class=\"card stage\"><div class=\"title\"><h2>The part, the "
      "guide and the tool</h2><span class=\"now\"></span></div>"
      "<p class=\"hint\">drag to turn, click and scroll to zoom, double-click to reset</p>"
      "<div class=\"sight\"><canvas id=\"stage\" tabindex=\"0\" role=\"img\" aria-label=\"the part "
      "in 3D with the device's and the tool's paths\"></canvas></div>" +
      noscript(stage) + legend(stage) +
      "</section><section class=\"card\"><h2>The numbers that matter</h2>" + table(report, stage) +
      "</section></div>\n";
  html += plots(run);
  html +=
      "<footer><p>Made by <code>" + html_of(report.command) +
      "</code>. The distances are the controller&rsquo;s own; the judge is independent of it.</p>"
      "<details><summary>The scenario</summary><pre>" +
      html_of(report.scenario.text) + "</pre></details></footer></main>\n";
  html += "<script type=\"application/json\" id=\"run-data\">" + data_of(report, stage, run) +
          "</script>\n<script>\n" + std::string(kViewerJs) + "</script></body></html>\n";
  return html;
}

}  // namespace firmtouch::host_sim
