#include <cstdio>

#include "bake/bake_mesh.hpp"
#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "curve/make_hand_walk.hpp"
#include "curve/read_curve_csv.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/make_part.hpp"
#include "surface/make_walk.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kWalkPoints = 20000;
constexpr uint32_t kPathPoints = 2000;
constexpr uint32_t kPartTriangles = 20000;
constexpr uint32_t kMostPoints = 100000000;

void write_text(const std::string& path, const std::string& text) {
  write_file(path, text.data(), text.size());
}

void forbid(const Arguments& arguments, const std::string& kind, const std::string& option) {
  if (arguments.has(option))
    fail_usage("make: " + option + " has no meaning for " + kind + "; leave it out");
}

// What is written is one format a kind: a name that says another would lie.
void demand_extension(const std::string& kind, const std::string& output) {
  const std::string wanted = kind == "part" ? ".obj" : ".csv";
  if (extension_of(output) == wanted) return;
  fail_usage("make: " + kind + " writes " + wanted + ", and '" + output +
             "' does not end in it; name a file that does: -o " + stem_of(output) + wanted);
}

std::string made_part(const Arguments& arguments, uint64_t seed) {
  forbid(arguments, "part", "--points");
  const uint32_t triangles = arguments.count("--triangles", kPartTriangles, 2000, 4000000);
  return tools::to_obj(tools::make_part(seed, triangles));
}

std::string made_path(const Arguments& arguments, uint64_t seed) {
  forbid(arguments, "path", "--triangles");
  return tools::to_csv(
      tools::make_path(seed, arguments.count("--points", kPathPoints, 16, kMostPoints)));
}

// A walk touches any surface, also one without inside and outside.
std::string made_walk(const Arguments& arguments, uint64_t seed) {
  forbid(arguments, "walk", "--triangles");
  const std::string& model = arguments.positionals()[1];
  forbid_overwriting(arguments.text("-o", ""), model);
  const uint32_t points = arguments.count("--points", kWalkPoints, 1, kMostPoints);
  if (extension_of(model) == ".csv") {
    const tools::CurvePoints curve = tools::read_curve_csv(model, 1.0);
    if (!curve.problem.empty()) fail_input(curve.problem);
    return tools::to_csv(tools::make_hand_walk(curve.samples_m, seed, points));
  }
  BakeOptions options;
  options.is_signed = false;
  const tools::Surface surface = sound_surface(model, read_model(model), options).surface;
  tools::MeshOptions mesh_options;
  mesh_options.is_signed = false;
  tools::MeshReport report;
  const std::vector<tools::Section> sections =
      tools::bake_mesh(surface, "walk", mesh_options, report);
  if (!report.problem.empty()) fail_input(model + ": " + report.problem);
  mesh::View view;
  const core::Verdict verdict = mesh::open(tools::mesh_sections(sections, "walk"), view);
  if (!verdict.ok()) fail_input(model + ": its mesh breaks rule R" + std::to_string(verdict.rule));
  query::Hint hint;
  return tools::to_csv(tools::make_walk(surface, seed, points, [&](math::Vec3 p_m) {
    return mesh::closest_point(view, p_m, query::kUnlimited, hint).point_m;
  }));
}

}  // namespace

const Command& make_command() {
  static const Command command{
      "make",
      "part|path|walk MODEL -o FILE [options]",
      "Makes the demo's part and guide path, and touching paths; the same on every machine.",
      "part  a closed mesh (.obj)\n"
      "path  the guide that runs in the groove of the part of the same seed (.csv)\n"
      "walk  a random walk that stays within 2 % of the diagonal of MODEL's surface, 0.0005 "
      "diagonals a\n"
      "      step (.csv): what a touching hand asks; of a curve (.csv): a hand led along it once, "
      "up to\n"
      "      1 % of its diagonal aside",
      {{"-o", "FILE", "the file to write"},
       {"--seed", "N", "which of them (default 1)"},
       {"--points", "N", "path, walk: how many (default 2000, 20000)"},
       {"--triangles", "N", "part: at least so many (default 20000)"}},
      1,
      2};
  return command;
}

int run_make(const Arguments& arguments) {
  const std::string& kind = arguments.positionals()[0];
  const std::string output = arguments.text("-o", "");
  if (kind != "part" && kind != "path" && kind != "walk") {
    fail_usage("make: '" + kind + "' cannot be made; make part, path or walk");
  }
  const size_t words = kind == "walk" ? 2 : 1;
  if (arguments.positionals().size() < words)
    fail_usage("make: walk needs a model: make walk MODEL -o FILE");
  if (arguments.positionals().size() > words) {
    fail_usage("make: one word too many: '" + arguments.positionals()[words] + "'");
  }
  if (output.empty()) fail_usage("make: say where to write: -o FILE");
  demand_extension(kind, output);
  const uint64_t seed = arguments.count("--seed", 1, 0, UINT32_MAX);
  if (kind == "part") {
    write_text(output, made_part(arguments, seed));
  } else if (kind == "path") {
    write_text(output, made_path(arguments, seed));
  } else {
    write_text(output, made_walk(arguments, seed));
  }
  return kDone;
}

}  // namespace firmtouch::cli
