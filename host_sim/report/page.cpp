#include <filesystem>

#include "firmtouch/params/table.hpp"
#include "host_sim/report/condition_map.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/report/page_parts.hpp"
#include "host_sim/report/report.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"
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
                 "This asset has no surface, so there is no distance to check.");
  const bool holds = s.wrong_bounds == 0;
  return claim("Certificate",
               std::string("<span class=\"") + (holds ? "yes" : "no") + "\">" +
                   (holds ? "valid" : grouped(s.wrong_bounds) + " wrong") + "</span> <small>on " +
                   grouped(s.checked_ticks) + " checked ticks</small>",
               "Every distance comes with a certified lower bound. This run checked lower bound "
               "&le; true distance &le; reported distance against an oracle in double precision. "
               "The median lower bound is " +
                   fixed(s.median_ratio * 100, 2) + " % of the true distance.");
}

std::string visits_claim(const Summary& s) {
  return claim("Visits", std::to_string(s.worst_visits) + " <small>in the worst tick</small>",
               "A visit is one tree node read by a query. A budget of work bounds the time of a "
               "tick: " +
                   std::to_string(s.budget_units) +
                   " units here, base hulls apart. A visit takes one unit; three visits of a mesh "
                   "take one. Mean: " +
                   fixed(s.mean_visits, 1) + " visits.");
}

std::string core_of(const std::string& controller) {
  if (controller.compare(0, 11, "mps2-an500 ") == 0) return " on the Cortex-M7";
  if (controller.compare(0, 14, "netduinoplus2 ") == 0) return " on the Cortex-M4F";
  return "";
}

std::string bits_claim(const Report& report) {
  const RunFacts& trace = report.facts;
  if (trace.compared && !trace.difference)
    return claim("Same bits" + core_of(trace.controller),
                 "<span class=\"yes\">all equal</span> <small>" + grouped(report.summary.ticks) +
                     " ticks</small>",
                 "In this run every output bit of every tick of " + html_of(trace.controller) +
                     " was equal to the in-process controller&rsquo;s.");
  if (trace.difference)
    return claim("Same bits", "<span class=\"no\">different</span>",
                 "First difference: tick " + std::to_string(trace.difference->tick) + ", field " +
                     html_of(trace.difference->field) + ".");
  return claim("Same bits on the Cortex-M7", "<span class=\"open\">not compared</span>",
               "This run used the in-process controller only. Add <code>--controller"
               "</code> <code>qemu:mps2-an500</code> to compare every output bit with an emulated "
               "Cortex-M7.");
}

std::string contact_claim(const Summary& s) {
  return claim("Contact", fixed(s.peak_force_N, 2) + " N <small>peak force</small>",
               "A spring between the hand and a proxy that crosses no surface. Farthest of the "
               "hand from the proxy, with motors on: " +
                   fixed(s.worst_penetration_m * 1e3, 2) + " mm.");
}

std::string quality_item(const std::string& text, bool is_bad) {
  return is_bad ? "<span class=\"no\">" + text + "</span>" : text;
}

std::string quality_claim(const Summary& s) {
  if (s.contact_ticks + s.guide_ticks == 0)
    return claim("Feel", "<span class=\"no\">nothing was touched</span>",
                 "No tick had contact or guidance while the motors were on.");
  return claim(
      "Feel",
      s.is_bad_contact() ? "<span class=\"no\">bad</span>" : "<span class=\"yes\">calm</span>",
      quality_item(grouped(s.limit_ticks) + " ticks at the force limit", s.is_saturated()) + "; " +
          quality_item("deepest " + fixed(s.deepest_radii(), 2) + " tool radii", s.is_deep()) +
          "; " +
          quality_item("chatter above 50 Hz " + fixed(s.chatter_N, 3) + " N" +
                           (s.chatter_s > 0 ? " (" + fixed(s.chatter_s, 2) + " s above " +
                                                  fixed(s.chatter_limit_N(), 2) + " N)"
                                            : ""),
                       s.chatters()) +
          "; " +
          quality_item("largest turn of contact " + fixed(s.worst_turn_rad * 57.29577951308232, 1) +
                           "&deg; a tick",
                       s.turns()) +
          (s.has_guide
               ? "; largest step of the guide's force " + fixed(s.guide_step_N, 2) + " N a tick"
               : "") +
          ".");
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>";
}

// "contact uncertain at 0.658 s, emergency stop at 11.430 s (part of the scenario)"
std::string faults_text(const Summary& s) {
  std::string text;
  for (const LatchedFault& fault : s.latched)
    text += (text.empty() ? "" : ", ") + html_of(fault.name) + " at " + fixed(fault.time_s, 3) +
            " s" + (fault.is_scripted ? " (part of the scenario)" : "");
  return text.empty() ? "none" : text;
}

std::string table(const Report& report, const Scene3d& scene3d) {
  const Summary& s = report.summary;
  const Scenario& scenario = report.scenario;
  const auto value = [&](uint32_t parameter, int decimals) {
    return fixed(parameter_value(scenario, parameter), decimals);
  };
  std::string rows;
  if (s.has_surface) rows += row("Part", grouped(scene3d.source_triangles) + " triangles");
  if (s.has_guide)
    rows += row("Guide", grouped(report.environment.guide_m().size()) + " points, " +
                             fixed(report.environment.guide_length_m() * 1e3, 1) + " mm");
  rows += row("Scene", html_of(report.scene));
  for (const ShownObject& object : scene3d.objects)
    rows += row("Object " + html_of(object.name),
                "held the tool for " + grouped(object.ticks) + " ticks, motors on");
  for (const TouchedMaterial& material : scene3d.materials)
    rows += row("Material " + html_of(material.name),
                "held the tool for " + grouped(material.ticks) + " ticks, motors on");
  rows += row("Asset in flash", grouped(report.asset_bytes) + " bytes");
  rows += row("Controller state in RAM",
              grouped(scene3d.objects.empty() ? sizeof(FullController) : sizeof(ToolController)) +
                  " bytes");
  rows += row("Ticks", grouped(s.ticks) + " at " + fixed(s.rate_Hz, 0) + " Hz");
  rows += row("Ticks in contact, motors on", grouped(s.contact_ticks));
  if (s.has_guide) rows += row("Ticks on the guide, motors on", grouped(s.guide_ticks));
  rows += row("Peak force, limit",
              fixed(s.peak_force_N, 2) + " N, " + fixed(s.force_limit_N, 1) + " N");
  rows += row("Deepest penetration, motors on", fixed(s.worst_penetration_m * 1e3, 2) + " mm");
  if (s.has_guide)
    rows += row("Mean deviation on the guide", fixed(s.mean_guide_deviation_m * 1e3, 2) + " mm");
  rows += row("Visits a tick: mean, worst",
              fixed(s.mean_visits, 1) + ", " + std::to_string(s.worst_visits));
  rows += row("Work a tick, at most", std::to_string(s.budget_units) + " units, base hulls apart");
  if (s.worst_instructions > 0) {
    rows += row(
        "Instructions a tick: mean, worst",
        grouped(static_cast<uint64_t>(s.mean_instructions)) + ", " + grouped(s.worst_instructions));
    rows += row("Deepest stack", grouped(s.stack_high_bytes) + " bytes");
  }
  rows += row("Load of the servo", load_text(s));
  rows +=
      row("Contact stiffness, damping", value(params::kContactStiffness, 0) + " N/m, " +
                                            value(params::kContactDamping, 1) + " N&middot;s/m");
  rows += scene3d.spheres.empty()
              ? row("Tool radius", fixed(scene3d.tool_radius_m * 1e3, 2) + " mm")
              : row("Tool", std::to_string(scene3d.spheres.size()) + " spheres; torque at most " +
                                fixed(report.summary.peak_torque_Nm * 1e3, 2) + " mN m");
  rows += row("Device", scenario.linkage ? html_of(scenario.device_file)
                                         : fixed(scenario.device.mass_kg * 1e3, 0) + " g, " +
                                               fixed(scenario.device.encoder_quantum_m * 1e6, 0) +
                                               " &micro;m per count");
  rows += row("Faults latched", faults_text(s));
  return "<table>" + rows + "</table>";
}

// The script draws the charts at the page's width; without it the notes and the picture remain.
std::string plots(const RunCharts& run) {
  std::string html = "<div id=\"plots\">";
  for (const RunChart& chart : run.charts())
    html += "<section class=\"card plot\"><header><h2>" + html_of(chart.title) +
            "</h2></header><p>" + html_of(chart.note) + "</p></section>";
  return html + "</div>";
}

std::string stage_title(const Summary& s) {
  if (!s.has_guide) return "The part and the tool";
  return s.has_surface ? "The part, the guide and the tool" : "The guide and the tool";
}

// Drawn by pages/close_up.js.
constexpr const char* kCloseUp =
    "<div class=\"legend close-up\"><canvas id=\"close_up\" role=\"img\" "
    "aria-label=\"the planes that hold the proxy, and the cone of friction\"></canvas>"
    "<div><h2>Close-up of the contact</h2><output></output>"
    "<span><i style=\"background:#2563eb\"></i>proxy</span>"
    "<span><i style=\"background:#7e8aa0\"></i>hand</span>"
    "<span><i style=\"background:#c62839\"></i>spring between them</span>"
    "<span><i style=\"background:#1f8a5b\"></i>planes that hold the proxy, and their normals</span>"
    "<span><i style=\"background:#e2742b\"></i>cone of friction: the proxy rests while the hand "
    "is in it; dashed: sliding</span></div></div>";

// One time for all charts and the 3D view.
constexpr const char* kTimeBar =
    "<div id=\"time\" hidden><button type=\"button\" id=\"play\" "
    "aria-label=\"play\">&#9654;</button>"
    "<select id=\"speed\" aria-label=\"speed\"><option value=\"0.02\">1/50</option>"
    "<option value=\"0.1\">1/10</option><option value=\"0.5\">1/2</option>"
    "<option value=\"1\" selected>1&times;</option><option value=\"4\">4&times;</option></select>"
    "<input type=\"range\" id=\"slider\" min=\"0\" max=\"10000\" value=\"0\" aria-label=\"time\">"
    "<output id=\"clock\"></output><span class=\"zoom\">"
    "<button type=\"button\" id=\"earlier\" aria-label=\"earlier\">&lsaquo;</button>"
    "<button type=\"button\" id=\"out\" aria-label=\"zoom out\">&minus;</button>"
    "<button type=\"button\" id=\"in\" aria-label=\"zoom in\">+</button>"
    "<button type=\"button\" id=\"later\" aria-label=\"later\">&rsaquo;</button>"
    "<button type=\"button\" id=\"all\">All</button></span></div>";

std::string lede(const Report& report) {
  const Summary& s = report.summary;
  std::string text = "A simulated hand touches <b>" + html_of(file_name(report.asset_path)) +
                     "</b> for " + fixed(s.seconds, 1) +
                     " s. The controller, the same program as "
                     "on a board, computed " +
                     grouped(s.ticks) + " ticks. ";
  return text + "The hand feels <b>contact</b> with the surface" +
         (s.has_guide ? " and the spring of the <b>guide</b> (virtual fixture)." : ".") +
         " All figures below are from this run.";
}

}  // namespace

std::string page_of(const Report& report) {
  const Scene3d scene3d = make_scene3d(report.environment, report.paths,
                                       parameter_value(report.scenario, params::kToolRadius));
  const std::string name = html_of(std::filesystem::path(report.asset_path).stem().string());
  std::string html = page_head(name + " - Firmtouch report");
  html += "<p class=\"brand\"><b>Firmtouch</b> run report</p><h1>Touching " + name +
          "</h1><p class=\"lede\">" + lede(report) + "</p>";
  html += "<ul class=\"claims\">" + certificate_claim(report.summary) +
          visits_claim(report.summary) + bits_claim(report) + contact_claim(report.summary) +
          quality_claim(report.summary) + "</ul>\n";
  html +=
      "<div class=\"top\">" +
      stage_of(scene3d, stage_title(report.summary), report.summary.has_surface ? kCloseUp : "") +
      "<section class=\"card\"><h2>Key figures</h2>" + table(report, scene3d) +
      "</section></div>\n";
  if (report.scenario.linkage) html += condition_card(*report.scenario.linkage, report.paths);
  html += plots(report.charts) + kTimeBar;
  html += "<footer><p>Written by <code>" + html_of(report.command) +
          "</code>. The oracle that checks the distances shares no code with the controller.</p>"
          "<details><summary>The scenario</summary><pre>" +
          html_of(report.scenario.text) + "</pre></details></footer></main>\n";
  html += "<script type=\"application/json\" id=\"run-data\">" + data_of(report, scene3d) +
          "</script>\n<script>\n" + std::string(kReportJs) + "</script></body></html>\n";
  return html;
}

}  // namespace firmtouch::host_sim
