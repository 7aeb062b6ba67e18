#pragma once
// A cube of 12 triangles as an asset, built by hand without the baker and without heap: its
// distances, sides and normals have closed forms, and a rule can be broken in it.
#include <stdint.h>

#include "firmtouch/mesh/view.hpp"
#include "harness/rules.hpp"

namespace firmtouch::mesh_test {

using test::bytes;

struct Cube {
  static constexpr uint32_t kVertices = 8, kTriangles = 12, kNodes = 5;
  mesh::Head head{};
  mesh::Vertex vertices[kVertices];
  mesh::Triangle<uint16_t> triangles[kTriangles];
  mesh::Node nodes[kNodes];
  uint32_t parents[kNodes];
  uint32_t normals[kVertices];
  mesh::EdgeFolds folds[kTriangles];

  /// Half a side from each face to the centre at the origin. Nodes depth first, as the baker has
  /// them, or breadth first.
  explicit Cube(float half_m = 1.0f, bool is_breadth_first = false) {
    for (uint32_t v = 0; v < kVertices; ++v) {
      const float s[3] = {sign(v, 0), sign(v, 1), sign(v, 2)};
      vertices[v] = {s[0] * half_m, s[1] * half_m, s[2] * half_m};
      normals[v] = corner_normal(s);
    }
    make_head(half_m);
    make_triangles();
    is_breadth_first ? make_tree_breadth_first() : make_tree();
    make_boxes();
  }

  mesh::Sections sections() const {
    mesh::Sections s;
    s.head = bytes(&head, sizeof head);
    s.vertices = bytes(vertices, sizeof vertices);
    s.triangles16 = bytes(triangles, sizeof triangles);
    s.nodes = bytes(nodes, sizeof nodes);
    s.parents = bytes(parents, sizeof parents);
    s.vertex_normals = bytes(normals, sizeof normals);
    s.edge_folds = bytes(folds, sizeof folds);
    return s;
  }
  mesh::View view() const { return test::opened<mesh::View>(sections()); }

 private:
  static float sign(uint32_t vertex, uint32_t axis) { return (vertex >> axis) & 1u ? 1.0f : -1.0f; }

  // (+-1, +-1, +-1) / sqrt 3 in octahedral form: a third along each axis, folded where z is below.
  static uint32_t corner_normal(const float* s) {
    const float third = 1.0f / 3.0f, u = s[2] > 0 ? third : 1 - third;
    const auto code = [](float x) { return static_cast<uint32_t>(x * 32767.0f + 32767.5f); };
    return code(s[0] * u) | code(s[1] * u) << 16;
  }

  void make_head(float half_m) {
    head.vertex_count = kVertices;
    head.triangle_count = kTriangles;
    head.node_count = kNodes;
    head.is_signed = 1;
    head.cell_m = 0x1p-40f;
    while (head.cell_m * 32000.0f < 2.5f * half_m) head.cell_m *= 2.0f;
    for (uint32_t k = 0; k < 3; ++k) {
      head.low_m[k] = -half_m;
      head.high_m[k] = half_m;
      head.grid_low_m[k] = -head.cell_m * 16384.0f;
    }
    head.diagonal_m = 3.4641f * half_m;
    head.longest_edge_m = 2.8285f * half_m;
  }

  // Two triangles a side; edge 0 is the side's diagonal (no fold), the other two are the cube's
  // edges (a right angle).
  void make_triangles() {
    uint32_t count = 0;
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t up = 0; up < 2; ++up) {
        const uint16_t base = static_cast<uint16_t>(up << axis);
        const uint16_t u = static_cast<uint16_t>(1u << (axis + 1) % 3);
        const uint16_t v = static_cast<uint16_t>(1u << (axis + 2) % 3);
        const uint16_t corner[4] = {base, static_cast<uint16_t>(base + u),
                                    static_cast<uint16_t>(base + u + v),
                                    static_cast<uint16_t>(base + v)};
        for (uint32_t half = 0; half < 2; ++half) {
          const uint16_t a = corner[half ? 0 : 2], b = corner[half ? 2 : 0],
                         c = corner[half ? 3 : 1];
          triangles[count] = {{a, b, c}};
          if (up == 0) triangles[count] = {{b, a, c}};
          folds[count++] = {{0, 64, 64}};
        }
      }
  }

  // Root, two inner nodes, two of theirs: leaves of 2, 2, 2, 2, 2 and 2 triangles.
  void make_tree() {
    nodes[0].side[0].child = 1, nodes[0].side[1].child = 3;
    nodes[1].side[0].child = 2, nodes[1].side[1].child = mesh::make_leaf(0, 2);
    nodes[2].side[0].child = mesh::make_leaf(2, 2), nodes[2].side[1].child = mesh::make_leaf(4, 2);
    nodes[3].side[0].child = mesh::make_leaf(6, 2), nodes[3].side[1].child = 4;
    nodes[4].side[0].child = mesh::make_leaf(8, 2), nodes[4].side[1].child = mesh::make_leaf(10, 2);
    make_parents();
  }

  void make_tree_breadth_first() {
    nodes[0].side[0].child = 1, nodes[0].side[1].child = 2;
    nodes[1].side[0].child = 3, nodes[1].side[1].child = mesh::make_leaf(0, 2);
    nodes[2].side[0].child = mesh::make_leaf(2, 2), nodes[2].side[1].child = 4;
    nodes[3].side[0].child = mesh::make_leaf(4, 2), nodes[3].side[1].child = mesh::make_leaf(6, 2);
    nodes[4].side[0].child = mesh::make_leaf(8, 2), nodes[4].side[1].child = mesh::make_leaf(10, 2);
    make_parents();
  }

  // Of a tree whose nodes stand behind their parents.
  void make_parents() {
    uint32_t depth[kNodes] = {};
    for (uint32_t n = 0; n < kNodes; ++n)
      for (uint32_t which = 0; which < 2; ++which) {
        const uint32_t child = nodes[n].side[which].child;
        if (mesh::is_leaf(child)) continue;
        depth[child] = depth[n] + 1;
        parents[child] = mesh::make_parent(n, which, depth[child]);
      }
    parents[0] = 0;
    head.depth = 3;
  }

  void make_boxes() {
    for (uint32_t n = kNodes; n-- > 0;)
      for (uint32_t which = 0; which < 2; ++which) make_box(n, which);
  }

  void make_box(uint32_t n, uint32_t which) {
    uint32_t low[3] = {40000, 40000, 40000}, high[3] = {0, 0, 0};
    const uint32_t child = nodes[n].side[which].child;
    const auto grow = [&](uint32_t k, uint32_t from, uint32_t to) {
      low[k] = from < low[k] ? from : low[k];
      high[k] = to > high[k] ? to : high[k];
    };
    for (uint32_t k = 0; k < 3; ++k) {
      if (!mesh::is_leaf(child)) {
        for (const mesh::Side& side : nodes[child].side)
          grow(k, side.box[k] & 0xFFFFu, mesh::kGridMax - (side.box[k] >> 16));
        continue;
      }
      for (uint32_t t = mesh::leaf_first(child);
           t < mesh::leaf_first(child) + mesh::leaf_count(child); ++t)
        for (const uint16_t corner : triangles[t].corner) {
          const float cells = ((&vertices[corner].x_m)[k] - head.grid_low_m[k]) / head.cell_m;
          grow(k, static_cast<uint32_t>(cells) - 1, static_cast<uint32_t>(cells) + 2);
        }
    }
    for (uint32_t k = 0; k < 3; ++k)
      nodes[n].side[which].box[k] = low[k] | (mesh::kGridMax - high[k]) << 16;
  }
};

}  // namespace firmtouch::mesh_test
