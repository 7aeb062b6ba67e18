#pragma once
// What a processor with vector instructions reads in place of a tree and its triangles: the same values
// in the order in which it wants them. No asset holds it: it is made in memory when one is opened
// (tools/bake/mesh/mesh_ahead.hpp).

#include <stddef.h>

#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::mesh {

constexpr uint32_t kMaxLanes = 8;
constexpr uint32_t kRowsOfCorners = 9;
constexpr uint32_t kRowsOfShapes = sizeof(TriangleShape) / sizeof(float);
constexpr uint32_t kRowsOfPrisms = 16;
constexpr uint32_t kFeatures = 7;

/// Triangles that are measured side by side, one behind the other in the mesh: those of a node (but
/// the root) that holds at most kMaxLanes of them, in at most two leaves on either side; of the topmost
/// such node. Or those of a leaf that is in none.
struct Block {
  uint32_t first, count;
};

/// The block of a node. Byte 2 slot + k of `lanes`: a bit for each triangle of leaf k on that side.
struct NodeBlock {
  Block of;
  uint32_t lanes;
  // The boxes in the node and below it: bit 0 and 4 its own, 1 and 5 those in its child of side 0, 2 and 6
  // of side 1, where these are no leaves.
  uint32_t boxes;

  NodeBlock() = default;
  NodeBlock(const Block& block, uint32_t of_leaves)
      : of(block),
        lanes(of_leaves),
        boxes(0x11u | ((lanes & 0xFF00u) != 0 ? 0x22u : 0u) |
              ((lanes & 0xFF000000u) != 0 ? 0x44u : 0u)) {}
};

// A leaf, as a Side has it, and in the bits that a mesh of at most so many triangles leaves over: where
// its first stands in its block << 22, how many the block has, less 1, << 25.
constexpr uint32_t kMaxAhead = 1u << 22;
constexpr uint32_t lined_first(uint32_t leaf) { return leaf & (kMaxAhead - 1); }
constexpr uint32_t lined_lane(uint32_t leaf) { return (leaf >> 22) & 7u; }
constexpr Block lined_block(uint32_t leaf) {
  return {lined_first(leaf) - lined_lane(leaf), ((leaf >> 25) & 7u) + 1};
}
constexpr uint32_t make_lined(uint32_t leaf, const Block& block) {
  return leaf | (leaf_first(leaf) - block.first) << 22 | (block.count - 1) << 25;
}

// An inner node that has a block, where it is told.
constexpr uint32_t kBlockBit = 0x40000000u;
constexpr uint32_t block_node(uint32_t child) { return child & ~kBlockBit; }

/// Answers have the same bits with it and without, steps included.
struct Ahead {
  const Node* nodes;        // [node_count]: the mesh's, with leaves as above
  const Node* block_nodes;  // [node_count]: the same, told which have a block
  // Node[2 * node_count + 1]: of the child at each place its two sides, so that those of both children of
  // a node lie one behind the other; of a leaf those of the root, which are the last too.
  const Node* families;
  const NodeBlock* blocks;  // [node_count]; of no triangles where a node has none
  // float[9 * (triangle_count + 1) + kMaxLanes]: of each block nine rows of count floats, from float
  // 9 first on: x of corners 0, y, z, then of corners 1 and 2.
  const float* corners;
  // float[12 * (triangle_count + 1) + kMaxLanes]: so too of each leaf twelve rows of its shapes.
  const float* shapes;
  // float[16 * (triangle_count + 1) + kMaxLanes]: of each block sixteen rows of its prisms (mesh/prism.hpp).
  const float* prisms;
  // [7 * triangle_count]: the unit pseudonormals of a triangle's features, in their order.
  const Vertex* directions;
};

/// Has the processor fetch what is asked for when `child` of one of block_nodes is visited; of a leaf the
/// root's. Most of what a search waits for is memory that has left the first cache.
[[gnu::always_inline]] inline void fetch(const Ahead& ahead, uint32_t child) {
  const size_t node = block_node(child) & ~static_cast<uint32_t>(static_cast<int32_t>(child) >> 31);
  __builtin_prefetch(ahead.families + 2 * node);
  __builtin_prefetch(ahead.blocks + node);
}

}  // namespace firmtouch::mesh
