#pragma once
#include <string>
#include <vector>

#include "cli/arguments.hpp"

namespace firmtouch::cli {

/// What an input of `bake` is, by its extension.
bool is_curve_file(const std::string& path);
bool is_spline_file(const std::string& path);
bool is_run(const std::string& path);
bool is_asset(const std::string& path);
bool is_objects_file(const std::string& path);
bool is_tool_file(const std::string& path);
bool is_mesh_file(const std::string& path);

/// Fails (usage) where an option is given that means nothing to any of the inputs.
void forbid_useless_options(const Arguments& arguments, const std::vector<std::string>& inputs);

}  // namespace firmtouch::cli
