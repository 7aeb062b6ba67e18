#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmtouch/mesh/layout.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The grid on which boxes are stored: covers at least 1.25 extents about the centre of the
/// bounding box.
struct Grid {
  std::array<float, 3> low_m{};
  float cell_m = 0;
  float slack_cells = 0;  // by which boxes exceed their faces, for turned ones
};

Grid make_grid(const Surface& surface);

/// A flattened tree over the faces of a surface. Nodes in depth-first order, parents before
/// children; `order` lists the faces as the leaves hold them, in the order of their nodes.
struct MeshTree {
  std::vector<mesh::Node> nodes;
  std::vector<uint32_t> parents;
  std::vector<uint32_t> order;
  uint32_t depth = 0;  // levels of nodes
};

/// What of bytes and speed a tree is for.
struct TreeShape {
  uint32_t leaf_faces;  // at most; 1 to 7
  double empty_cost =
      0;  // of a leaf's place without a face, beside 1 for a face: more, fuller leaves
  double node_cost = 0;  // of a node that splits a leaf, beside 1 for a face; 0: leaves stay whole
  // Stored beside the tree so that its worst-case query takes less (FORMAT.md, 0x100E).
  bool has_leaf_boxes = false;
};
// Measured on spot, rocker-arm and horse (firmware/firmtouch/mesh/README.md, Cost).
constexpr TreeShape kFastTree{3, 0, 0.53};
constexpr TreeShape kSmallTree{7};
// Smallest worst case of a query on a controller (firmware/firmtouch/mesh/README.md, Cost).
constexpr TreeShape kBoundedTree{3, 0, 0, true};
// Leaves that fill the lanes of a desktop's processor.
constexpr TreeShape kDesktopTree{7, 0.3};

/// Surface area heuristic over widened boxes by a full sweep over the face centres of each axis,
/// ties by face index: the same tree on every machine. Cost: O(n log^2 n), about 1 s for 100,000
/// faces.
MeshTree build_mesh_tree(const Surface& surface, const Grid& grid, const TreeShape& shape);

}  // namespace firmtouch::tools
