#pragma once
#include <string>
#include <vector>

#include "firmtouch/scene/tool_layout.hpp"

namespace firmtouch::tools {

/// Reads a file of a tool's spheres, one a line (syntax: `firmtouch bake --help`). Throws Refused
/// with file and line: unknown word or unit, value out of range, no sphere, more than 8.
std::vector<scene::SphereLayout> read_tool(const std::string& file, const std::string& text);

}  // namespace firmtouch::tools
