#include "cli/baked_asset.hpp"

#include <algorithm>
#include <map>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/asset_writer.hpp"
#include "bake/asset/origin.hpp"
#include "bake/asset/provenance.hpp"
#include "bake/objects/objects_file.hpp"
#include "bake/objects/tool_file.hpp"
#include "cli/asset_json.hpp"
#include "cli/asset_origin.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/hull_arguments.hpp"
#include "cli/input_kinds.hpp"
#include "cli/loaded_asset.hpp"
#include "device/device_file.hpp"
#include "device/inertia.hpp"
#include "device/machines.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/scene/materials_layout.hpp"

namespace firmtouch::cli {
namespace {

constexpr double kUsualDeviation_m = 1e-4;

std::string name_of(const std::string& path, const BakeOptions& options) {
  return is_run(path) ? options.teach : stem_of(path);
}

// Of the geometries that the input gives.
std::vector<std::string> names_of(const std::string& path, const BakeOptions& options) {
  if (!is_asset(path)) return {name_of(path, options)};
  const LoadedAsset asset(path);
  std::vector<std::string> names;
  for (uint32_t i = 0; i < asset.container().section_count(); ++i) {
    if (asset.container().type(i) == asset::kOriginSection) continue;
    if (names.empty() || names.back() != asset.container().name(i))
      names.push_back(asset.container().name(i));
  }
  return names;
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
}

// An asset is named after its file's stem, so two inputs of one stem would be one asset.
void check_names(const std::vector<std::string>& inputs, const BakeOptions& options) {
  std::map<std::string, std::string> seen;
  for (const std::string& path : inputs) {
    for (const std::string& name : names_of(path, options)) {
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
}

// What was baked before, as it is.
BakedInput take_asset(const std::string& path) {
  const LoadedAsset asset(path);
  BakedInput taken;
  for (uint32_t i = 0; i < asset.container().section_count(); ++i) {
    if (asset.container().type(i) == asset::kOriginSection) continue;  // settle_origin()
    const core::Bytes bytes = asset.container().section(i);
    taken.sections.push_back(tools::make_section(
        asset.container().type(i), asset.container().name(i), bytes.data(), bytes.size()));
  }
  taken.report = {"baked before, taken as it is: " + std::to_string(bytes_of(taken.sections)) +
                  " bytes"};
  return taken;
}

// What a text file says, as one section, named after the file's stem. `read`: to the elements.
template <class Read>
BakedInput bake_text_input(const std::string& path, uint32_t type, const char* what,
                           const Read& read) {
  BakedInput baked;
  try {
    const std::vector<uint8_t> source = read_file(path);
    const auto elements = read(std::string(source.begin(), source.end()));
    const std::string name = stem_of(path);
    baked.sections = {tools::make_section(type, name, elements), provenance_of(path, name, source)};
    baked.report = {std::to_string(elements.size()) + what +
                    std::to_string(bytes_of(baked.sections)) + " bytes"};
  } catch (const tools::Refused& refused) {
    fail_input(refused.what());
  }
  return baked;
}

std::vector<std::string> meshes_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> meshes;
  for (const std::string& input : inputs) {
    if (is_mesh_file(input)) meshes.push_back(stem_of(input));
    if (!is_asset(input)) continue;
    const LoadedAsset asset(input);
    for (const std::string& name : tools::names_with(asset.container(), mesh::kHeadSection))
      meshes.push_back(name);
  }
  return meshes;
}

BakedInput bake_objects_input(const std::string& path, const std::vector<std::string>& inputs) {
  return bake_text_input(path, scene::kObjectsSection, " objects, ", [&](const std::string& text) {
    return tools::read_objects(path, text, meshes_of(inputs));
  });
}

// An object turns about the origin of its model, which must stay that of the file.
bool has_turned_object(const std::vector<std::string>& inputs) {
  for (const std::string& path : inputs) {
    if (!is_objects_file(path)) continue;
    const BakedInput baked = bake_objects_input(path, inputs);
    for (const scene::ObjectLayout& object : core::as_whole_array<scene::ObjectLayout>(
             {baked.sections[0].bytes.data(),
              static_cast<uint32_t>(baked.sections[0].bytes.size())}))
      if (tools::turns(object)) return true;
  }
  return false;
}

BakedInput bake_tool_input(const std::string& path) {
  return bake_text_input(path, scene::kToolSection, " spheres of a tool, ",
                         [&](const std::string& text) { return tools::read_tool(path, text); });
}

std::vector<BakedInput> bake_all(const std::vector<std::string>& inputs,
                                 const BakeOptions& options) {
  double total = 0;
  for (const std::string& path : inputs) {
    total += 1 + (is_mesh_file(path) && options.hull_faces != 0 ? kShareOfHull : 0);
  }
  Progress progress(total, !options.is_quiet);
  std::vector<BakedInput> baked;
  for (const std::string& path : inputs) {
    baked.push_back(is_curve_file(path)     ? bake_curve_input(path, options, progress)
                    : is_run(path)          ? bake_run_input(path, options, progress)
                    : is_asset(path)        ? take_asset(path)
                    : is_spline_file(path)  ? bake_spline_input(path, options, progress)
                    : is_objects_file(path) ? bake_objects_input(path, inputs)
                    : is_tool_file(path)    ? bake_tool_input(path)
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
    const std::string name = stem_of(path);
    baked.sections = {
        tools::make_section(device::kLinkageSection, name, tools::stored_bytes_of(device)),
        provenance_of(path, name, source)};
    const tools::RangeFigures least = tools::least_figures(device);
    if (least.least_mass_kg > 0)
      baked.sections.push_back(
          tools::text_section(asset::kBoundsSection, name,
                              {{kTipDamping, tools::number_text(least.least_damping_N_s_per_m)}}));
    baked.report = {
        "linkage of " + std::to_string(device.joints.joints) + " joints, " +
        (device.is_homed ? "homed by the program (part `homing`), " : "") +
        (device.has_second_encoders ? "second encoders (part `second_encoders`), " : "") +
        (device.is_derated ? "thermal limits (part `derating`), " : "") +
        (has_compensation(device) ? "springs or friction carried (part `compensation`), " : "") +
        std::to_string(bytes_of(baked.sections)) + " bytes"};
    if (least.turns || least.whole < least.poses)
      baked.report.push_back(
          "warning: its ranges contain a singularity, or poses that the links do not reach: the "
          "force fades there; narrow low_ and high_ (firmtouch-sim device " +
          path + ")");
    if (!(least.least_mass_kg > 0))
      baked.report.push_back(
          "warning: its inertia is not positive definite: no run can simulate it, and walls that "
          "are not stable are enabled; state rotor_0 or masses of links");
  } catch (const tools::Refused& refused) {
    fail_input(refused.what());
  }
  return baked;
}

// --materials and --material-numbers.
void add_materials(const Arguments& arguments, BakeOptions& options) {
  const std::string path = arguments.text("--materials", "");
  options.model.material_numbers = arguments.text("--material-numbers", "");
  if (path.empty() && !options.model.material_numbers.empty())
    fail_usage("bake: --material-numbers says which of --materials FILE: give that, too");
  if (path.empty()) return;
  if (options.model.wrap.value > 0)
    fail_usage("bake: --wrap makes a surface of its own, without the model's materials: give one");
  if (!options.has_tree)
    fail_usage("bake: --no-tree is for hull queries alone, which have no --materials: give one");
  try {
    const std::vector<uint8_t> text = read_file(path);
    options.model.materials = tools::read_materials(path, std::string(text.begin(), text.end()));
  } catch (const tools::Refused& refused) {
    fail_input(refused.what());
  }
  options.text += " --materials " + file_name_of(path);
  if (!options.model.material_numbers.empty())
    options.text += " --material-numbers " + file_name_of(options.model.material_numbers);
}

// One mesh has numbers of its own; objects have a stiffness each.
void check_materials(const BakeRequest& request) {
  if (request.options.model.materials.table.empty()) return;
  size_t meshes = 0;
  for (const std::string& input : request.inputs) {
    if (is_mesh_file(input)) ++meshes;
    if (is_objects_file(input))
      fail_usage("bake: " + input +
                 " has a material for each object: leave out --materials, or bake one mesh");
  }
  if (meshes > 1 && !request.options.model.material_numbers.empty())
    fail_usage("bake: --material-numbers are of one mesh, and " + std::to_string(meshes) +
               " are given: bake them one by one");
}

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

}  // namespace

std::vector<std::string> BakeRequest::files() const {
  std::vector<std::string> files = inputs;
  if (!device.empty()) files.push_back(device);
  return files;
}

BakeRequest bake_request(const Arguments& arguments) {
  BakeRequest request;
  request.options = bake_options(arguments);
  request.inputs = inputs_with_units(arguments.positionals(), request.options.model);
  for (const std::string& input : request.inputs) forbid_pipe(input);
  forbid_useless_options(arguments, request.inputs);
  add_hull(arguments, request.options);
  add_materials(arguments, request.options);
  request.device = arguments.text("--device", "");
  check_runs(request.inputs, request.options);
  check_names(request.files(), request.options);
  check_materials(request);
  return request;
}

// A tool of spheres touches one mesh of one material (scene/tool_layout.hpp, kRuleToolAlone).
void check_tool_alone(const std::vector<tools::Section>& sections) {
  const auto first = [&](uint32_t type) {
    return std::find_if(sections.begin(), sections.end(),
                        [type](const tools::Section& section) { return section.type == type; });
  };
  const auto tool = first(scene::kToolSection);
  if (tool == sections.end()) return;
  const bool has_objects = first(scene::kObjectsSection) != sections.end();
  if (!has_objects && first(scene::kMaterialsSection) == sections.end()) return;
  fail_input(tool->name +
             ".tool: a tool of spheres touches one mesh of one material: leave it out, or " +
             (has_objects ? "the file .objects" : "--materials"));
}

BakedAsset bake_asset(BakeRequest request, const std::string& output) {
  for (const std::string& input : request.inputs) {
    if (is_run(input) || is_asset(input) || is_objects_file(input) || is_tool_file(input)) continue;
    settle_size(input, request.options.model);
    break;
  }
  const tools::Point origin_m =
      asset_origin(request.inputs, has_turned_object(request.inputs), request.options.model);
  request.options.model.origin_m = origin_m;
  std::vector<BakedInput> inputs = bake_all(request.inputs, request.options);
  if (!request.device.empty()) inputs.push_back(bake_device(request.device));
  BakedAsset baked;
  std::vector<tools::Section> sections;
  const std::vector<std::string> files = request.files();
  for (size_t i = 0; i < inputs.size(); ++i) {
    sections.insert(sections.end(), inputs[i].sections.begin(), inputs[i].sections.end());
    if (i == 0 && tools::is_moved(origin_m)) {
      sections.push_back(tools::origin_section(origin_m));
      inputs[i].report.push_back(origin_text(origin_m));
    }
    baked.reports.push_back({name_of(files[i], request.options), std::move(inputs[i].report)});
  }
  check_tool_alone(sections);
  tools::AssetFile file = tools::write_asset(sections);
  if (!file.problem.empty()) fail_input(output + ": " + file.problem);
  baked.bytes = std::move(file.bytes);
  const std::string unsound =
      tools::prove_asset({baked.bytes.data(), static_cast<uint32_t>(baked.bytes.size())});
  if (!unsound.empty()) {
    fail_input(output + ": the asset that was made does not pass its own proof (" + unsound +
               "); nothing was written: a defect of the baker, please report the input");
  }
  return baked;
}

}  // namespace firmtouch::cli
