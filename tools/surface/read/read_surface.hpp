#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Which material each triangle of a file is of, as the file says it.
struct FileMaterials {
  std::vector<uint32_t>
      of;  // in the file's order, polygons fanned; 0: none; empty: it says nothing
  std::vector<std::string> names;  // what 1 and so on stand for; empty: the file's own numbers
};

/// A surface as in its file, unchecked except indices and numbers; or the problem.
struct Imported {
  Surface surface;
  std::string problem;  // empty: read; else file, place, what is wrong, how often, how to mend
  std::vector<std::string> notes;  // remarks for the report of a bake
  FileMaterials materials = {};    // where they are read
};

/// What a file without faces gives.
enum class PointsAre { kRefused, kTaken };

/// What becomes of a file's materials: of OBJ `usemtl`, without any the groups `g`; of PLY a
/// property material_index or material of its faces.
enum class MaterialsAre { kPassedOver, kRead };

/// Reads .obj, .off, .ply, .stl, .gltf, .glb or .3mf, distinguished by the extension in either
/// case; `.gz` behind it is passed over. Coordinates are read as double, placed by `frame` and
/// rounded once to float. Polygons are fanned from their first corner; `source` counts the
/// triangles in the file's order.
Imported read_surface(const std::string& path, const FileFrame& frame,
                      PointsAre points = PointsAre::kRefused);

/// The same from memory; `path` gives the extension and the name used in messages.
Imported read_surface_bytes(std::string_view bytes, const std::string& path, const FileFrame& frame,
                            PointsAre points = PointsAre::kRefused,
                            MaterialsAre materials = MaterialsAre::kPassedOver);

}  // namespace firmtouch::tools
