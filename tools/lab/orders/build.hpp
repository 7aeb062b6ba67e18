#pragma once
// The baker's tree with other boxes. Freestanding, into the caller's memory.
#include <float.h>

#include "lab/orders/oriented.hpp"
#include "lab/orders/tree.hpp"

namespace firmtouch::lab::orders {

/// Triangles of a node and of all below it.
struct Range {
  uint32_t begin, end;
};

/// What building needs besides the tree: Range[2 * nodes of the mesh] and uint32_t[nodes].
struct Workshop {
  Range* ranges;      // of each child of each node
  uint32_t* sources;  // of each node of a wide tree: the binary node that it stands for
};

static inline Range joined(Range a, Range b) {
  return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

static inline void put_ranges(const mesh::View& mesh, Range* ranges) {
  for (uint32_t n = mesh.nodes().size(); n-- > 0;)  // children come after their parents
    for (uint32_t slot = 0; slot < 2; ++slot) {
      const uint32_t child = mesh.nodes()[n].side[slot].child;
      const uint32_t first = mesh::leaf_first(child);
      ranges[2 * n + slot] = mesh::is_leaf(child)
                                 ? Range{first, first + mesh::leaf_count(child)}
                                 : joined(ranges[2 * child], ranges[2 * child + 1]);
    }
}

static inline FloatBox float_box(const mesh::View& mesh, Range range) {
  FloatBox box;
  box.low_m = box.high_m = mesh.vertex(mesh.triangle(range.begin).corner[0]);
  for (uint32_t i = range.begin; i < range.end; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 v = mesh.vertex(mesh.triangle(i).corner[k]);
      box.low_m = {v.x < box.low_m.x ? v.x : box.low_m.x, v.y < box.low_m.y ? v.y : box.low_m.y,
                   v.z < box.low_m.z ? v.z : box.low_m.z};
      box.high_m = {v.x > box.high_m.x ? v.x : box.high_m.x,
                    v.y > box.high_m.y ? v.y : box.high_m.y,
                    v.z > box.high_m.z ? v.z : box.high_m.z};
    }
  return box;
}

static inline void put_box(const mesh::View& mesh, uint32_t, uint32_t, Range range, FloatBox& box) {
  box = float_box(mesh, range);
}
static inline void put_box(const mesh::View& mesh, uint32_t, uint32_t, Range range,
                           OrientedBox& box) {
  box = fit_oriented(mesh, range.begin, range.end);
}
static inline void put_box(const mesh::View& mesh, uint32_t node, uint32_t slot, Range,
                           GridBox& box) {
  for (int k = 0; k < 3; ++k) box.word[k] = mesh.nodes()[node].side[slot].box[k];
}

static inline Vec3 centre_of(const mesh::Head& head, const GridBox& box) {
  float at[3];
  for (int k = 0; k < 3; ++k) {
    const uint32_t twice = (box.word[k] & 0xFFFFu) + mesh::kGridMax - (box.word[k] >> 16);
    at[k] = head.grid_low_m[k] + static_cast<float>(twice) * 0.5f * head.cell_m;
  }
  return {at[0], at[1], at[2]};
}
static inline Vec3 centre_of(const mesh::Head&, const FloatBox& box) {
  return (box.low_m + box.high_m) * 0.5f;
}
static inline Vec3 centre_of(const mesh::Head&, const OrientedBox& box) { return box.centre_m; }

static inline uint32_t nearest_vertex(const mesh::View& mesh, Range range, Vec3 centre_m) {
  float least2 = FLT_MAX;
  uint32_t nearest = mesh.triangle(range.begin).corner[0];
  for (uint32_t i = range.begin; i < range.end; ++i)
    for (const uint32_t corner : mesh.triangle(i).corner) {
      const Vec3 from = mesh.vertex(corner) - centre_m;
      if (dot(from, from) < least2) least2 = dot(from, from), nearest = corner;
    }
  return nearest;
}

/// A binary tree: as many nodes as the mesh has. `middle`: uint32_t[2 * nodes].
/// Pre: the mesh has more than one triangle.
template <class K>
Tree<K> build(const mesh::View& mesh, Workshop work, typename K::Node* nodes, uint32_t* middle) {
  const uint32_t count = mesh.nodes().size();
  put_ranges(mesh, work.ranges);
  for (uint32_t n = 0; n < count; ++n)
    for (uint32_t slot = 0; slot < 2; ++slot) {
      const Range range = work.ranges[2 * n + slot];
      put_box(mesh, n, slot, range, nodes[n].box[slot]);
      nodes[n].child[slot] = mesh.nodes()[n].side[slot].child;
      middle[2 * n + slot] =
          nearest_vertex(mesh, range, centre_of(mesh.head(), nodes[n].box[slot]));
    }
  return {&mesh, {nodes, count}, {middle, 2 * count}};
}

/// A tree of four ways: each node takes the place of a binary one and of those of its children that
/// are nodes. `nodes` and `middle` hold as many as the mesh has nodes, and four times.
inline Tree<WideKind> build_wide(const mesh::View& mesh, Workshop work, WideKind::Node* nodes,
                                 uint32_t* middle) {
  put_ranges(mesh, work.ranges);
  uint32_t count = 1;
  work.sources[0] = 0;
  for (uint32_t n = 0; n < count; ++n) {
    WideKind::Node& node = nodes[n];
    uint32_t ways = 0;
    const auto add = [&](uint32_t from, uint32_t slot) {
      put_box(mesh, from, slot, {}, node.box[ways]);
      middle[4 * n + ways] = nearest_vertex(mesh, work.ranges[2 * from + slot],
                                            centre_of(mesh.head(), node.box[ways]));
      const uint32_t child = mesh.nodes()[from].side[slot].child;
      node.child[ways++] = mesh::is_leaf(child) ? child : count;
      if (!mesh::is_leaf(child)) work.sources[count++] = child;
    };
    const uint32_t source = work.sources[n];
    for (uint32_t slot = 0; slot < 2; ++slot) {
      const uint32_t child = mesh.nodes()[source].side[slot].child;
      if (mesh::is_leaf(child)) {
        add(source, slot);
      } else {
        add(child, 0);
        add(child, 1);
      }
    }
    for (; ways < 4; ++ways)
      node.child[ways] = kNoChild, node.box[ways] = node.box[0],
      middle[4 * n + ways] = middle[4 * n];
  }
  return {&mesh, {nodes, count}, {middle, 4 * count}};
}

}  // namespace firmtouch::lab::orders
