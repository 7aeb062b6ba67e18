#include "simd/build_tree.hpp"

#include <algorithm>
#include <vector>

#include "firmtouch/mesh/direction.hpp"
#include "simd/prism.hpp"
#include "simd/triangle_shape.hpp"

namespace firmtouch::simd {
namespace {

// The range of the triangles of up to four leaves, and their number.
struct Leaves {
  uint32_t first = UINT32_MAX, end = 0, count = 0;

  void add(uint32_t leaf) {
    first = std::min(first, leaf_first(leaf));
    end = std::max(end, leaf_first(leaf) + leaf_count(leaf));
    count += leaf_count(leaf);
  }
  bool make_a_block() const { return count <= kLanes && end - first == count; }
};

// A bit for each triangle of a leaf of the block.
uint32_t lane_bits(uint32_t leaf, uint32_t first) {
  return ((1u << leaf_count(leaf)) - 1u) << (leaf_first(leaf) - first);
}

// The block of a node's triangles; an empty one if they make none.
NodeBlock block_of(const mesh::View& mesh, uint32_t node) {
  Leaves leaves;
  uint32_t leaf[4] = {};
  for (uint32_t which = 0; which < 2; ++which) {
    const uint32_t child = mesh.sides()[2 * node + which].child;
    if (is_leaf(child)) {
      leaf[2 * which] = child;
      continue;
    }
    for (uint32_t k = 0; k < 2; ++k) {
      leaf[2 * which + k] = mesh.sides()[2 * child + k].child;
      if (!is_leaf(leaf[2 * which + k])) return {};
    }
  }
  for (const uint32_t of : leaf)
    if (of != 0) leaves.add(of);
  if (!leaves.make_a_block()) return {};
  uint32_t lanes = 0;
  for (uint32_t i = 0; i < 4; ++i)
    if (leaf[i] != 0) lanes |= lane_bits(leaf[i], leaves.first) << (8 * i);
  return make_node_block({leaves.first, leaves.count}, lanes);
}

// Nodes in order, two in each cache line: both children of a node share one.
class LinesOfNodes {
 public:
  void push_back(const mesh::Node& node) {
    if (count_ % 2 == 0) lines_.emplace_back();
    lines_.back().node[count_++ % 2] = node;
  }
  size_t size() const { return count_; }
  const mesh::Node& operator[](size_t i) const { return lines_[i / 2].node[i % 2]; }
  mesh::Node& back() { return lines_.back().node[(count_ - 1) % 2]; }
  const mesh::Node* data() const { return lines_.front().node; }

 private:
  struct alignas(64) Line {
    mesh::Node node[2];
  };
  static_assert(sizeof(Line) == 2 * sizeof(mesh::Node));
  std::vector<Line> lines_;
  size_t count_ = 0;
};

}  // namespace

struct OwnedTree::Arrays {
  mesh::View mesh;
  LinesOfNodes nodes, block_nodes, children;
  std::vector<NodeBlock> blocks;
  std::vector<float> corners, shapes, prisms;
  std::vector<mesh::Vertex> directions;
  std::vector<SegmentNode> segment_nodes;
  WideTree tree{};

  explicit Arrays(const mesh::View& of) : mesh(of) {
    const size_t triangles = mesh.head().triangle_count;
    corners.resize(kCornerArrays * (triangles + 1) + kLanes);
    shapes.resize(kShapeArrays * (triangles + 1) + kLanes);
    prisms.resize(kPrismArrays * (triangles + 1) + kLanes);
    put_nodes();
    put_marked_nodes();
    put_directions();
    put_segment_nodes();
    tree = {nodes.data(),  block_nodes.data(), children.data(),   corners.data(),
            shapes.data(), prisms.data(),      directions.data(), segment_nodes.data()};
  }

 private:
  // Parents come before their children: the topmost node that can has the block.
  void put_nodes() {
    std::vector<Block> block_of_node(mesh.nodes().size());  // the node's own, or an ancestor's
    blocks.resize(mesh.nodes().size());
    for (uint32_t node = 0; node < blocks.size(); ++node) {
      Block& block = block_of_node[node];
      if (node != 0 && block.count == 0) {
        blocks[node] = block_of(mesh, node);
        block = blocks[node].of;
      }
      nodes.push_back(mesh.nodes()[node]);
      for (mesh::Side& side : nodes.back().side) {
        if (is_leaf(side.child))
          side.child = put_leaf(side.child, block);
        else
          block_of_node[side.child] = block;
      }
    }
  }
  // Result: the leaf with its place in its block: an ancestor's, or its own.
  uint32_t put_leaf(uint32_t leaf, const Block& ancestor) {
    // The empty leaf of a mesh of one triangle has one unused lane.
    const Block own{leaf_first(leaf), std::max(leaf_count(leaf), 1u)};
    const Block& block = ancestor.count != 0 ? ancestor : own;
    for (uint32_t i = own.first; i < own.first + leaf_count(leaf); ++i) {
      const mesh::Triangle<uint32_t> t = mesh.triangle(i);
      const math::Vec3 a = mesh.vertex(t.corner[0]), b = mesh.vertex(t.corner[1]),
                       c = mesh.vertex(t.corner[2]);
      const float of_corners[kCornerArrays] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
      put_in_arrays(of_corners, i, block, corners);
      float of_shape[kShapeArrays];
      put_floats(shape_of(a, b, c), of_shape);
      put_in_arrays(of_shape, i, block, shapes);
      float of_prism[kPrismArrays];
      put_prism(a, b, c, of_prism);
      put_in_arrays(of_prism, i, block, prisms);
    }
    return make_wide_leaf(leaf, block);
  }
  template <size_t kCount>
  static void put_in_arrays(const float (&values)[kCount], uint32_t triangle, const Block& block,
                            std::vector<float>& rows) {
    float* at = rows.data() + kCount * block.first + (triangle - block.first);
    for (const float value : values) *at = value, at += block.count;
  }

  mesh::Node marked(uint32_t node) const {
    mesh::Node marked = nodes[node];
    for (mesh::Side& side : marked.side)
      if (!is_leaf(side.child) && blocks[side.child].of.count != 0) side.child |= kBlockBit;
    return marked;
  }
  void put_marked_nodes() {
    for (uint32_t node = 0; node < nodes.size(); ++node) {
      const NodeBlock& block = blocks[node];
      const uint32_t words[4] = {block.of.first, block.of.count, block.lanes, block.boxes};
      for (uint32_t k = 0; k < 2; ++k) {
        const uint32_t child = mesh.sides()[2 * node + k].child;
        children.push_back(marked(is_leaf(child) ? 0 : child));
        for (uint32_t i = 0; i < 2 && block.of.count != 0; ++i)
          children.back().side[i].child = words[2 * k + i];
      }
    }
    children.push_back(marked(0));
    for (uint32_t node = 0; node < nodes.size(); ++node) block_nodes.push_back(marked(node));
  }

  void put_segment_nodes() {
    for (uint32_t node = 0; node < nodes.size(); ++node) {
      SegmentNode of = with_planes(children[2 * node], children[2 * node + 1]);
      if (blocks[node].of.count != 0) of.block = blocks[node];
      for (uint32_t k = 0; k < 2 && blocks[node].of.count == 0; ++k) {
        const uint32_t child = block_nodes[node].side[k].child;
        of.below.child[k] = child;
        of.below.fetched[k] = is_leaf(child) ? 0 : block_node(child);
      }
      segment_nodes.push_back(of);
    }
    segment_nodes.push_back(with_planes(nodes[0], nodes[0]));
  }

  void put_directions() {
    for (uint32_t i = 0; i < mesh.head().triangle_count; ++i)
      for (uint32_t f = 0; f < kFeatures; ++f) {
        const math::Vec3 d = mesh::feature_direction(mesh, i, static_cast<mesh::Feature>(f));
        directions.push_back({d.x, d.y, d.z});
      }
  }
};

OwnedTree::OwnedTree(const mesh::View& mesh) : arrays_(new Arrays(mesh)) {}
OwnedTree::OwnedTree(OwnedTree&&) noexcept = default;
OwnedTree& OwnedTree::operator=(OwnedTree&&) noexcept = default;
OwnedTree::~OwnedTree() = default;

const WideTree& OwnedTree::tree() const { return arrays_->tree; }

}  // namespace firmtouch::simd
