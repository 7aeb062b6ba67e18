#include <cstdio>
#include <iostream>

#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/scenario/plan.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kOutlineHeight =
    0.016;  // diagonals above the surface: a tool of the plan's radius just touches it

constexpr const char* kHelp =
    "firmtouch-sim scenario ASSET -o FILE [--outline FILE.csv]\n"
    "Writes a scenario that suits an asset, from its bounding box: press on the part, follow its "
    "guide, stop.\n"
    "  --outline FILE.csv   instead: a line around the part, to be baked as its guide\n";

std::string csv_of(const std::vector<Vec>& line) {
  std::string text = "x,y,z\n";
  for (const Vec& p : line) {
    char row[96];
    std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g\n", p.x, p.y, p.z);
    text += row;
  }
  return text;
}

}  // namespace

int make_scenario(const std::vector<std::string>& words) {
  const Options options(words, {"-o", "--outline"});
  if (options.help()) {
    std::cout << kHelp;
    return 0;
  }
  if (options.operands().size() != 1) throw Usage("scenario wants one asset");
  const std::string path = options.operands()[0], to = options.value("-o"),
                    outline_path = options.value("--outline");
  if (to.empty() && outline_path.empty())
    throw Usage("scenario wants -o FILE or --outline FILE.csv");
  check_outputs({{"the asset", path}}, {{"-o", to}, {"--outline", outline_path}});
  const Session session(path);
  World world = world_of(*session.controller, {});
  if (world.has_surface() && !world.has_mesh()) world.turn(sides_of(world.shell()).is_turned);
  if (!outline_path.empty()) {
    const std::vector<Vec> line = outline(world, kOutlineHeight * diagonal_m(world));
    if (line.empty())
      throw Refused(path + ": no closed line around the part was found; give a path of your own");
    write_file(outline_path, csv_of(line));
  }
  if (!to.empty()) write_file(to, plan_scenario(world, path_from(to, path)));
  return 0;
}

}  // namespace firmtouch::host_sim
