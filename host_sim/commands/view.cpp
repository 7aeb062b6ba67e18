#include <filesystem>

#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/report/page_parts.hpp"
#include "host_sim/report/stage.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

std::string text_of(const Session& session, const Environment& environment, const Scene3d& shown) {
  std::string text = html_of(session.scene_text()) + ". ";
  if (environment.has_surface())
    text += grouped(shown.source_triangles) + " triangles" +
            (shown.triangles.size() < shown.source_triangles
                 ? " (" + grouped(shown.triangles.size()) + " shown)"
                 : "") +
            ", diagonal " + fixed(shown.radius_m * 2e3, 1) + " mm. ";
  if (environment.has_guide())
    text += "A guide of " + fixed(environment.guide_length_m() * 1e3, 1) + " mm. ";
  return text + grouped(session.asset.bytes().size()) + " bytes.";
}

// A guide alone: the view is about its points.
void look_at_guide(Scene3d& scene3d, const std::vector<Vec>& guide_m) {
  for (const Vec& p : guide_m)
    scene3d.centre = scene3d.centre + p * (1.0 / static_cast<double>(guide_m.size()));
  scene3d.radius_m = 1e-9;
  for (const Vec& p : guide_m)
    scene3d.radius_m = std::max(scene3d.radius_m, norm(p - scene3d.centre));
}

int view(const cli::Arguments& options) {
  const std::string path = options.positionals()[0], to = options.text("-o");
  if (to.empty()) options.refuse("say where to write: -o FILE.html");
  check_outputs({{"the asset", path}}, {{"-o", to}});
  const Session session(path);
  const Environment environment = environment_of(*session.controller, {});
  Scene3d scene3d =
      surface_scene(environment, static_cast<double>(params::kTable[params::kToolRadius].initial));
  if (!environment.has_surface()) look_at_guide(scene3d, environment.guide_m());
  const std::string name = html_of(std::filesystem::path(path).stem().string());
  write_file(to, page_head(name + " - Firmtouch asset") +
                     "<p class=\"brand\"><b>Firmtouch</b> asset</p><h1>" + name +
                     "</h1><p class=\"lede\">" + text_of(session, environment, scene3d) + "</p>" +
                     stage_of(scene3d, "What the controller touches") +
                     "</main>\n<script type=\"application/json\" id=\"scene-data\">{" +
                     scene_data_of(scene3d, environment) + "}</script>\n<script>\n" + kViewJs +
                     "</script></body></html>\n");
  return 0;
}

}  // namespace

cli::Command view_command() {
  return {{"view", "ASSET -o FILE.html", 1, 1, view},
          "writes a page that shows an asset in 3D, without a run",
          "",
          {{"-o", "FILE.html", "the page; - is stdout"}}};
}

}  // namespace firmtouch::host_sim
