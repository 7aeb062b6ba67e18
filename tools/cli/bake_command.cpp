#include <cstdio>
#include <map>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/asset_writer.hpp"
#include "bake/asset/part_names.hpp"
#include "bake/asset/provenance.hpp"
#include "cli/asset_json.hpp"
#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/cpp_source.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/hull_arguments.hpp"
#include "cli/version.hpp"
#include "device/device_file.hpp"
#include "device/machines.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"

namespace firmtouch::cli {
namespace {

constexpr double kUsualDeviation_m = 1e-4;

bool is_run(const std::string& path) { return extension_of(path) == ".ftl"; }

std::string name_of(const std::string& path, const BakeOptions& options) {
  return is_run(path) ? options.teach : stem_of(path);
}

// A run has no name of its own, and whoever names one must give it.
void check_runs(const std::vector<std::string>& inputs, const BakeOptions& options) {
  size_t runs = 0;
  for (const std::string& path : inputs) {
    if (!is_run(path)) continue;
    ++runs;
    if (options.teach.empty())
      fail_usage("bake: " + path +
                 " is a recorded run; say what its guide is called: --teach NAME");
  }
  if (runs > 1)
    fail_usage("bake: --teach names one guide and " + std::to_string(runs) +
               " runs are given; give one");
  if (runs == 0 && !options.teach.empty())
    fail_usage("bake: --teach wants a recorded run, RUN.ftl, among the inputs");
}

// An asset is named after its file's stem, so two inputs of one stem would be one asset.
void check_names(const std::vector<std::string>& inputs, const BakeOptions& options) {
  std::map<std::string, std::string> seen;
  for (const std::string& path : inputs) {
    const std::string name = name_of(path, options);
    const std::string problem = tools::name_problem(name);
    if (!problem.empty() && is_run(path)) fail_usage("bake: --teach " + name + ": " + problem);
    if (!problem.empty()) fail_input(path + ": " + problem);
    const auto added = seen.emplace(name, path);
    if (!added.second) {
      fail_input(path + ": names its asset '" + name + "', as " + added.first->second +
                 " does; rename one of the files");
    }
  }
}

void print_report(const std::string& name, const std::vector<std::string>& lines) {
  for (size_t i = 0; i < lines.size(); ++i) {
    std::fprintf(stderr, "%s%s\n", i == 0 ? (name + ": ").c_str() : "    ", lines[i].c_str());
  }
}

std::vector<BakedInput> bake_all(const std::vector<std::string>& inputs,
                                 const BakeOptions& options) {
  Progress progress(inputs.size() * kStagesAnInput);
  std::vector<BakedInput> baked;
  for (const std::string& path : inputs) {
    baked.push_back(is_curve_file(path)    ? bake_curve_input(path, options, progress)
                    : is_run(path)         ? bake_run_input(path, options, progress)
                    : is_spline_file(path) ? bake_spline_input(path, options, progress)
                                           : bake_mesh_input(path, options, progress));
  }
  return baked;
}

// The options of a hull, which mean nothing without one.
void add_hull(const Arguments& arguments, BakeOptions& options) {
  static const char* const kOfHulls[] = {"--hull-grid", "--max-valence", "--compactness",
                                         "--max-deviation-deg", "--no-tree"};
  options.hull_faces = arguments.count("--hull-faces", 0, 4, 4'000'000);
  options.hull = hull_options(arguments);
  options.hull.target_faces = options.hull_faces;
  options.has_tree = !arguments.has("--no-tree");
  if (options.hull_faces != 0)
    options.text += " --hull-faces " + std::to_string(options.hull_faces);
  for (const std::string option : kOfHulls) {
    if (!arguments.has(option)) continue;
    if (options.hull_faces == 0)
      fail_usage("bake: " + option + " is of a hull: add --hull-faces N");
    options.text += " " + option;
    if (option != "--no-tree") options.text += " " + arguments.text(option, "");
  }
  if (options.hull_faces != 0 && !options.model.is_signed)
    fail_usage("bake: a hull needs an inside: leave out --unsigned or --hull-faces");
  if (options.hull.limits.max_valence > hull::kMaxLink)
    fail_usage("bake: --max-valence: a hull in an asset has at most " +
               std::to_string(hull::kMaxLink));
  if (!options.has_tree && options.field_cells != 0)
    fail_usage("bake: --distance-map needs the tree: leave out --no-tree");
}

// The linkage of --device, as an asset named after its file's stem.
BakedInput bake_device(const std::string& path) {
  BakedInput baked;
  try {
    const std::string text = tools::read_device_text(path);
    const std::vector<uint8_t> source(text.begin(), text.end());
    const tools::LinkageDevice device = tools::read_device(path, text);
    const device::LinkageLayout layout = tools::layout_of(device);
    const std::string name = stem_of(path);
    baked.sections = {
        tools::make_section(device::kLinkageSection, name, &layout, 1),
        tools::text_section(asset::kProvenanceSection, name,
                            tools::provenance(file_name_of(path), source, "", kToolVersion))};
    baked.report = {"linkage of " + std::to_string(layout.joints) + " joints, " +
                    std::to_string(bytes_of(baked.sections)) + " bytes"};
  } catch (const tools::Refused& refused) {
    fail_input(refused.what());
  }
  return baked;
}

// Both files or none.
void write_source(const std::string& path, const std::vector<uint8_t>& asset,
                  const std::string& output) {
  const std::string text = cpp_source(asset, symbol_of(file_name_of(output)));
  try {
    write_file(path, text.data(), text.size());
  } catch (const Failure&) {
    std::remove(output.c_str());
    throw;
  }
}

}  // namespace

BakeOptions bake_options(const Arguments& arguments) {
  static const std::map<std::string, Purpose> kPurposes = {{"--fast", Purpose::kFast},
                                                           {"--bounded", Purpose::kBounded},
                                                           {"--small", Purpose::kSmall},
                                                           {"--desktop", Purpose::kDesktop}};
  BakeOptions options;
  options.model = model_options(arguments, options.text);
  std::string purpose;
  for (const auto& [option, meant] : kPurposes) {
    if (!arguments.has(option)) continue;
    if (!purpose.empty())
      fail_usage("bake: --fast, --bounded, --small and --desktop contradict each other; give one");
    purpose = option;
    options.purpose = meant;
  }
  if (options.purpose != Purpose::kFast) options.text += " " + purpose;
  options.field_cells = arguments.count("--distance-map", 0, 1, field::kMaxCellsAnAxis - 2);
  if (options.field_cells != 0)
    options.text += " --distance-map " + std::to_string(options.field_cells);
  options.smooth = arguments.has("--smooth");
  if (options.smooth) options.text += " --smooth";
  options.keeps_triangles = arguments.has("--keep-triangles");
  if (options.keeps_triangles) options.text += " --keep-triangles";
  options.curve_tree = arguments.has("--curve-tree");
  if (options.curve_tree) options.text += " --curve-tree";
  options.teach = arguments.text("--teach", "");
  options.max_deviation_m = arguments.number("--max-deviation", kUsualDeviation_m, 1e-9);
  if (arguments.has("--max-deviation") && options.teach.empty())
    fail_usage("bake: --max-deviation is of a taught guide; give --teach NAME too");
  if (!options.teach.empty())
    options.text += " --teach " + options.teach + " --max-deviation " +
                    tools::number_text(options.max_deviation_m);
  return options;
}

const Command& bake_command() {
  static const Command command{
      "bake",
      "INPUT... -o SCENE.fta [options]",
      "Bakes meshes, curves and splines into one asset, proven with the firmware's own decoder.",
      "INPUT by extension: .obj .off .ply .stl .gltf .glb .3mf a mesh; .csv a curve (header "
      "x,y,z); "
      ".ftl\n"
      "a recorded run, which teaches a guide; .igs .iges NURBS curves or surfaces (126, 128); .bpt "
      "Bezier\n"
      "patches. Each is named after its file's stem. What can be mended safely is mended and\n"
      "reported; the rest is refused.",
      with_model_options(
          {{"-o", "FILE", "the asset to write; -: to stdout"},
           {"--unsigned", nullptr, "meshes without inside and outside: distance only; may be open"},
           {"--fast", nullptr,
            "meshes: the fastest on a controller rather than the smallest (the default)"},
           {"--bounded", nullptr,
            "meshes: the worst query near the surface takes a controller a fifth less, for nearly "
            "three "
            "times the flash"},
           {"--small", nullptr,
            "meshes: a third less flash, a third more work a query; splines: half the flash"},
           {"--desktop", nullptr,
            "meshes: the fastest on a desktop with AVX2; half as much work again on a controller"},
           {"--distance-map", "CELLS",
            "meshes get a grid of certified bounds, CELLS along the long axis"},
           {"--cpp", "FILE", "the asset as a C++ source, too"},
           {"--hull-faces", "N",
            "meshes get a progressive hull, at its coarsest of at most N faces: enclosing, proven"},
           {"--hull-grid", "22|16", "bits of a hull's coordinate (default 22)"},
           {"--max-valence", "N", "faces around a hull's vertex, at most 31 (default 12)"},
           {"--compactness", "R",
            "share of the faces' compactness that a collapse leaves (default 0.8)"},
           {"--max-deviation-deg", "A", "of a face's normal in one collapse (default 45)"},
           {"--no-tree", nullptr,
            "with --hull-faces: nothing for distances, only hull queries and a third of the bytes"},
           {"--keep-triangles", nullptr,
            "meshes: as in the file; else long triangles of flat faces are cut anew, for queries"},
           {"--decimal-comma", nullptr,
            "curves: numbers as 1,5; then semicolons or tabs separate them"},
           {"--smooth", nullptr,
            "curves and runs: cubic pieces through the samples, without corners"},
           {"--curve-tree", nullptr,
            "curves and runs: also the k-d tree of the samples, for nearest_constraint()"},
           {"--device", "FILE",
            "a linkage's file, or a machine of `firmtouch-sim device --help`: the controller then "
            "takes joint "
            "counts "
            "and gives torques"},
           {"--teach", "NAME", "what the guide is called that a recorded run gives"},
           {"--max-deviation", "METRES",
            "no place of the run is farther from its guide (default 0.0001)"},
           {"--json", nullptr, "what was made, for programs, on stdout"}}),
      1,
      SIZE_MAX};
  return command;
}

int run_bake(const Arguments& arguments) {
  const std::string output = arguments.text("-o", "");
  const std::string source = arguments.text("--cpp", "");
  if (output.empty()) fail_usage("bake: say where to write: -o SCENE.fta");
  const bool is_json = arguments.has("--json");
  if (output == "-" && (is_json || !source.empty()))
    fail_usage("bake: -o - takes standard output: leave out --json and --cpp, or name a file");
  if (source == output) fail_usage("bake: -o and --cpp name the same file; name two");
  BakeOptions options = bake_options(arguments);
  add_hull(arguments, options);
  const std::vector<std::string> inputs = inputs_with_units(arguments.positionals(), options.model);
  for (const std::string& input : inputs) {
    forbid_overwriting(output, input);
    forbid_overwriting(source, input);
  }
  check_runs(inputs, options);
  const std::string device = arguments.text("--device", "");
  std::vector<std::string> named = inputs;
  if (!device.empty()) {
    named.push_back(device);
    forbid_overwriting(output, device);
    forbid_overwriting(source, device);
  }
  check_names(named, options);
  for (const std::string& input : inputs) {
    if (is_run(input)) continue;
    settle_size(input, options.model);
    break;
  }

  std::vector<BakedInput> baked = bake_all(inputs, options);
  if (!device.empty()) baked.push_back(bake_device(device));
  std::vector<tools::Section> sections;
  for (const BakedInput& input : baked) {
    sections.insert(sections.end(), input.sections.begin(), input.sections.end());
  }
  const tools::AssetFile file = tools::write_asset(sections);
  if (!file.problem.empty()) fail_input(output + ": " + file.problem);
  const core::Bytes bytes(file.bytes.data(), static_cast<uint32_t>(file.bytes.size()));
  const std::string unsound = tools::prove_asset(bytes);
  if (!unsound.empty()) {
    fail_input(output + ": the asset that was made does not pass its own proof (" + unsound +
               "); nothing was written: a defect of the baker, please report the input");
  }
  write_file(output, file.bytes.data(), file.bytes.size());
  if (!source.empty()) write_source(source, file.bytes, output);

  for (size_t i = 0; i < named.size(); ++i)
    print_report(name_of(named[i], options), baked[i].report);
  asset::Container container;
  (void)asset::open(bytes, container);
  std::fprintf(stderr, "%s: %zu bytes, %zu %s, CRC %08x, proven with the firmware's decoder\n",
               output.c_str(), file.bytes.size(), named.size(),
               named.size() == 1 ? "asset" : "assets", container.crc());
  std::fprintf(stderr, "needs parts: %s (FIRMTOUCH_APP)\n",
               tools::needed_parts_text(container).c_str());
  if (!is_json) return kDone;
  std::vector<std::string> reported;
  for (size_t i = 0; i < inputs.size(); ++i)
    for (const std::string& line : baked[i].report)
      reported.push_back(name_of(inputs[i], options) + ": " + line);
  std::puts(asset_json(output, container)
                .add("reported", tools::json_list(reported, tools::json_text))
                .object()
                .c_str());
  return kDone;
}

}  // namespace firmtouch::cli
