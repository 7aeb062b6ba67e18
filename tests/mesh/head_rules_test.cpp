// The reject rules of a mesh's head and of the sizes of its sections, each condition tripped alone.
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// A cube, something in whose head is changed.
template <class Change>
uint32_t refusal_with(Change change) {
  Cube cube;
  change(cube.head);
  return refusal_of(cube);
}

}  // namespace

TEST(WholeCubePasses) { CHECK_EQ(refusal_of(Cube()), 0u); }

TEST(CubesOfManySizesPass) {
  CHECK_EQ(refusal_of(Cube(0x1p-20f)), 0u);
  CHECK_EQ(refusal_of(Cube(0.99e7f)), 0u);
}

TEST(R101HeadOfTheWrongSize) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.head = shorter(s.head, 4);
  CHECK_EQ(refusal_of(s), 101'000u);
  s.head = {};
  CHECK_EQ(refusal_of(s), 101'000u);
}

TEST(R102VerticesDoNotMatchTheirCount) {
  Cube cube;
  mesh::Sections s = cube.sections();
  s.vertices = shorter(s.vertices, 12);
  CHECK_EQ(refusal_of(s), 102'000u);
  s.vertices = {};
  cube.head.vertex_count = 0;
  CHECK_EQ(refusal_of(s), 102'000u);
}

TEST(R103TriangleSectionsAreNotExactlyOne) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.triangles32 = s.triangles16;
  CHECK_EQ(refusal_of(s), 103'000u);
  s.triangles16 = s.triangles32 = {};
  CHECK_EQ(refusal_of(s), 103'000u);
}

TEST(R103TrianglesDoNotMatchTheirCount) {
  Cube cube;
  mesh::Sections s = cube.sections();
  s.triangles16 = shorter(s.triangles16, 6);
  CHECK_EQ(refusal_of(s), 103'001u);
  s.triangles16 = {s.triangles16.data(), 3};  // there, and no triangle
  cube.head.triangle_count = 0;
  CHECK_EQ(refusal_of(s), 103'001u);
  // Sizes are checked before anything is read.
  s.triangles16 = {s.triangles16.data(), (mesh::kMaxTriangles + 1) * 6};
  cube.head.triangle_count = mesh::kMaxTriangles + 1;
  CHECK_EQ(refusal_of(s), 103'001u);
}

TEST(R104NodesDoNotMatchTheirCount) {
  Cube cube;
  mesh::Sections s = cube.sections();
  s.parents = shorter(s.parents, 4);
  CHECK_EQ(refusal_of(s), 104'000u);
  s = cube.sections();
  s.nodes = shorter(s.nodes, 32);
  CHECK_EQ(refusal_of(s), 104'000u);
  s.nodes = s.parents = {};
  cube.head.node_count = 0;
  CHECK_EQ(refusal_of(s), 104'000u);
  s = cube.sections();
  s.nodes = {s.nodes.data(), (mesh::kMaxNodes + 1) * 32};
  s.parents = {s.parents.data(), (mesh::kMaxNodes + 1) * 4};
  s.edge_folds = {};  // so that nothing is read where this rule is missing
  cube.head.node_count = mesh::kMaxNodes + 1;
  CHECK_EQ(refusal_of(s), 104'000u);
}

TEST(R105SignDataMissing) {
  const Cube cube;
  mesh::Sections s = cube.sections();
  s.edge_folds = shorter(s.edge_folds, 3);
  CHECK_EQ(refusal_of(s), 105'000u);
  s.edge_folds = {};
  CHECK_EQ(refusal_of(s), 105'000u);
  s = cube.sections();
  s.vertex_normals = shorter(s.vertex_normals, 4);
  CHECK_EQ(refusal_of(s), 105'000u);
}

TEST(R105SignDataOfAnUnsignedMesh) {
  Cube cube;
  cube.head.is_signed = 0;
  CHECK_EQ(refusal_of(cube), 105'000u);
  const mesh::Sections whole = cube.sections();
  mesh::Sections s = whole;
  s.vertex_normals = s.edge_folds = {};
  CHECK_EQ(refusal_of(s), 0u);
  s.vertex_normals = {whole.vertex_normals.data(), 3};  // there, and no normal
  CHECK_EQ(refusal_of(s), 105'000u);
  s.vertex_normals = {};
  s.edge_folds = {whole.edge_folds.data(), 2};
  CHECK_EQ(refusal_of(s), 105'000u);
  s.edge_folds = {};
  cube.head.is_signed = 2;
  CHECK_EQ(refusal_of(s), 105'000u);
}

TEST(R106ReservedWordAndCell) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.rounding_m = 1; }), 106'000u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m *= 1.5f; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = -h.cell_m; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = 0x1p-96f; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = 0x1p66f; }), 106'001u);
}

TEST(R106BoxInvertedOrTooFar) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[1] = quiet_nan(); }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.high_m[2] = quiet_nan(); }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[1] = 1, h.high_m[1] = -1; }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[0] = -1.01e7f; }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.high_m[2] = 1.01e7f; }), 106'002u);
}

TEST(R106GridLeavesTooLittleFree) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[2] += 0.9f; }), 106'003u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[0] -= 0.9f; }), 106'003u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[1] = quiet_nan(); }), 106'003u);
}

TEST(R106GridTooWideOrExtentTooSmall) {
  const auto twice_the_grid = [](mesh::Head& h) {
    h.cell_m *= 2.0f;
    for (float& low_m : h.grid_low_m) low_m *= 2.0f;
  };
  CHECK_EQ(refusal_with(twice_the_grid), 106'004u);
  Cube dust(0.4e-9f);  // 0.8e-9 m, on a grid that fits it
  dust.head.cell_m = 0x1p-44f;
  for (float& low_m : dust.head.grid_low_m) low_m = -0x1p-30f;
  CHECK_EQ(refusal_of(dust), 106'004u);
}

TEST(R106DiagonalNotTheBoxs) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.diagonal_m *= 1.000001f; }), 106'005u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.diagonal_m *= 0.999999f; }), 106'005u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.diagonal_m = quiet_nan(); }), 106'005u);
}

TEST(R106LongestEdgeOutOfRange) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = 0; }), 106'006u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = 1.002f * 3.4642f; }), 106'006u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = quiet_nan(); }), 106'006u);
}

TEST(R107DepthOutOfRange) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.depth = 0; }), 107'000u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.depth = mesh::kMaxDepth + 1; }), 107'000u);
}
