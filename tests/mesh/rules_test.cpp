// Every reject rule of a mesh, each tripped alone by one planted defect.
#include "cube.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using mesh_test::Cube;

uint16_t rule_of(const mesh::Sections& sections) {
  mesh::View view;
  const core::Verdict verdict = mesh::open(sections, view);
  CHECK_EQ(verdict.ok(), view.is_open());
  return verdict.rule;
}
uint16_t rule_of(const Cube& cube) { return rule_of(cube.sections()); }

core::Bytes shorter(core::Bytes bytes, uint32_t by) { return {bytes.data(), bytes.size() - by}; }

float not_a_number() {
  const uint32_t bits = 0x7FC00000;
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

TEST(WholeCubePasses) { CHECK_EQ(rule_of(Cube()), 0); }

TEST(R101HeadOfTheWrongSize) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.head = shorter(s.head, 4);
  CHECK_EQ(rule_of(s), 101);
}

TEST(R102VerticesDoNotMatchTheirCount) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.vertices = shorter(s.vertices, 12);
  CHECK_EQ(rule_of(s), 102);
}

TEST(R103TrianglesDoNotMatchTheirCount) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.triangles16 = shorter(s.triangles16, 6);
  CHECK_EQ(rule_of(s), 103);
  s = cube.sections();
  s.triangles32 = s.triangles16;  // both widths at once
  CHECK_EQ(rule_of(s), 103);
}

TEST(R104NodesDoNotMatchTheirCount) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.parents = shorter(s.parents, 4);
  CHECK_EQ(rule_of(s), 104);
}

TEST(R105SignDataMissing) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.edge_folds = {};
  CHECK_EQ(rule_of(s), 105);
  Cube unsigned_cube;
  unsigned_cube.head.is_signed = 0;
  CHECK_EQ(rule_of(unsigned_cube), 105);
}

TEST(R106HeadOutOfRange) {
  Cube cube;
  cube.head.reserved[1] = 1;
  CHECK_EQ(rule_of(cube), 106);
  cube = Cube();
  cube.head.cell_m *= 1.5f;
  CHECK_EQ(rule_of(cube), 106);
  cube = Cube();
  cube.head.low_m[1] = not_a_number();
  CHECK_EQ(rule_of(cube), 106);
  cube = Cube();
  cube.head.grid_low_m[2] += 0.9f;
  CHECK_EQ(rule_of(cube), 106);
  cube = Cube();
  cube.head.diagonal_m *= 1.01f;
  CHECK_EQ(rule_of(cube), 106);
}

TEST(R107DepthNotTheTrees) {
  Cube cube;
  cube.head.depth = 4;
  CHECK_EQ(rule_of(cube), 107);
  cube.head.depth = mesh::kMaxDepth + 1;
  CHECK_EQ(rule_of(cube), 107);
}

TEST(R110VertexOutsideTheBox) {
  Cube cube;
  cube.vertices[3].y_m = not_a_number();
  CHECK_EQ(rule_of(cube), 110);
}

TEST(R111BoxNotTight) {
  Cube cube;
  cube.head.high_m[0] = 1.0000001f;
  CHECK_EQ(rule_of(cube), 111);
}

TEST(R112NormalOutOfRange) {
  Cube cube;
  cube.normals[2] |= 0xFFFFu;
  CHECK_EQ(rule_of(cube), 112);
}

TEST(R120BoxInsideOut) {
  Cube cube;
  cube.nodes[2].box[1][0] = 30000u | (mesh::kGridMax - 20000u) << 16;
  CHECK_EQ(rule_of(cube), 120);
}

TEST(R121ChildLeavesItsParentsBox) {
  Cube cube;
  cube.nodes[0].box[0][1] += 40;
  CHECK_EQ(rule_of(cube), 121);
}

TEST(R122ChildIsNotTheNodesOwn) {
  Cube cube;
  cube.nodes[1].child[0] = 4;
  CHECK_EQ(rule_of(cube), 122);
  cube.nodes[1].child[0] = 1;  // itself
  CHECK_EQ(rule_of(cube), 122);
  cube.nodes[1].child[0] = 99;
  CHECK_EQ(rule_of(cube), 122);
}

TEST(R123ParentIsNotTheNodesOwn) {
  Cube cube;
  cube.parents[0] = 1;
  CHECK_EQ(rule_of(cube), 123);
}

TEST(R124LeafOutOfOrder) {
  Cube cube;
  cube.nodes[1].child[1] = mesh::make_leaf(1, 2);
  CHECK_EQ(rule_of(cube), 124);
  cube.nodes[1].child[1] = mesh::make_leaf(0, 0);
  CHECK_EQ(rule_of(cube), 124);
}

TEST(R125TrianglesLeftOver) {
  Cube cube;
  cube.nodes[4].child[1] = mesh::make_leaf(10, 1);
  CHECK_EQ(rule_of(cube), 125);
}

TEST(R126CornerIsNoVertex) {
  Cube cube;
  cube.triangles[7].corner[2] = 8;
  CHECK_EQ(rule_of(cube), 126);
}

TEST(R127TriangleLeavesItsLeafsBox) {
  Cube cube;
  cube.nodes[4].box[1][1] += 40;
  CHECK_EQ(rule_of(cube), 127);
}

TEST(R128LongestEdgeIsNotFirst) {
  Cube cube;
  const mesh::Triangle<uint16_t> t = cube.triangles[5];
  cube.triangles[5] = {{t.corner[1], t.corner[2], t.corner[0]}};
  CHECK_EQ(rule_of(cube), 128);
}

TEST(R129TriangleWithoutArea) {
  Cube cube;
  cube.triangles[5].corner[2] = cube.triangles[5].corner[0];
  CHECK_EQ(rule_of(cube), 129);
}

TEST(R130FoldOutOfRange) {
  Cube cube;
  cube.folds[11].fold[2] = -32768;
  CHECK_EQ(rule_of(cube), 130);
}

TEST(OpeningWorksInSlicesOfOne) {
  const Cube cube;
  mesh::Opening opening(cube.sections());
  uint32_t slices = 0;
  for (; !opening.done(); ++slices) opening.work(1);
  CHECK(opening.verdict().ok());
  CHECK(opening.view().is_open());
  CHECK_EQ(slices, 8u + 8u + 5u + 12u);
}
