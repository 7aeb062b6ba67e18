#include <cstdio>

#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/model_input.hpp"
#include "cli/progress.hpp"
#include "json/json.hpp"
#include "surface/crossings.hpp"
#include "surface/read/load_file.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::cli {

Command mend_command() {
  return {
      {"mend", "MODEL -o FILE [options]", 1, 1, run_mend},
      "Mends a mesh so that it can be touched, as bake --mend does, and writes it.",
      R"(MODEL: .obj .off .ply .stl .gltf .glb .3mf; FILE: .obj .off .ply .stl, in metres. Vertices
near each other are welded, sheets that touch parted, dangling faces removed, holes closed,
windings made alike; each is reported. Where that is not enough, --wrap puts a surface
around whatever is there.)",
      with_model_options({{"-o", "FILE", "the mesh to write; -: as OBJ to stdout"},
                          {"--json", nullptr, "what was made, for programs, on stdout"}})};
}

int run_mend(const Arguments& arguments) {
  std::string text;
  ModelOptions options = model_options(arguments, text);
  options.mend = options.mend || !(options.wrap.value > 0);
  const std::string path = inputs_with_units(arguments.positionals(), options)[0];
  const std::string output = arguments.text("-o", "");
  if (output.empty()) fail_usage("mend: say where to write: -o FILE");
  if (output == "-" && arguments.has("--json"))
    fail_usage("mend: -o - takes standard output: leave out --json, or name a file");
  const std::string form = output == "-" ? "obj" : tools::model_extension(output);
  if (tools::to_model({}, form).empty())
    fail_usage("mend: -o " + output + ": name it .obj, .off, .ply or .stl");
  forbid_overwriting(output, path);
  SoundSurface sound;
  {
    Progress progress(0);
    progress.stage("mending " + file_name_of(path));
    settle_size(path, options);
    sound = sound_surface(path, read_model(path), options);
    for (const std::string& line :
         tools::describe(tools::find_crossings(sound.surface), sound.surface, sound.vertex_source))
      sound.reported.push_back(line);
  }
  const std::string bytes = tools::to_model(sound.surface, form);
  write_file(output, bytes.data(), bytes.size());
  for (const std::string& line : sound.reported)
    std::fprintf(stderr, "%s: %s\n", path.c_str(), line.c_str());
  std::fprintf(stderr, "%s: %zu triangles, closed, metres\n", output.c_str(),
               sound.surface.faces.size());
  if (arguments.has("--json"))
    std::puts(tools::Json()
                  .add("file", tools::json_text(output))
                  .add("triangles", uint64_t{sound.surface.faces.size()})
                  .add("reported", tools::json_list(sound.reported, tools::json_text))
                  .object()
                  .c_str());
  return kDone;
}

}  // namespace firmtouch::cli
