// The reject rules of a mesh's head and of the sizes of its sections, each condition tripped alone.
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// What open() says of a cube with a changed head.
template <class Change>
uint32_t refusal_with(Change change) {
  return cube_with([&](Cube& cube) { change(cube.head); });
}

// The same with changed sections; `change` may change the cube, too.
template <class Change>
uint32_t sections_with(Change change) {
  Cube cube;
  mesh::Sections sections = cube.sections();
  change(sections, cube);
  return refusal_of(sections);
}

}  // namespace

TEST(WholeCubePasses) { CHECK_EQ(refusal_of(Cube()), 0u); }

TEST(CubesOfManySizesPass) {
  CHECK_EQ(refusal_of(Cube(0x1p-20f)), 0u);
  CHECK_EQ(refusal_of(Cube(0.99e7f)), 0u);
}

TEST(R101HeadOfTheWrongSize) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.head = shorter(s.head, 4); }), 101'000u);
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.head = {}; }), 101'000u);
}

TEST(R102VerticesDoNotMatchTheirCount) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.vertices = shorter(s.vertices, 12); }), 102'000u);
  CHECK_EQ(sections_with([](auto& s, Cube& c) { s.vertices = {}, c.head.vertex_count = 0; }),
           102'000u);
}

TEST(R103TriangleSectionsAreNotExactlyOne) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.triangles32 = s.triangles16; }), 103'000u);
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.triangles16 = s.triangles32 = {}; }), 103'000u);
}

TEST(R103TrianglesDoNotMatchTheirCount) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.triangles16 = shorter(s.triangles16, 6); }),
           103'001u);
  // `bytes` of them are there.
  const auto with_count = [](uint32_t bytes, uint32_t count) {
    return sections_with([&](mesh::Sections& s, Cube& cube) {
      s.triangles16 = {s.triangles16.data(), bytes};
      cube.head.triangle_count = count;
    });
  };
  CHECK_EQ(with_count(3, 0), 103'001u);
  // Sizes are checked before anything is read.
  CHECK_EQ(with_count((mesh::kMaxTriangles + 1) * 6, mesh::kMaxTriangles + 1), 103'001u);
}

TEST(R104NodesDoNotMatchTheirCount) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.parents = shorter(s.parents, 4); }), 104'000u);
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.nodes = shorter(s.nodes, 32); }), 104'000u);
  CHECK_EQ(sections_with([](auto& s, Cube& c) { s.nodes = s.parents = {}, c.head.node_count = 0; }),
           104'000u);
  const auto too_many = [](mesh::Sections& s, Cube& cube) {
    s.nodes = {s.nodes.data(), (mesh::kMaxNodes + 1) * 32};
    s.parents = {s.parents.data(), (mesh::kMaxNodes + 1) * 4};
    s.edge_folds = {};  // so that nothing is read where this rule is missing
    cube.head.node_count = mesh::kMaxNodes + 1;
  };
  CHECK_EQ(sections_with(too_many), 104'000u);
}

TEST(R105SignDataMissing) {
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.edge_folds = shorter(s.edge_folds, 3); }),
           105'000u);
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.edge_folds = {}; }), 105'000u);
  CHECK_EQ(sections_with([](auto& s, Cube&) { s.vertex_normals = shorter(s.vertex_normals, 4); }),
           105'000u);
}

TEST(R105SignDataOfAnUnsignedMesh) {
  CHECK_EQ(cube_with([](Cube& c) { c.head.is_signed = 0; }), 105'000u);
  // So many bytes of normals and folds are there.
  const auto with_bytes = [](uint32_t is_signed, uint32_t normals, uint32_t folds) {
    return sections_with([&](mesh::Sections& s, Cube& cube) {
      cube.head.is_signed = is_signed;
      s.vertex_normals = {s.vertex_normals.data(), normals};
      s.edge_folds = {s.edge_folds.data(), folds};
    });
  };
  CHECK_EQ(with_bytes(0, 0, 0), 0u);
  CHECK_EQ(with_bytes(0, 3, 0), 105'000u);  // there, and no normal
  CHECK_EQ(with_bytes(0, 0, 2), 105'000u);
  CHECK_EQ(with_bytes(2, 0, 0), 105'000u);
}

TEST(R106ReservedWordAndCell) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.rounding_m = 1; }), 106'000u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m *= 1.5f; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = -h.cell_m; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = 0x1p-96f; }), 106'001u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.cell_m = 0x1p66f; }), 106'001u);
}

TEST(R106BoxInvertedOrTooFar) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[1] = nan_value(); }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.high_m[2] = nan_value(); }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[1] = 1, h.high_m[1] = -1; }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.low_m[0] = -1.01e7f; }), 106'002u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.high_m[2] = 1.01e7f; }), 106'002u);
}

TEST(R106GridLeavesTooLittleFree) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[2] += 0.9f; }), 106'003u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[0] -= 0.9f; }), 106'003u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.grid_low_m[1] = nan_value(); }), 106'003u);
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
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.diagonal_m = nan_value(); }), 106'005u);
}

TEST(R106LongestEdgeOutOfRange) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = 0; }), 106'006u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = 1.002f * 3.4642f; }), 106'006u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.longest_edge_m = nan_value(); }), 106'006u);
}

TEST(R107DepthOutOfRange) {
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.depth = 0; }), 107'000u);
  CHECK_EQ(refusal_with([](mesh::Head& h) { h.depth = mesh::kMaxDepth + 1; }), 107'000u);
}
