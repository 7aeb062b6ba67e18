// The reject rules of a mesh's vertices, tree and triangles, each condition tripped alone.
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

constexpr uint32_t kHighUnit = 1u << 16;  // one cell less in the high half of a box's word

// A tree as deep as it has nodes: node k holds one triangle and node k + 1, the last one two
// triangles. Every box is the whole grid, whose words are 0.
struct Chain {
  static constexpr uint32_t kMaxNodes = mesh::kMaxDepth + 1;
  Cube cube;
  mesh::Triangle<uint16_t> triangles[kMaxNodes + 1];
  mesh::Node nodes[kMaxNodes];
  uint32_t parents[kMaxNodes];
  mesh::EdgeFolds folds[kMaxNodes + 1];

  explicit Chain(uint32_t node_count) {
    for (uint32_t t = 0; t <= node_count; ++t) {
      triangles[t] = cube.triangles[t % Cube::kTriangles];
      folds[t] = {{0, 0, 0}};
    }
    for (uint32_t n = 0; n < node_count; ++n) {
      nodes[n] = {};
      nodes[n].side[0].child = n + 1;
      nodes[n].side[1].child = mesh::make_leaf(n, 1);
      parents[n] = n == 0 ? 0 : mesh::make_parent(n - 1, 0, n);
    }
    nodes[node_count - 1].side[0].child = mesh::make_leaf(node_count - 1, 1);
    nodes[node_count - 1].side[1].child = mesh::make_leaf(node_count, 1);
    cube.head.node_count = node_count;
    cube.head.triangle_count = node_count + 1;
    cube.head.depth = node_count < mesh::kMaxDepth ? node_count : mesh::kMaxDepth;
  }
  mesh::Sections sections() const {
    mesh::Sections s = cube.sections();
    s.triangles16 = bytes(triangles, cube.head.triangle_count * 6);
    s.nodes = bytes(nodes, cube.head.node_count * 32);
    s.parents = bytes(parents, cube.head.node_count * 4);
    s.edge_folds = bytes(folds, cube.head.triangle_count * 3);
    return s;
  }
};

// A mesh of one node, whose boxes are the whole grid: seven triangles of the cube.
struct OneNode {
  Cube cube;
  OneNode(uint32_t first_child, uint32_t second_child) {
    cube.nodes[0] = {};
    cube.nodes[0].side[0].child = first_child;
    cube.nodes[0].side[1].child = second_child;
    cube.head.node_count = cube.head.depth = 1;
    cube.head.triangle_count = 7;
  }
  mesh::Sections sections() const {
    mesh::Sections s = cube.sections();
    s.nodes = shorter(s.nodes, 4 * 32);
    s.parents = shorter(s.parents, 4 * 4);
    s.triangles16 = shorter(s.triangles16, 5 * 6);
    s.edge_folds = shorter(s.edge_folds, 5 * 3);
    return s;
  }
};

// What is said of a mesh whose triangle 5 has these corners, in the plane z = 0.
uint32_t refusal_of_corners(float ax_m, float bx_m, float cx_m, float cy_m) {
  OneNode mesh(mesh::make_leaf(0, 7), mesh::make_leaf(7, 0));
  for (uint32_t t = 0; t < 7; ++t) mesh.cube.triangles[t] = {{1, 2, 0}};
  mesh.cube.triangles[5] = {{3, 5, 6}};
  mesh.cube.vertices[3] = {ax_m, 0, 0};
  mesh.cube.vertices[5] = {bx_m, 0, 0};
  mesh.cube.vertices[6] = {cx_m, cy_m, 0};
  return refusal_of(mesh.sections());
}

}  // namespace

TEST(R107DepthNotTheTrees) {
  Cube cube;
  cube.head.depth = 4;
  CHECK_EQ(refusal_of(cube), 107'002u);
  cube.head.depth = 2;
  CHECK_EQ(refusal_of(cube), 107'002u);
}

TEST(R107NodeTooDeep) {
  CHECK_EQ(refusal_of(Chain(mesh::kMaxDepth).sections()), 0u);
  Chain chain(mesh::kMaxDepth + 1);
  chain.nodes[mesh::kMaxDepth].side[1].child = mesh::make_leaf(41, 0);  // never looked at
  CHECK_EQ(refusal_of(chain.sections()), 107'040u);
}

TEST(R110VertexOutsideTheBox) {
  const float outside[] = {nan_value(), 1.5f, -1.5f};
  for (const float y_m : outside) {
    Cube cube;
    cube.vertices[3].y_m = y_m;
    CHECK_EQ(refusal_of(cube), 110'003u);
  }
}

TEST(R111BoxNotTight) {
  CHECK_EQ(cube_with([](Cube& c) { c.head.high_m[0] = 1.0000001f; }), 111'003u);
  CHECK_EQ(cube_with([](Cube& c) { c.head.low_m[2] = -1.0000001f; }), 111'002u);
}

TEST(R112NormalOutOfRange) {
  CHECK_EQ(cube_with([](Cube& c) { c.normals[2] |= 0xFFFFu; }), 112'002u);
  CHECK_EQ(cube_with([](Cube& c) { c.normals[7] |= 0xFFFF0000u; }), 112'007u);
}

TEST(R120BoxInsideOut) {
  const uint32_t inverted = 30000u | (mesh::kGridMax - 20000u) << 16;
  Cube cube;
  cube.nodes[2].side[1].box[0] = inverted;  // of a leaf
  CHECK_EQ(refusal_of(cube), 120'002u);
  cube.nodes[0].side[1].box[2] = inverted;  // of a node
  CHECK_EQ(refusal_of(cube), 120'000u);
}

TEST(R121ChildLeavesItsParentsBox) {
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[0].side[0].box[1] += 40; }), 121'001u);
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[0].side[1].box[2] += 40 * kHighUnit; }), 121'003u);
}

TEST(R122ChildIsNotTheNodesOwn) {
  const uint32_t children[] = {4, 1, 99};  // another's, itself, nobody
  for (const uint32_t child : children) {
    Cube cube;
    cube.nodes[1].side[0].child = child;
    CHECK_EQ(refusal_of(cube), 122'001u);
  }
  Cube cube;
  cube.parents[2] = mesh::make_parent(1, 0, 3);  // one level too deep
  CHECK_EQ(refusal_of(cube), 122'001u);
  Chain chain(5);
  chain.cube.head.node_count = 4;  // its child lies behind the section, all in order
  CHECK_EQ(refusal_of(chain.sections()), 122'003u);
}

TEST(R123RootWithAParent) {
  CHECK_EQ(cube_with([](Cube& c) { c.parents[0] = 1; }), 123'000u);
}

TEST(R123NodeThatIsNobodysChild) {
  Chain chain(6);
  chain.cube.head.node_count = chain.cube.head.depth = 5;
  for (uint32_t side = 0; side < 2; ++side) {
    chain.nodes[3].side[side].child = mesh::make_leaf(3 + side, 1);  // instead of node 4
    chain.nodes[4].side[side].child = mesh::make_leaf(5 + side, 1);
  }
  CHECK_EQ(refusal_of(chain.sections()), 123'003u);  // so many nodes are children
  chain.parents[4] = mesh::make_parent(4, 1, 4);     // its own parent and child
  chain.nodes[4].side[1].child = 4;
  CHECK_EQ(refusal_of(chain.sections()), 122'004u);
}

TEST(R124LeafOutOfOrder) {
  Cube cube;
  cube.nodes[1].side[1].child = mesh::make_leaf(1, 2);
  CHECK_EQ(refusal_of(cube), 124'001u);
  cube = Cube();
  cube.nodes[4].side[1].child = mesh::make_leaf(10, 3);  // one more than there are
  CHECK_EQ(refusal_of(cube), 124'004u);
}

TEST(R124LeafEmpty) {
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[1].side[1].child = mesh::make_leaf(0, 0); }), 124'001u);
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[2].side[0].child = mesh::make_leaf(2, 0); }), 124'002u);
  CHECK_EQ(refusal_of(OneNode(mesh::make_leaf(0, 7), mesh::make_leaf(7, 0)).sections()), 0u);
  CHECK_EQ(refusal_of(OneNode(mesh::make_leaf(0, 0), mesh::make_leaf(0, 7)).sections()), 124'000u);
}

TEST(R125TrianglesLeftOver) {
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[4].side[1].child = mesh::make_leaf(10, 1); }), 125'011u);
}

TEST(R126CornerIsNoVertex) {
  CHECK_EQ(cube_with([](Cube& c) { c.triangles[7].corner[2] = 8; }), 126'007u);
}

TEST(R127TriangleLeavesItsLeafsBox) {
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[4].side[1].box[1] += 40; }), 127'010u);
  CHECK_EQ(cube_with([](Cube& c) { c.nodes[4].side[1].box[0] += 40 * kHighUnit; }), 127'010u);
}

TEST(R128LongestEdgeIsNotFirst) {
  Cube cube;
  const mesh::Triangle<uint16_t> t = cube.triangles[5];
  cube.triangles[5] = {{t.corner[1], t.corner[2], t.corner[0]}};
  CHECK_EQ(refusal_of(cube), 128'005u);
  cube.triangles[5] = {{t.corner[2], t.corner[0], t.corner[1]}};
  CHECK_EQ(refusal_of(cube), 128'005u);
}

TEST(R128EdgeWithoutLength) {
  Cube cube;
  const uint16_t corner = cube.triangles[5].corner[0];
  cube.triangles[5] = {{corner, corner, corner}};
  CHECK_EQ(refusal_of(cube), 128'005u);
  CHECK_EQ(refusal_of_corners(0, 0.99e-12f, 0.5e-12f, 0.5e-12f), 128'005u);
  CHECK_EQ(refusal_of_corners(0, 1.01e-12f, 0.5e-12f, 0.5e-12f), 0u);
}

TEST(R129TriangleWithoutArea) {
  CHECK_EQ(cube_with([](Cube& c) { c.triangles[5].corner[2] = c.triangles[5].corner[0]; }),
           129'005u);
}

TEST(R129TriangleTooThin) {
  CHECK_EQ(refusal_of_corners(-0.5f, 0.5f, 0, 0.99e-10f), 129'005u);  // to its edge of 1 m
  CHECK_EQ(refusal_of_corners(-0.5f, 0.5f, 0, 1.01e-10f), 0u);
  CHECK_EQ(refusal_of_corners(-1e-9f, 1e-9f, 0, 0.99e-18f), 129'005u);  // in metres
  CHECK_EQ(refusal_of_corners(-1e-9f, 1e-9f, 0, 1.01e-18f), 0u);
}

TEST(R130FoldOutOfRange) {
  for (uint32_t i = 0; i < 3 * Cube::kTriangles; ++i) {
    Cube cube;
    cube.folds[i / 3].fold[i % 3] = -128;
    CHECK_EQ(refusal_of(cube), 130'000u + i / 3);
    cube.folds[i / 3].fold[i % 3] = -127;
    CHECK_EQ(refusal_of(cube), 0u);
    if (i >= 21) continue;
    OneNode mesh(mesh::make_leaf(0, 7), mesh::make_leaf(7, 0));  // 21 bytes are no words
    mesh.cube.folds[i / 3].fold[i % 3] = -128;
    CHECK_EQ(refusal_of(mesh.sections()), 130'000u + i / 3);
  }
}

TEST(R130FirstOfSeveralFoldsIsNamed) {
  Cube cube;
  cube.folds[3].fold[0] = 1;  // a byte that borrows where the one before is zero
  cube.folds[2].fold[2] = cube.folds[3].fold[1] = -128;
  CHECK_EQ(refusal_of(cube), 130'002u);
}

TEST(R131EdgeLongerThanTheHeadsLongest) {
  CHECK_EQ(cube_with([](Cube& c) { c.head.longest_edge_m = 2.828f; }), 131'000u);
}

TEST(OpeningWorksInSlicesOfOne) {
  const Cube cube;
  mesh::Opening opening(cube.sections());
  uint32_t slices = 0;
  for (; !opening.done(); ++slices) opening.work(1);
  CHECK(opening.verdict().ok());
  CHECK(opening.view().is_open());
  CHECK_EQ(slices, 8u + 9u + 5u);  // vertices, words of folds, nodes
}
