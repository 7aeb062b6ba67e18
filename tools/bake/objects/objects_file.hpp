#pragma once
#include <string>
#include <vector>

#include "firmtouch/scene/objects_layout.hpp"

namespace firmtouch::tools {

/// Reads a file of objects, one a line (syntax: `firmtouch bake --help`). `meshes`: the names of
/// those that are baked with it. Throws Refused with file and line: unknown word, unit or mesh,
/// value out of range, name given twice, no object, more than 16, or more than 8 meshes.
std::vector<scene::ObjectLayout> read_objects(const std::string& file, const std::string& text,
                                              const std::vector<std::string>& meshes);

/// Whether it is turned against its mesh, or turns by commands.
bool turns(const scene::ObjectLayout& object);

}  // namespace firmtouch::tools
