#include "cli/input_kinds.hpp"

#include <algorithm>
#include <initializer_list>

#include "cli/failure.hpp"
#include "cli/files.hpp"

namespace firmtouch::cli {
namespace {

bool is_curve_or_run(const std::string& path) { return is_curve_file(path) || is_run(path); }

bool is_mesh_or_spline(const std::string& path) {
  return is_mesh_file(path) || is_spline_file(path);
}

// With coordinates of its own, which become metres.
bool is_model(const std::string& path) { return is_mesh_or_spline(path) || is_curve_file(path); }

// What an option is of. Those of hulls need --hull-faces, and --max-deviation needs --teach.
constexpr struct {
  const char* kinds;
  bool (*has)(const std::string& path);
  std::initializer_list<const char*> options;
} kUses[] = {
    {"a mesh",
     is_mesh_file,
     {"--close-holes", "--mend", "--wrap", "--unsigned", "--fast", "--bounded", "--desktop",
      "--distance-map", "--materials", "--hull-faces", "--keep-triangles"}},
    {"a mesh or a spline", is_mesh_or_spline, {"--small"}},
    {"a curve", is_curve_file, {"--decimal-comma"}},
    {"a curve or a recorded run", is_curve_or_run, {"--smooth", "--curve-tree"}},
    {"a recorded run", is_run, {"--teach"}},
    {"a mesh, a curve or a spline",
     is_model,
     {"--unit", "--scale", "--up", "--rotate", "--size", "--centre", "--translate"}},
};

}  // namespace

bool is_curve_file(const std::string& path) { return extension_of(path) == ".csv"; }

bool is_spline_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".igs" || extension == ".iges" || extension == ".bpt";
}

bool is_run(const std::string& path) { return extension_of(path) == ".ftl"; }

bool is_asset(const std::string& path) { return extension_of(path) == ".fta"; }

bool is_objects_file(const std::string& path) { return extension_of(path) == ".objects"; }

bool is_tool_file(const std::string& path) { return extension_of(path) == ".tool"; }

bool is_mesh_file(const std::string& path) {
  return !is_curve_file(path) && !is_run(path) && !is_spline_file(path) && !is_objects_file(path) &&
         !is_tool_file(path) && !is_asset(path);
}

void forbid_useless_options(const Arguments& arguments, const std::vector<std::string>& inputs) {
  for (const auto& use : kUses) {
    if (std::any_of(inputs.begin(), inputs.end(), use.has)) continue;
    for (const char* option : use.options)
      if (arguments.has(option))
        fail_usage(std::string("bake: ") + option + " is of " + use.kinds +
                   ", and none is given: add one, or leave it out");
  }
}

}  // namespace firmtouch::cli
