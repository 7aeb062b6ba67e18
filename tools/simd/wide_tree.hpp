#pragma once
// SIMD copy of a mesh's tree and triangles for hosts. No asset holds it: WideMesh builds it when a
// mesh is opened.

#include <stddef.h>

#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::simd {

using mesh::is_leaf;
using mesh::leaf_count;
using mesh::leaf_first;
using mesh::Node;
using mesh::Side;
using mesh::Vertex;

constexpr uint32_t kLanes = 8;
constexpr uint32_t kCornerArrays = 9;
constexpr uint32_t kPrismArrays = 16;
constexpr uint32_t kFeatures = 7;

/// Consecutive triangles that are measured at once. A node (except the root) with at most kLanes
/// triangles, in at most two leaves on either side, has a block, unless an ancestor has one. A leaf
/// below no such node is a block of its own.
struct Block {
  uint32_t first, count;
};

/// The block of a node. Byte 2 side + k of `lanes`: a bit for each triangle of leaf k on that side.
struct NodeBlock {
  Block of;
  uint32_t lanes;
  // The boxes in the node and below it: bits 0 and 4 its own; bits 1 and 5 those in its child of
  // side 0, bits 2 and 6 of side 1, unless these are leaves.
  uint32_t boxes;
};

constexpr NodeBlock make_node_block(const Block& block, uint32_t lanes) {
  return {
      block, lanes,
      0x11u | ((lanes & 0xFF00u) != 0 ? 0x22u : 0u) | ((lanes & 0xFF000000u) != 0 ? 0x44u : 0u)};
}

// A leaf as in mesh::Side::child. Bits that a mesh of at most kMaxWideTriangles leaves free hold
// its first lane in its block << 22, and the count of the block less 1 << 25.
constexpr uint32_t kMaxWideTriangles = 1u << 22;
constexpr uint32_t wide_leaf_first(uint32_t leaf) { return leaf & (kMaxWideTriangles - 1); }
constexpr uint32_t wide_leaf_lane(uint32_t leaf) { return (leaf >> 22) & 7u; }
constexpr Block wide_leaf_block(uint32_t leaf) {
  return {wide_leaf_first(leaf) - wide_leaf_lane(leaf), ((leaf >> 25) & 7u) + 1};
}
constexpr uint32_t make_wide_leaf(uint32_t leaf, const Block& block) {
  return leaf | (leaf_first(leaf) - block.first) << 22 | (block.count - 1) << 25;
}

// Marks the index of an inner node that has a block.
constexpr uint32_t kBlockBit = 0x40000000u;
constexpr uint32_t block_node(uint32_t child) { return child & ~kBlockBit; }

/// A node as a segment meets it: the boxes in both children, and what is below.
struct alignas(64) SegmentNode {
  float planes[24];  // of each axis the low halves of the four boxes' words, then the high halves
  union {
    struct {
      uint32_t child[2];    // as in WideTree::block_nodes
      uint32_t fetched[2];  // nodes to prefetch: the children; instead of a leaf, the root
    } below;
    NodeBlock block;  // of a node that has one
  };
};

/// Pre: the children of the node are `one` and `other`. Result: all but what is below.
inline SegmentNode with_planes(const Node& one, const Node& other) {
  SegmentNode node{};
  for (uint32_t box = 0; box < 4; ++box)
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const uint32_t word = (box < 2 ? one : other).side[box % 2].box[axis];
      node.planes[8 * axis + box] = static_cast<float>(word & 0xFFFFu);
      node.planes[8 * axis + 4 + box] = static_cast<float>(word >> 16);
    }
  return node;
}

struct WideTree {
  const Node* nodes;        // [node_count]: the mesh's, with leaves as above
  const Node* block_nodes;  // [node_count]: the same, with kBlockBit
  // Node[2 * node_count + 1]: at each slot a copy of the child there, so that both children of a
  // node are adjacent. At the slot of a leaf, and last, a copy of the root. No search passes
  // through a node that has a block: of its two copies the four child words hold the block.
  const Node* children;
  // float[9 * (triangle_count + 1) + kLanes]: of each block nine arrays of `count` floats, from
  // float 9 * first on: x, y, z of corner 0, then of corners 1 and 2.
  const float* corners;
  // float[12 * (triangle_count + 1) + kLanes]: of each block twelve arrays, the floats of its
  // shapes.
  const float* shapes;
  // float[16 * (triangle_count + 1) + kLanes]: of each block sixteen arrays of prisms (prism.hpp).
  const float* prisms;
  const Vertex*
      directions;  // [7 * triangle_count]: the unit pseudonormals of a triangle's features
  const SegmentNode* segment_nodes;  // [node_count + 1]: last, the boxes in the root, twice

  /// Pre: the node has a block.
  NodeBlock block(uint32_t node) const {
    const Side *const one = children[2 * size_t{node}].side, *const other =
                                                                 children[2 * size_t{node} + 1]
                                                                     .side;
    return {{one[0].child, one[1].child}, other[0].child, other[1].child};
  }
};

}  // namespace firmtouch::simd
