#include <algorithm>
#include <charconv>
#include <cstdio>

#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/hull_arguments.hpp"
#include "hull/build_hull.hpp"
#include "json/json.hpp"
#include "surface/crossings.hpp"
#include "surface/read/load_file.hpp"
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

// A level that was written.
struct Made {
  std::string file;
  size_t triangles;
  double void_share;
};

std::vector<std::string> lines_of(const std::vector<Made>& levels,
                                  const tools::ProgressiveHull& hull, size_t of_triangles,
                                  size_t programs) {
  std::vector<std::string> lines;
  for (const Made& made : levels)
    lines.push_back(
        std::to_string(made.triangles) + " faces enclose " + std::to_string(of_triangles) +
        ": void " +
        sentence("%.3g %% of the volume, grid of %.3g m", 100 * made.void_share, hull.grid.cell_m));
  lines.push_back(std::to_string(hull.collapses.size()) + " collapses, " +
                  std::to_string(programs) +
                  " linear programs; every new vertex proven outside in exact arithmetic");
  return lines;
}

std::string json_of(const std::vector<Made>& levels, const tools::ProgressiveHull& hull,
                    size_t of_triangles, size_t programs,
                    const std::vector<std::string>& reported) {
  const auto level = [&](const Made& made) {
    return tools::Json()
        .add("file", tools::json_text(made.file))
        .add("triangles", uint64_t{made.triangles})
        .add("of_triangles", uint64_t{of_triangles})
        .add("void_share", made.void_share);
  };
  tools::Json json = level(levels.back());
  if (levels.size() > 1)
    json.add("levels", tools::json_list(levels, [&](const Made& m) { return level(m).object(); }));
  return json.add("grid_m", hull.grid.cell_m)
      .add("collapses", uint64_t{hull.collapses.size()})
      .add("programs", uint64_t{programs})
      .add("reported", tools::json_list(reported, tools::json_text))
      .object();
}

// "2000,500": from the finest on.
std::vector<uint32_t> faces_of(const Arguments& arguments) {
  if (!arguments.has("--faces")) fail_usage("hull: say how coarse: --faces N");
  const std::string text = arguments.text("--faces", "");
  std::vector<uint32_t> faces;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    uint32_t count = 0;
    const auto read = std::from_chars(text.data() + at, text.data() + end, count);
    if (read.ec != std::errc() || read.ptr != text.data() + end || count < 4 ||
        (!faces.empty() && count >= faces.back()))
      fail_usage("hull: --faces " + text +
                 ": a whole number from 4, or several, falling: 2000,500");
    faces.push_back(count);
    at = end + 1;
  }
  return faces;
}

std::string form_of(const std::string& output) {
  return output == "-" ? "obj" : tools::model_extension(output);
}

// Of each level: hull.obj, or hull_2000.obj and hull_500.obj.
std::vector<std::string> files_of(const Arguments& arguments, const std::vector<uint32_t>& faces) {
  const std::string output = arguments.text("-o", "");
  if (output.empty()) fail_usage("hull: say where to write: -o FILE.obj");
  if (output == "-" && (arguments.has("--json") || faces.size() > 1))
    fail_usage("hull: -o - takes standard output for one level: leave out --json, or name a file");
  if (tools::to_model({}, form_of(output)).empty())
    fail_usage("hull: -o " + output + ": name it .obj, .off, .ply or .stl");
  if (faces.size() == 1) return {output};
  const std::string end = extension_of(output);
  std::vector<std::string> files;
  for (const uint32_t count : faces)
    files.push_back(output.substr(0, output.size() - end.size()) + "_" + std::to_string(count) +
                    end);
  return files;
}

}  // namespace

std::vector<Option> with_hull_options(std::vector<Option> own) {
  static const std::vector<Option> kShared = {
      {"--hull-grid", "22|16", "bits of a hull's coordinate (default 22)"},
      {"--max-valence", "N", "faces around a hull's vertex, in an asset at most 31 (default 12)"},
      {"--compactness", "R",
       "share of the faces' compactness that a collapse leaves (default 0.8)"},
      {"--max-deviation-deg", "A", "of a face's normal in one collapse (default 45)"}};
  own.insert(own.end(), kShared.begin(), kShared.end());
  return own;
}

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

Command hull_command() {
  return {{"hull", "MODEL --faces N[,N...] -o FILE [options]", 1, 1, run_hull},
          "Makes a coarse surface that encloses a model, proven on the vertices that are written.",
          R"(The model is checked and mended as for bake, and must be closed. Each piece coarsens by
itself. Where no edge may collapse any more, the coarsest hull reached is written and
the reason printed.)",
          with_model_options(with_hull_options(
              {{"-o", "FILE", "the hull (.obj .stl .off .ply); -: an .obj to stdout"},
               {"--faces", "N[,N...]",
                "at most so many, even (4 and more); several, falling: FILE_N.obj each, one inside "
                "the next"},
               {"--strategy", "1|2|lazy",
                "1: least volume first; 2: least volume about the middle of the "
                "star; lazy (default): 1, looking again only at an edge's turn"},
               {"--json", nullptr, "what was made, for programs, on stdout"}}))};
}

int run_hull(const Arguments& arguments) {
  const std::string& path = arguments.positionals()[0];
  const std::string name = stem_of(path);
  const std::vector<uint32_t> faces = faces_of(arguments);
  const std::vector<std::string> files = files_of(arguments, faces);
  for (const std::string& file : files) check_output(file), forbid_overwriting(file, path);
  tools::HullOptions options = hull_options(arguments);
  options.target_faces = faces.back();
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
    options.on_progress = [&](uint32_t left) {
      progress.stage(std::to_string(left) + " faces left, of " +
                     std::to_string(sound.surface.faces.size()));
    };
    hull = tools::build_hull(sound.surface, options, report);
    progress.stage("looking where " + name + " crosses itself");
  }
  const double before = tools::enclosed_volume_m3(sound.surface);
  std::vector<Made> levels;
  for (size_t i = 0; i < faces.size(); ++i) {
    const tools::Surface level = tools::hull_level(hull, faces[i]);
    const std::string text = tools::to_model(level, form_of(files[i]));
    write_file(files[i], text.data(), text.size());
    levels.push_back(
        {files[i], level.faces.size(), (tools::enclosed_volume_m3(level) - before) / before});
  }
  std::vector<std::string> reported = sound.reported;
  for (const std::string& line : crossings_of(sound)) reported.push_back(line);
  if (sound.surface.faces.size() <= options.target_faces) {
    reported.push_back("has " + std::to_string(sound.surface.faces.size()) +
                       " faces, not more than the " + std::to_string(options.target_faces) +
                       " requested: written as it is");
  }
  if (!report.stalled.empty()) reported.push_back(report.stalled);
  const size_t of = sound.surface.faces.size(), programs = report.counts.programs;
  for (const auto& lines : {reported, lines_of(levels, hull, of, programs)})
    for (const std::string& line : lines)
      std::fprintf(stderr, "%s: %s\n", name.c_str(), line.c_str());
  if (arguments.has("--json")) std::puts(json_of(levels, hull, of, programs, reported).c_str());
  return kDone;
}

}  // namespace firmtouch::cli
