#include <cstdio>

#include "bake/asset/opening_cost.hpp"
#include "bake/asset/part_names.hpp"
#include "cli/asset_json.hpp"
#include "cli/baked_asset.hpp"
#include "cli/catalogue.hpp"
#include "cli/commands.hpp"
#include "cli/cpp_source.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/hull_arguments.hpp"
#include "firmtouch/asset/opening.hpp"

namespace firmtouch::cli {
namespace {

void print_report(const std::string& name, const std::vector<std::string>& lines) {
  for (size_t i = 0; i < lines.size(); ++i) {
    std::fprintf(stderr, "%s%s\n", i == 0 ? (name + ": ").c_str() : "    ", lines[i].c_str());
  }
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

// What bake reads, and how its own files are written.
const char* const kInputs =
    R"(INPUT by extension: .obj .off .ply .stl .gltf .glb .3mf a mesh; .csv a curve (header
x,y,z); .ftl a recorded run, which teaches a guide; .igs .iges NURBS curves or surfaces
(126, 128); .bpt Bezier patches; .objects several meshes in one scene; .tool a tool of
several spheres; .fta what was baked before, taken as it is. Each is named after its
file's stem. What can be mended safely is mended and reported; the rest is refused.
A file .objects places meshes that are baked with it, one object a line; # is a comment:
  object NAME of MESH [at X Y Z mm] [turned A deg about X Y Z] [stiffness K N/m]
         [friction F [sliding F]] [moves X Y Z mm/s] [turns X Y Z rad/s]
K and the parameter contact_stiffness are two springs in series: 3000 and 1000 N/m feel
like 750. An object stands until a command moves it (firmtouch-sim run: at T s move NAME).
A file of --materials says how triangles feel, one material a line:
  material NAME [stiffness K N/m] [friction F [sliding F]] [viscous C Ns/m]
         [waves H mm every L mm along X Y Z [and X Y Z]]
         [map PICTURE.pgm H mm every L mm along X Y Z and X Y Z]
Waves are a texture, H from crest to trough, fixed to the asset's axes; a second direction
makes a grid of the grooves. They are at most 2 mm and 0.238 L high. A map is a picture of 8
bits, square with a side of 4 to 64, that repeats every L: black is H below white. It may
slope by 0.75, and adds to waves. PICTURE.pgm is relative to the file.
NAME is that of an OBJ file's `usemtl` (without any: of its groups `g`), with _ for blanks;
the number in a PLY file's face property material_index counts these lines from 1; 0 is none.
A file .tool has up to 8 spheres of a tool, in the frame of its handle; they touch the
mesh instead of one sphere at the tip:
  sphere X Y Z mm radius R mm
All together are as stiff as the wall. The handle turns by commands (firmtouch-sim run: at
T s turn AXIS ANGLE).
A catalogue has an asset a line, as words behind `firmtouch bake`; # is a comment, "a b"
one word:
  INPUT... -o SCENE.fta [options]
The results have a row a line: baked or refused, bytes, CRC, why. Killed and started again
it goes on, and the bytes are the same, by any number of threads and shards; put these
together with firmtouch-sim merge (tools/batch has a make file and a SLURM script). A
model that has changed since is baked anew where the results are removed. Exit code 1
where one was refused.)";

}  // namespace

Command bake_command() {
  return {
      {"bake", "INPUT... -o SCENE.fta [options], or --catalogue LIST -o RESULTS.csv [--shard I/N]",
       0, SIZE_MAX, run_bake},
      "Bakes meshes, curves and splines into one asset, proven with the firmware's own decoder.",
      kInputs,
      with_model_options(with_hull_options(
          {{"-o", "FILE", "the asset to write; -: to stdout"},
           {"--unsigned", nullptr, "meshes without inside and outside: distance only; may be open"},
           {"--fast", nullptr,
            "meshes: the fastest on a controller rather than the smallest (the default)"},
           {"--bounded", nullptr,
            "meshes: the worst query near the surface takes a controller a fifth less, a tick in "
            "contact up to a fifth less, for a third more flash"},
           {"--small", nullptr,
            "meshes: a third less flash, a third more work a query; splines: half the flash"},
           {"--desktop", nullptr,
            "meshes: the fastest on a desktop with AVX2; half as much work again on a controller"},
           {"--distance-map", "CELLS",
            "meshes get a grid of certified bounds, CELLS along the long axis"},
           {"--materials", "FILE", "a mesh's triangles get materials: stiffness and friction"},
           {"--material-numbers", "FILE",
            "which: a number for each triangle of the model, in its order, instead of the model's"},
           {"--cpp", "FILE", "the asset as a C++ source, too"},
           {"--hull-faces", "N",
            "meshes get a progressive hull, at its coarsest of at most N faces: enclosing, proven"},
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
            "run and guide are nowhere farther from each other (default 0.0001)"},
           {"--catalogue", "LIST", "bakes what each line of LIST says"},
           {"--shard", "I/N", "of a catalogue: every Nth line only, from the Ith on"},
           {"--jobs", "N", "of a catalogue: threads (default: one a core)"},
           {"--json", nullptr, "what was made, for programs, on stdout"}}))};
}

int run_bake(const Arguments& arguments) {
  if (arguments.has("--catalogue")) return bake_catalogue(arguments);
  for (const char* const option : {"--shard", "--jobs"})
    if (arguments.has(option)) fail_usage(std::string("bake: ") + option + " is of a --catalogue");
  if (arguments.positionals().empty())
    fail_usage("bake: something is missing (see firmtouch bake --help)");
  const std::string output = arguments.text("-o", "");
  const std::string source = arguments.text("--cpp", "");
  if (output.empty()) fail_usage("bake: say where to write: -o SCENE.fta");
  const bool is_json = arguments.has("--json");
  if (output == "-" && (is_json || !source.empty()))
    fail_usage("bake: -o - takes standard output: leave out --json and --cpp, or name a file");
  if (source == output) fail_usage("bake: -o and --cpp name the same file; name two");
  for (const std::string& file : {output, source}) check_output(file);
  const BakeRequest request = bake_request(arguments);
  for (const std::string& file : request.files()) {
    forbid_overwriting(output, file);
    forbid_overwriting(source, file);
  }
  for (const std::string option : {"--materials", "--material-numbers"})
    forbid_overwriting(output, arguments.text(option, ""));
  const BakedAsset baked = bake_asset(request, output);
  write_file(output, baked.bytes.data(), baked.bytes.size());
  if (!source.empty()) write_source(source, baked.bytes, output);

  for (const NamedReport& report : baked.reports) print_report(report.name, report.lines);
  const core::Bytes bytes(baked.bytes.data(), static_cast<uint32_t>(baked.bytes.size()));
  asset::Container container;
  (void)asset::open(bytes, container);
  std::fprintf(stderr, "%s: %zu bytes, %zu %s, CRC %08x, proven with the firmware's decoder\n",
               output.c_str(), baked.bytes.size(), baked.reports.size(),
               baked.reports.size() == 1 ? "asset" : "assets", container.crc());
  std::fprintf(stderr, "needs parts: %s (FIRMTOUCH_APP)\n",
               tools::needed_parts_text(container).c_str());
  std::fprintf(stderr, "%s\n", tools::opening_cost_text(container).c_str());
  for (const std::string& line : tools::used_of_several(container))
    std::fprintf(stderr, "%s\n", line.c_str());
  if (!is_json) return kDone;
  std::vector<std::string> reported;
  for (size_t i = 0; i < request.inputs.size(); ++i)
    for (const std::string& line : baked.reports[i].lines)
      reported.push_back(baked.reports[i].name + ": " + line);
  std::puts(asset_json(output, container)
                .add("reported", tools::json_list(reported, tools::json_text))
                .object()
                .c_str());
  return kDone;
}

}  // namespace firmtouch::cli
