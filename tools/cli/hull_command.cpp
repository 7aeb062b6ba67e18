#include <cstdio>

#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/hull_arguments.hpp"
#include "hull/build_hull.hpp"
#include "json/json.hpp"
#include "surface/crossings.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::cli {
namespace {

std::string sentence(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

// Where the surface crosses itself it may wind around a point less than once, and such points are
// not promised to stay inside.
std::vector<std::string> crossings_of(const SoundSurface& sound) {
  const tools::Crossings crossings = tools::find_crossings(sound.surface);
  return tools::describe(crossings, sound.surface, sound.vertex_source);
}

// What was made: as lines, or for programs.
struct Made {
  size_t triangles, of_triangles;
  double void_share, grid_m;
  size_t collapses, programs;

  std::vector<std::string> lines() const {
    return {std::to_string(triangles) + " faces enclose " + std::to_string(of_triangles) +
                ": void " +
                sentence("%.3g %% of the volume, grid of %.3g m", 100 * void_share, grid_m),
            std::to_string(collapses) + " collapses, " + std::to_string(programs) +
                " linear programs; every new vertex proven outside in exact arithmetic"};
  }
  std::string json(const std::string& file, const std::vector<std::string>& reported) const {
    return tools::Json()
        .add("file", tools::json_text(file))
        .add("triangles", uint64_t{triangles})
        .add("of_triangles", uint64_t{of_triangles})
        .add("void_share", void_share)
        .add("grid_m", grid_m)
        .add("collapses", uint64_t{collapses})
        .add("programs", uint64_t{programs})
        .add("reported", tools::json_list(reported, tools::json_text))
        .object();
  }
};

}  // namespace

tools::HullOptions hull_options(const Arguments& arguments) {
  tools::HullOptions options;
  options.limits.max_valence = arguments.count("--max-valence", 12, 3, 64);
  options.limits.compactness = arguments.number("--compactness", 0.8, 0);
  options.limits.max_deviation_deg = arguments.number("--max-deviation-deg", 45, 0);
  if (options.limits.compactness > 1)
    fail_usage("--compactness: the share of it that a collapse must leave is at most 1");
  if (options.limits.max_deviation_deg > 90)
    fail_usage("--max-deviation-deg: is at most 90, beyond which faces fold over");
  options.grid_bits = arguments.choice("--hull-grid", "22", {"22", "16"}) == "22" ? 22 : 16;
  return options;
}

const Command& hull_command() {
  static const Command command{
      "hull",
      "MODEL --faces N -o FILE.obj [options]",
      "Makes a coarse surface that encloses a model, proven on the vertices that are written.",
      "The model is checked and mended as for bake, and must be closed. Each piece coarsens by "
      "itself.\n"
      "Where no edge may collapse any more, the coarsest hull reached is written and the reason "
      "printed.",
      with_model_options(
          {{"-o", "FILE", "the hull (.obj); -: to stdout"},
           {"--faces", "N", "at most so many, even (4 and more)"},
           {"--strategy", "1|2|lazy",
            "1: least volume first; 2: least volume about the middle of the "
            "star; lazy (default): 1, looking again only at an edge's turn"},
           {"--hull-grid", "22|16", "bits of a stored coordinate (default 22)"},
           {"--max-valence", "N", "faces around a vertex (default 12)"},
           {"--compactness", "R", "share of the faces' compactness that is left (default 0.8)"},
           {"--max-deviation-deg", "A", "of a face's normal in one collapse (default 45)"},
           {"--json", nullptr, "what was made, for programs, on stdout"}}),
      1,
      1};
  return command;
}

int run_hull(const Arguments& arguments) {
  const std::string& path = arguments.positionals()[0];
  const std::string output = arguments.text("-o", ""), name = stem_of(path);
  if (output.empty()) fail_usage("hull: say where to write: -o FILE.obj");
  if (output == "-" && arguments.has("--json"))
    fail_usage("hull: -o - takes standard output: leave out --json, or name a file");
  if (output != "-" && extension_of(output) != ".obj")
    fail_usage("hull: writes .obj, and '" + output + "' does not end in it");
  if (!arguments.has("--faces")) fail_usage("hull: say how coarse: --faces N");
  forbid_overwriting(output, path);
  tools::HullOptions options = hull_options(arguments);
  options.target_faces = arguments.count("--faces", 2000, 4, UINT32_MAX);
  const std::string strategy = arguments.choice("--strategy", "lazy", {"1", "2", "lazy"});
  options.strategy = strategy == "1"   ? tools::HullStrategy::kVolume
                     : strategy == "2" ? tools::HullStrategy::kCentre
                                       : tools::HullStrategy::kLazyVolume;
  std::string text_of_options;
  ModelOptions options_of_model = model_options(arguments, text_of_options);
  settle_size(path, options_of_model);
  SoundSurface sound;
  tools::HullReport report;
  tools::ProgressiveHull hull;
  {
    Progress progress(0);
    progress.stage("reading and checking " + file_name_of(path));
    sound = sound_surface(path, read_model(path), options_of_model);
    progress.stage("collapsing edges of " + name);
    options.on_progress = [&](uint32_t faces) {
      progress.stage(std::to_string(faces) + " faces left, of " +
                     std::to_string(sound.surface.faces.size()));
    };
    hull = tools::build_hull(sound.surface, options, report);
    progress.stage("looking where " + name + " crosses itself");
  }
  const tools::Surface level = tools::hull_level(hull, options.target_faces);
  const std::string text = tools::to_obj(level);
  write_file(output, text.data(), text.size());
  std::vector<std::string> reported = sound.reported;
  for (const std::string& line : crossings_of(sound)) reported.push_back(line);
  if (sound.surface.faces.size() <= options.target_faces) {
    reported.push_back("has " + std::to_string(sound.surface.faces.size()) +
                       " faces, not more than the " + std::to_string(options.target_faces) +
                       " requested: written as it is");
  }
  if (!report.stalled.empty()) reported.push_back(report.stalled);
  const double before = tools::enclosed_volume_m3(sound.surface);
  const Made made{level.faces.size(),
                  sound.surface.faces.size(),
                  (tools::enclosed_volume_m3(level) - before) / before,
                  hull.grid.cell_m,
                  hull.collapses.size(),
                  report.counts.programs};
  for (const auto& lines : {reported, made.lines()})
    for (const std::string& line : lines)
      std::fprintf(stderr, "%s: %s\n", name.c_str(), line.c_str());
  if (arguments.has("--json")) std::puts(made.json(output, reported).c_str());
  return kDone;
}

}  // namespace firmtouch::cli
