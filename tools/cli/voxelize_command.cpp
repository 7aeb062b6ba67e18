#include <cstdio>

#include "batch/parallel.hpp"
#include "cli/baked_input.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/progress.hpp"
#include "field/distance_field.hpp"
#include "field/write_vti.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kMaxCells = 4096;
// About 60 bytes a voxel while it works, and 22 in the file.
constexpr double kMaxVoxels = 1 << 29;
constexpr size_t kShown = 20;

void print_report(const std::string& name, const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    std::fprintf(stderr, "%s: %s\n", name.c_str(), line.c_str());
}

void print_field(const tools::DistanceField& distance_field, const std::vector<std::string>& inputs,
                 uint32_t threads) {
  const auto& grid = distance_field.grid;
  std::fprintf(stderr, "%u x %u x %u voxels of %.6g m: %zu on a surface, %zu inside, %zu outside\n",
               grid.count[0], grid.count[1], grid.count[2], grid.size_m, distance_field.surface,
               distance_field.inside, distance_field.outside);
  std::fprintf(stderr,
               "voxelized and filled in %.3f s; %zu distances in %.3f s by %u %s, %.3f us each\n",
               distance_field.voxelize_s, distance_field.computed, distance_field.distance_s,
               threads, threads == 1 ? "thread" : "threads",
               distance_field.distance_s * 1e6 / static_cast<double>(distance_field.computed));
  if (distance_field.disagreements.empty()) {
    std::fputs("flood fill and pseudonormals agree on the sign of every voxel off the surface\n",
               stderr);
    return;
  }
  std::fprintf(stderr, "flood fill and pseudonormals differ at %zu %s off the surface:\n",
               distance_field.disagreements.size(),
               distance_field.disagreements.size() == 1 ? "voxel" : "voxels");
  for (size_t i = 0; i < distance_field.disagreements.size() && i < kShown; ++i) {
    const auto& each = distance_field.disagreements[i];
    const size_t x = each.voxel % grid.count[0], y = each.voxel / grid.count[0] % grid.count[1],
                 z = each.voxel / grid.count[0] / grid.count[1];
    const tools::Point p =
        grid.centre_m(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    std::fprintf(stderr, "    %s: voxel %zu, %zu, %zu at (%.6g, %.6g, %.6g m): the flood says %s\n",
                 inputs[each.object].c_str(), x, y, z, p.x, p.y, p.z,
                 each.flood_says_inside ? "inside" : "outside");
  }
  if (distance_field.disagreements.size() > kShown)
    std::fprintf(stderr, "    and %zu more\n", distance_field.disagreements.size() - kShown);
}

std::string json_of(const tools::DistanceField& made, const std::string& output) {
  return tools::Json()
      .add("file", output.empty() ? "null" : tools::json_text(output))
      .add("voxels",
           tools::json_list(made.grid.count, [](uint32_t n) { return std::to_string(n); }))
      .add("voxel_m", made.grid.size_m)
      .add("surface", uint64_t{made.surface})
      .add("inside", uint64_t{made.inside})
      .add("outside", uint64_t{made.outside})
      .add("distances", uint64_t{made.computed})
      .add("disagreements", uint64_t{made.disagreements.size()})
      .object();
}

}  // namespace

Command voxelize_command() {
  return {
      {"voxelize", "MODEL... -n LONG_AXIS_CELLS [-o FILE] [options]", 1, SIZE_MAX, run_voxelize},
      "Voxels of closed models: surface, inside, outside, and the distance and closest point of "
      "each.",
      R"(All models share one grid: its long axis has LONG_AXIS_CELLS voxels. Distance is to the
nearest surface of any, negative inside of any. The .vti has a point a voxel with the
arrays distance, closest_point, triangle, object, side and kind; ParaView opens it. The
.nrrd has the distances; 3D Slicer opens it.)",
      {{"-n", "LONG_AXIS_CELLS", "voxels along the longest side, 1 to 4096"},
       {"-o", "FILE", "a .vti or .nrrd to write; -: a .vti to stdout"},
       {"--interior", nullptr, "distances only for voxels on a surface or inside"},
       {"--close-holes", nullptr, "each hole of a model gets a cap of triangles, reported"},
       {"--threads", "N", "how many compute (default: one a processor; the result is the same)"},
       {"--json", nullptr, "what was made, for programs, on stdout"}}};
}

int run_voxelize(const Arguments& arguments) {
  const std::vector<std::string>& inputs = arguments.positionals();
  const std::string output = arguments.text("-o", "");
  if (!arguments.has("-n")) fail_usage("voxelize: say how fine: -n LONG_AXIS_CELLS");
  const uint32_t cells = arguments.count("-n", 1, 1, kMaxCells);
  if (output == "-" && arguments.has("--json"))
    fail_usage("voxelize: -o - takes standard output: leave out --json, or name a file");
  const bool is_nrrd = extension_of(output) == ".nrrd";
  if (!output.empty() && output != "-" && !is_nrrd && extension_of(output) != ".vti")
    fail_usage("voxelize: -o " + output + ": name it .vti or .nrrd");
  if (inputs.size() > INT16_MAX)
    fail_usage("voxelize: at most " + std::to_string(INT16_MAX) + " models at once");
  check_output(output);
  for (const std::string& input : inputs) forbid_overwriting(output, input);
  tools::FieldOptions options;
  options.interior_only = arguments.has("--interior");
  options.threads = arguments.count("--threads", std::min(tools::processors(), 256u), 1, 256);
  ModelOptions read;
  read.close_holes = arguments.has("--close-holes");

  tools::DistanceField distance_field;
  std::vector<SoundSurface> sound;
  std::string file;
  {
    constexpr size_t kParts = 16;
    Progress progress(static_cast<double>(inputs.size() + kParts + 2));
    std::vector<const tools::Surface*> surfaces;
    for (const std::string& path : inputs) {
      progress.stage("reading and checking " + file_name_of(path));
      sound.push_back(sound_surface(path, read_model(path), read));
    }
    for (const SoundSurface& each : sound) surfaces.push_back(&each.surface);
    const tools::VoxelGrid grid = tools::make_voxel_grid(surfaces, cells);
    if (static_cast<double>(grid.count[0]) * grid.count[1] * grid.count[2] > kMaxVoxels)
      fail_usage("voxelize: -n " + std::to_string(cells) + " makes more than " +
                 std::to_string(1 << 29) + " voxels of these models; choose less");
    progress.stage("voxelizing");
    std::vector<tools::Solid> solids;
    solids.reserve(sound.size());
    for (const SoundSurface& each : sound) solids.emplace_back(each.surface);
    size_t reported = 0;
    options.on_progress = [&](double share) {
      for (; static_cast<double>(reported) < share * kParts; ++reported)
        progress.stage("distances");
    };
    distance_field = tools::make_distance_field(solids, grid, options);
    if (!output.empty()) {
      progress.stage("writing " + file_name_of(output));
      file = is_nrrd ? tools::to_nrrd(distance_field) : tools::to_vti(distance_field, solids);
      write_file(output, file.data(), file.size());
    }
  }
  for (size_t i = 0; i < inputs.size(); ++i) print_report(inputs[i], sound[i].reported);
  print_field(distance_field, inputs, options.threads);
  if (!output.empty()) std::fprintf(stderr, "%s: %zu bytes\n", output.c_str(), file.size());
  if (arguments.has("--json")) std::puts(json_of(distance_field, output).c_str());
  return kDone;
}

}  // namespace firmtouch::cli
