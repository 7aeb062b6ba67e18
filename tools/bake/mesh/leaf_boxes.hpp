#pragma once
#include <cstdint>
#include <vector>

#include "bake/mesh/mesh_tree.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// An oriented box about the triangles of each leaf that has two or more, as section 0x100E holds
/// them: of the frames along two corners and across a face, the leaf or its principal plane the one
/// whose box takes least module. `surface`: with its faces in the order of the leaves, in the frame
/// of the boxes.
std::vector<uint32_t> make_leaf_boxes(const Surface& surface, const Grid& grid,
                                      const MeshTree& tree);

}  // namespace firmtouch::tools
