#include <algorithm>
#include <cstdio>
#include <iostream>

#include "device/machines.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/prepare.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "host_sim/scenario/plan.hpp"
#include "host_sim/trace/log.hpp"
#include "host_sim/trace/stable_walls.hpp"

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

// The linkage that the asset stores: that of --device, or the machine that it is.
Scenario linkage_of(const cli::Arguments& options, const Session& session, const std::string& to) {
  Scenario scenario;
  scenario.device_file = options.text("--device");
  const core::Bytes stored = session.controller->device().stored_bytes();
  for (const std::string& name : tools::machine_names())
    if (scenario.device_file.empty() &&
        tools::stored_bytes_of(tools::read_device(name, tools::machine_text(name))) ==
            std::vector<uint8_t>(stored.begin(), stored.end()))
      scenario.device_file = name;
  if (scenario.device_file.empty())
    throw Refused(session.asset.path() +
                  ": it stores a linkage; name the file that it was baked with: --device FILE");
  if (tools::machine_text(scenario.device_file).empty())
    scenario.device_file = path_from(to, scenario.device_file);
  read_linkage(scenario, session, to);
  return scenario;
}

int make_scenario(const cli::Arguments& options) {
  const std::string path = options.positionals()[0], to = options.text("-o"),
                    outline_path = options.text("--outline");
  if (to.empty() && outline_path.empty()) options.refuse("name -o FILE or --outline FILE.csv");
  check_outputs({{"the asset", path}, {"--device", options.text("--device")}},
                {{"-o", to}, {"--outline", outline_path}});
  const Session session(path);
  if (!session.unused.empty()) std::cerr << path << ": " << session.scene_text() << "\n";
  const auto environment_at = [&](Vec origin_m) {
    Environment environment = environment_of(*session.controller, origin_m);
    if (environment.has_surface() && !environment.has_mesh())
      environment.turn(orientation_of(environment.tessellation()).normals_inward);
    return environment;
  };
  Environment environment = environment_at({});
  if (!outline_path.empty()) {
    const std::vector<Vec> line = outline(environment, kOutlineHeight * diagonal_m(environment));
    if (line.empty())
      throw Refused(path + ": no closed line around the mesh was found; draw a guide of your own");
    write_file(outline_path, csv_of(line));
  }
  if (to.empty()) return 0;
  Scenario scenario;
  if (session.controller->linkage().is_open() || options.has("--device"))
    scenario = linkage_of(options, session, to);
  PlannedDevice device{scenario.device_file, scenario.linkage ? &*scenario.linkage : nullptr};
  if (device.linkage != nullptr && !device.linkage->are_walls_forced) {
    const StableWalls walls = stable_walls(scenario, environment);
    // Of what is stable together contact gets three quarters.
    device.stable_contact_N_per_m = std::min(walls.contact_N_per_m, 0.75 * walls.both_N_per_m);
    device.stable_guide_N_per_m = std::min(walls.guide_N_per_m, 0.25 * walls.both_N_per_m);
    device.stable_texture_N = walls.texture_N;
  }
  if (device.linkage != nullptr) {
    const JointMotion middle = middle_of(*device.linkage);
    environment = environment_at(points_of(*device.linkage, middle).tip.at_m -
                                 planned_start_m(environment, device));
  }
  write_file(to, plan_scenario(environment, path_from(to, path), device));
  return 0;
}

}  // namespace

cli::Command scenario_command() {
  return {{"scenario", "ASSET -o FILE [options]", 1, 1, make_scenario},
          "writes a scenario for an asset: press on the surface, follow the guide, emergency stop",
          "The scenario is scaled by the asset's bounding box. - as FILE is stdout.",
          {{"-o", "FILE", "the scenario"},
           {"--device", "FILE", "the linkage's file, if it is none of `device --help`'s machines"},
           {"--outline", "FILE.csv", "a closed line around the mesh, to be baked as its guide"}}};
}

}  // namespace firmtouch::host_sim
