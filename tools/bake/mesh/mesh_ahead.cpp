#include "bake/mesh/mesh_ahead.hpp"

#include <algorithm>
#include <vector>

#include "bake/mesh/prism.hpp"
#include "firmtouch/math/isa_lanes.hpp"
#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/triangle_shape.hpp"

namespace firmtouch::tools {
namespace {

using mesh::Block;
using mesh::is_leaf;
using mesh::leaf_count;
using mesh::leaf_first;
using mesh::NodeBlock;

// The triangles of up to four leaves: where they begin and end, and how many they are.
struct Leaves {
  uint32_t first = UINT32_MAX, end = 0, count = 0;

  void add(uint32_t leaf) {
    first = std::min(first, leaf_first(leaf));
    end = std::max(end, leaf_first(leaf) + leaf_count(leaf));
    count += leaf_count(leaf);
  }
  bool make_a_block() const { return count <= mesh::kMaxLanes && end - first == count; }
};

// A bit for each triangle of a leaf of the block.
uint32_t lanes_of(uint32_t leaf, uint32_t first) {
  return ((1u << leaf_count(leaf)) - 1u) << (leaf_first(leaf) - first);
}

// The block that a node's triangles would make; of none where they do not.
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
    if (leaf[i] != 0) lanes |= lanes_of(leaf[i], leaves.first) << (8 * i);
  return {{leaves.first, leaves.count}, lanes};
}

// Nodes in order, two a cache line: a family is one.
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

struct MeshAhead::Stored {
  mesh::View mesh;
  LinesOfNodes nodes, block_nodes, families;
  std::vector<NodeBlock> blocks;
  std::vector<float> corners, shapes, prisms;
  std::vector<mesh::Vertex> directions;
  mesh::Ahead ahead{};

  explicit Stored(const mesh::View& of) : mesh(of) {
    const size_t triangles = mesh.head().triangle_count;
    corners.resize(mesh::kRowsOfCorners * (triangles + 1) + mesh::kMaxLanes);
    shapes.resize(mesh::kRowsOfShapes * (triangles + 1) + mesh::kMaxLanes);
    prisms.resize(mesh::kRowsOfPrisms * (triangles + 1) + mesh::kMaxLanes);
    put_nodes();
    put_what_has_blocks();
    put_directions();
    ahead = {nodes.data(),   block_nodes.data(), families.data(), blocks.data(),
             corners.data(), shapes.data(),      prisms.data(),   directions.data()};
  }

 private:
  // Parents come before their children: the topmost node that makes a block has it.
  void put_nodes() {
    std::vector<Block> block_about(mesh.nodes().size());  // the node's own, or that about it
    blocks.resize(mesh.nodes().size());
    for (uint32_t node = 0; node < blocks.size(); ++node) {
      Block& block = block_about[node];
      if (node != 0 && block.count == 0) {
        blocks[node] = block_of(mesh, node);
        block = blocks[node].of;
      }
      nodes.push_back(mesh.nodes()[node]);
      for (mesh::Side& side : nodes.back().side) {
        if (is_leaf(side.child))
          side.child = put_leaf(side.child, block);
        else
          block_about[side.child] = block;
      }
    }
  }
  // Result: the leaf in its block, which it is itself where there is none about it.
  uint32_t put_leaf(uint32_t leaf, const Block& about) {
    // One lane of nothing where the other leaf has the mesh's one triangle.
    const Block own{leaf_first(leaf), std::max(leaf_count(leaf), 1u)};
    const Block& block = about.count != 0 ? about : own;
    for (uint32_t i = own.first; i < own.first + leaf_count(leaf); ++i) {
      const mesh::Triangle<uint32_t> t = mesh.triangle(i);
      const math::Vec3 a = mesh.vertex(t.corner[0]), b = mesh.vertex(t.corner[1]),
                       c = mesh.vertex(t.corner[2]);
      const float of_corners[mesh::kRowsOfCorners] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
      put_in_rows(of_corners, i, block, corners);
      float of_shape[mesh::kRowsOfShapes];
      mesh::put_rows(mesh::shape_of(a, b, c), of_shape);
      put_in_rows(of_shape, i, own, shapes);
      float of_prism[mesh::kRowsOfPrisms];
      put_prism(a, b, c, of_prism);
      put_in_rows(of_prism, i, block, prisms);
    }
    return mesh::make_lined(leaf, block);
  }
  template <size_t kRows>
  static void put_in_rows(const float (&values)[kRows], uint32_t triangle, const Block& block,
                          std::vector<float>& rows) {
    float* at = rows.data() + kRows * block.first + (triangle - block.first);
    for (const float value : values) *at = value, at += block.count;
  }

  mesh::Node marked(uint32_t node) const {
    mesh::Node marked = nodes[node];
    for (mesh::Side& side : marked.side)
      if (!is_leaf(side.child) && blocks[side.child].of.count != 0) side.child |= mesh::kBlockBit;
    return marked;
  }
  void put_what_has_blocks() {
    for (const mesh::Node& node : mesh.nodes())
      for (const mesh::Side& side : node.side)
        families.push_back(marked(is_leaf(side.child) ? 0 : side.child));
    families.push_back(marked(0));
    for (uint32_t node = 0; node < nodes.size(); ++node) block_nodes.push_back(marked(node));
  }

  void put_directions() {
    for (uint32_t i = 0; i < mesh.head().triangle_count; ++i)
      for (uint32_t f = 0; f < mesh::kFeatures; ++f) {
        const math::Vec3 d = mesh::decoded_direction(mesh, i, static_cast<mesh::Feature>(f));
        directions.push_back({d.x, d.y, d.z});
      }
  }
};

MeshAhead::MeshAhead() = default;
MeshAhead::MeshAhead(const mesh::View& mesh) : stored_(new Stored(mesh)) {}
MeshAhead::MeshAhead(MeshAhead&&) noexcept = default;
MeshAhead& MeshAhead::operator=(MeshAhead&&) noexcept = default;
MeshAhead::~MeshAhead() = default;

mesh::View read_ahead(const mesh::View& mesh, MeshAhead& ahead) {
  if (!math::kHasLanes || mesh.head().triangle_count > mesh::kMaxAhead) return mesh;
  ahead = MeshAhead(mesh);
  return ahead.view();
}

mesh::View MeshAhead::view() const { return stored_->mesh.with(stored_->ahead); }

}  // namespace firmtouch::tools
