#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "firmtouch/scene/materials_layout.hpp"
#include "surface/read/read_surface.hpp"

namespace firmtouch::tools {

/// The materials of a bake, in the order of their file: the first is number 1.
struct Materials {
  std::string file;  // for messages
  std::vector<scene::MaterialLayout> table;
  std::vector<scene::TextureLayout> textures = {};  // one a material; none where all are smooth
  std::vector<scene::ReliefLayout> reliefs = {};    // one a material, or none
  std::vector<uint8_t> samples = {};                // of all maps
};

/// Reads a file of materials, one a line (syntax: `firmtouch bake --help`). Throws Refused with
/// file and line: unknown word or unit, value out of range, texture too steep, name given twice,
/// none, more than 255; or with a height map's path, which is relative to the file.
Materials read_materials(const std::string& file, const std::string& text);

/// The number of each triangle's material, of a model that names them. Throws Refused: a name or
/// number that is not in the table, or a model that names none.
std::vector<uint8_t> triangle_materials(const std::string& model, const FileMaterials& named,
                                        const Materials& materials);

/// The same from a text of one number a triangle, 0 for none. Throws Refused: a word, one
/// that is not in the table, too few or too many of them.
std::vector<uint8_t> read_triangle_materials(const std::string& file, std::string_view text,
                                             size_t triangles, const Materials& materials);

}  // namespace firmtouch::tools
