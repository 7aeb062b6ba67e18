#include <cstdio>
#include <iostream>

#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/scenario/plan.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

// In diagonals above the surface: the planned tool just touches it.
constexpr double kOutlineHeight = 0.016;

std::string csv_of(const std::vector<Vec>& line) {
  std::string text = "x,y,z\n";
  for (const Vec& p : line) {
    char row[96];
    std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g\n", p.x, p.y, p.z);
    text += row;
  }
  return text;
}

int make_scenario(const cli::Arguments& options) {
  const std::string path = options.positionals()[0], to = options.text("-o"),
                    outline_path = options.text("--outline");
  if (to.empty() && outline_path.empty()) options.refuse("name -o FILE or --outline FILE.csv");
  check_outputs({{"the asset", path}}, {{"-o", to}, {"--outline", outline_path}});
  const Session session(path);
  if (!session.unused.empty()) std::cerr << path << ": " << session.scene_text() << "\n";
  Environment environment = environment_of(*session.controller, {});
  if (environment.has_surface() && !environment.has_mesh())
    environment.turn(orientation_of(environment.tessellation()).normals_inward);
  if (!outline_path.empty()) {
    const std::vector<Vec> line = outline(environment, kOutlineHeight * diagonal_m(environment));
    if (line.empty())
      throw Refused(path + ": no closed line around the mesh was found; draw a guide of your own");
    write_file(outline_path, csv_of(line));
  }
  if (!to.empty()) write_file(to, plan_scenario(environment, path_from(to, path)));
  return 0;
}

}  // namespace

cli::Command scenario_command() {
  return {"scenario",
          "ASSET -o FILE [--outline FILE.csv]",
          "writes a scenario for an asset: press on the surface, follow the guide, emergency stop",
          "The scenario is scaled by the asset's bounding box. - as FILE is stdout.",
          {{"-o", "FILE", "the scenario"},
           {"--outline", "FILE.csv", "a closed line around the mesh, to be baked as its guide"}},
          1,
          1,
          make_scenario};
}

}  // namespace firmtouch::host_sim
