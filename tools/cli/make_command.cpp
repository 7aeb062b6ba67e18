#include <algorithm>

#include "bake/mesh/bake_mesh.hpp"
#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "curve/make_hand_walk.hpp"
#include "curve/read_curve_csv.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "spline/make_walk_about.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"
#include "spline/write_iges.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "surface/make/make_walk.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kWalkPoints = 20000;
constexpr uint32_t kPathPoints = 2000;
constexpr uint32_t kPartTriangles = 20000;
constexpr uint32_t kMaxPoints = 100000000;
constexpr uint32_t kControlPoints = 15, kMaxControlPoints = 1000;  // of a spline, in one direction
constexpr double kRise = 0.15;                                     // of a surface's hills

// Of what is made: the format it is written in (a name that says another would lie), and its own
// options.
struct Kind {
  const char* name;
  const char* extension;
  std::string (*make)(const Arguments& arguments, uint64_t seed);
  std::vector<std::string> options;
};

void demand_extension(const Kind& kind, const std::string& output) {
  const std::string wanted = kind.extension, name = kind.name;
  if (output == "-" || extension_of(output) == wanted ||
      (wanted == ".igs" && extension_of(output) == ".iges"))
    return;
  fail_usage("make: " + name + " writes " + wanted + ", and '" + output +
             "' does not end in it; name a file that does: -o " + stem_of(output) + wanted);
}

std::string made_part(const Arguments& arguments, uint64_t seed) {
  const uint32_t triangles = arguments.count("--triangles", kPartTriangles, 2000, 4000000);
  return tools::to_obj(tools::make_part(seed, triangles));
}

std::string made_cad(const Arguments&, uint64_t seed) {
  return tools::to_obj(tools::make_cad(seed));
}

std::string made_path(const Arguments& arguments, uint64_t seed) {
  return tools::to_csv(
      tools::make_path(seed, arguments.count("--points", kPathPoints, 16, kMaxPoints)));
}

std::string made_curve(const Arguments& arguments, uint64_t seed) {
  tools::SplineModel model;
  model.curves.push_back(tools::winding_curve(
      seed, arguments.count("--control-points", kControlPoints, 4, kMaxControlPoints),
      !arguments.has("--space"), arguments.has("--weights")));
  model.curves[0].is_planar = !arguments.has("--space");
  return tools::to_iges(model);
}

std::string made_surface(const Arguments& arguments, uint64_t seed) {
  tools::SplineModel model;
  model.surfaces.push_back(
      tools::hilly_surface(seed, arguments.count("--control-points", 8, 4, kMaxControlPoints),
                           kRise, arguments.has("--weights")));
  return tools::to_iges(model);
}

std::string walk_about_spline(const std::string& path, uint64_t seed, uint32_t points) {
  const tools::SplineModel model = tools::read_spline_file(path, 0);
  if (!model.problem.empty()) fail_input(model.problem);
  return tools::to_csv(tools::make_walk_about(model, seed, points));
}

// A walk touches any surface, also one without inside and outside.
std::string made_walk(const Arguments& arguments, uint64_t seed) {
  const std::string& model = arguments.positionals()[1];
  forbid_overwriting(arguments.text("-o", ""), model);
  const uint32_t points = arguments.count("--points", kWalkPoints, 1, kMaxPoints);
  if (extension_of(model) == ".csv") {
    const tools::CurvePoints curve = tools::read_curve_csv(model, 1.0);
    if (!curve.problem.empty()) fail_input(curve.problem);
    return tools::to_csv(tools::make_hand_walk(curve.samples_m, seed, points));
  }
  const std::string extension = extension_of(model);
  if (extension == ".igs" || extension == ".iges" || extension == ".bpt")
    return walk_about_spline(model, seed, points);
  ModelOptions options;
  options.is_signed = false;
  const tools::Surface surface = sound_surface(model, read_model(model), options).surface;
  tools::MeshOptions mesh_options;
  mesh_options.is_signed = false;
  tools::MeshReport report;
  const std::vector<tools::Section> sections =
      tools::bake_mesh(surface, "walk", mesh_options, report);
  if (!report.problem.empty()) fail_input(model + ": " + report.problem);
  mesh::View view;
  const core::Verdict verdict = tools::open_baked(sections, "walk", view);
  if (!verdict.ok()) fail_input(model + ": its mesh breaks rule R" + std::to_string(verdict.rule));
  mesh::Hint hint;
  return tools::to_csv(tools::make_walk(surface, seed, points, [&](math::Vec3 p_m) {
    return mesh::closest_point(view, p_m, query::kUnlimited, hint).point_m;
  }));
}

const Kind kKinds[] = {
    {"part", ".obj", made_part, {"--triangles"}},
    {"cad", ".obj", made_cad, {}},
    {"path", ".csv", made_path, {"--points"}},
    {"walk", ".csv", made_walk, {"--points"}},
    {"curve", ".igs", made_curve, {"--control-points", "--space", "--weights"}},
    {"surface", ".igs", made_surface, {"--control-points", "--weights"}},
};

const Kind& kind_of(const std::string& name) {
  for (const Kind& kind : kKinds)
    if (name == kind.name) return kind;
  fail_usage("make: '" + name + "' cannot be made; make part, cad, path, walk, curve or surface");
}

void forbid_options_of_others(const Arguments& arguments, const Kind& kind) {
  for (const Kind& other : kKinds)
    for (const std::string& option : other.options)
      if (arguments.has(option) &&
          std::find(kind.options.begin(), kind.options.end(), option) == kind.options.end())
        fail_usage("make: " + option + " has no meaning for " + kind.name + "; leave it out");
}

}  // namespace

Command make_command() {
  return {{"make", "part|cad|path|curve|surface|walk MODEL -o FILE [options]", 1, 2, run_make},
          "Makes the demo's part and guide path, machined parts, splines, and paths to query a "
          "model along; the same on every machine.",
          R"(part     a closed mesh (.obj)
cad      a machined part as CAD exports it, of five kinds by seed: plate with holes, turned part,
         gear, bent sheet, extrusion; millimetres with few decimals (.obj)
path     the guide that runs in the groove of the part of the same seed (.csv)
curve    a cubic spline curve that winds about in a plane (.igs)
surface  a bicubic spline surface of hills (.igs)
walk     of a mesh: a random walk that stays within 2 % of the diagonal of its surface, 0.0005
         diagonals a step (.csv): what a touching hand queries; of a path (.csv): a hand led along
         it once, up to 1 % of its diagonal aside; of splines (.igs, .iges, .bpt): all through
         their box and a fifth of its extent beyond, 0.002 extents a step)",
          {{"-o", "FILE", "the file to write; -: to stdout"},
           {"--seed", "N", "which of them (default 1)"},
           {"--points", "N", "path, walk: how many (default 2000, 20000)"},
           {"--triangles", "N", "part: at least so many (default 20000)"},
           {"--control-points", "N", "curve, surface: how many, each way (default 15, 8)"},
           {"--space", nullptr, "curve: not in a plane"},
           {"--weights", nullptr, "curve, surface: a NURBS whose weights differ"}}};
}

int run_make(const Arguments& arguments) {
  const Kind& kind = kind_of(arguments.positionals()[0]);
  const std::string output = arguments.text("-o", "");
  const size_t words = std::string("walk") == kind.name ? 2 : 1;
  if (arguments.positionals().size() < words)
    fail_usage("make: walk needs a model: make walk MODEL -o FILE");
  if (arguments.positionals().size() > words) {
    fail_usage("make: one word too many: '" + arguments.positionals()[words] + "'");
  }
  if (output.empty()) fail_usage("make: say where to write: -o FILE");
  forbid_options_of_others(arguments, kind);
  demand_extension(kind, output);
  const std::string text = kind.make(arguments, arguments.count("--seed", 1, 0, UINT32_MAX));
  write_file(output, text.data(), text.size());
  return kDone;
}

}  // namespace firmtouch::cli
