#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "bake/mesh/bake_signs.hpp"
#include "bake/mesh/mesh_tree.hpp"
#include "bake/mesh/refine.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/scene/stored_materials.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

struct MeshOptions {
  bool is_signed = true;
  double max_growth = kMaxGrowth;  // of refine(); 0: the faces stay as given
  TreeShape shape = kFastTree;
  std::vector<scene::MaterialLayout> materials = {};  // of the surface's numbers, from 1
  std::vector<scene::TextureLayout> textures = {};    // one a material, or none
  std::vector<scene::ReliefLayout> reliefs = {};      // the same
  std::vector<uint8_t> samples = {};                  // of all maps
};

struct MeshReport {
  uint32_t triangles = 0, vertices = 0, nodes = 0, depth = 0;
  // Of what a query reads: tree, indices and vertices, and what gives the sign.
  uint32_t shape_bytes = 0, sign_bytes = 0;
  std::vector<uint32_t> of_material;  // triangles of each, the first without any
  Refined refined;
  SignReport signs;     // of a signed mesh
  std::string problem;  // empty: baked and proven; else what, where and how to mend
};

/// Builds tree, pseudonormals and arrays of a checked surface and proves them with the firmware's
/// own open().
std::vector<Section> bake_mesh(const Surface& surface, const std::string& name,
                               const MeshOptions& options, MeshReport& report);

/// The same with all splits that the options allow, whether or not queries gain by them.
std::vector<Section> bake_mesh_so(const Surface& surface, const std::string& name,
                                  const MeshOptions& options, MeshReport& report);

}  // namespace firmtouch::tools
