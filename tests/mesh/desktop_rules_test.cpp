// The reject rules of what a mesh holds for a desktop, each condition tripped alone.
#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/triangle_shape.hpp"
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using mesh_test::Cube;
using mesh_test::refusal_of;
using mesh_test::shorter;

struct DesktopCube {
  static constexpr uint32_t kFloats = mesh::kRowsOfLeaf * Cube::kTriangles + mesh::kRowsEnd;
  Cube cube;
  static constexpr uint32_t kShapeFloats = mesh::kRowsOfShapes * Cube::kTriangles + mesh::kRowsEnd;
  float rows[kFloats] = {};
  float shape_rows[kShapeFloats] = {};
  mesh::Vertex directions[mesh::kFeatures * Cube::kTriangles];

  DesktopCube() {
    for (const mesh::Node& node : cube.nodes)
      for (const mesh::Side& side : node.side)
        if (mesh::is_leaf(side.child)) put_leaf(side.child);
    const mesh::View view = cube.view();
    for (uint32_t i = 0; i < mesh::kFeatures * Cube::kTriangles; ++i) {
      const math::Vec3 d = mesh::decoded_direction(view, i / mesh::kFeatures,
                                                   static_cast<mesh::Feature>(i % mesh::kFeatures));
      directions[i] = {d.x, d.y, d.z};
    }
  }
  mesh::Sections sections() const {
    mesh::Sections s = cube.sections();
    s.rows = {reinterpret_cast<const uint8_t*>(rows), sizeof rows};
    s.shape_rows = {reinterpret_cast<const uint8_t*>(shape_rows), sizeof shape_rows};
    s.directions = {reinterpret_cast<const uint8_t*>(directions), sizeof directions};
    return s;
  }

 private:
  void put_leaf(uint32_t leaf) {
    const uint32_t first = mesh::leaf_first(leaf), count = mesh::leaf_count(leaf);
    for (uint32_t i = 0; i < count; ++i) {
      math::Vec3 corner[3];
      float* row = rows + mesh::kRowsOfLeaf * first + i;
      for (uint32_t k = 0; k < 3; ++k) {
        const mesh::Vertex& v = cube.vertices[cube.triangles[first + i].corner[k]];
        corner[k] = {v.x_m, v.y_m, v.z_m};
        const float axes[] = {v.x_m, v.y_m, v.z_m};
        for (const float axis : axes) *row = axis, row += count;
      }
      float shape[mesh::kRowsOfShapes];
      mesh::put_rows(mesh::shape_of(corner[0], corner[1], corner[2]), shape);
      for (uint32_t k = 0; k < mesh::kRowsOfShapes; ++k)
        shape_rows[mesh::kRowsOfShapes * first + k * count + i] = shape[k];
    }
  }
};

// A section that is not whole, or not there: each time the same verdict.
template <size_t kCuts>
void check_cuts(firmtouch::core::Bytes mesh::Sections::*section, const uint32_t (&cuts)[kCuts],
                uint32_t refusal) {
  const DesktopCube cube;
  for (const uint32_t cut : cuts) {
    mesh::Sections s = cube.sections();
    s.*section = shorter(s.*section, cut);
    CHECK_EQ(refusal_of(s), refusal);
  }
}

float next_float(float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  ++bits;
  __builtin_memcpy(&value, &bits, sizeof bits);
  return value;
}

}  // namespace

TEST(WhatIsThereForADesktopMayBeThereOrNot) {
  const DesktopCube cube;
  CHECK_EQ(refusal_of(cube.sections()), 0u);
  mesh::Sections s = cube.sections();
  s.rows = {};
  s.shape_rows = {};
  CHECK_EQ(refusal_of(s), 0u);
  s.directions = {};
  CHECK_EQ(refusal_of(s), 0u);
}

TEST(R132RowsNotOfThisMesh) {
  check_cuts(&mesh::Sections::rows, {1, 4, DesktopCube::kFloats * 4 - 1}, 132'000u);
}

TEST(R132RowsThatDoNotEndInZeros) {
  for (uint32_t i = 1; i <= mesh::kRowsEnd; ++i) {
    DesktopCube cube;
    cube.rows[DesktopCube::kFloats - i] = -0.0f;
    CHECK_EQ(refusal_of(cube.sections()), 132'001u);
  }
}

TEST(R133RowThatIsNotOfTheCorners) {
  for (uint32_t i = 0; i < mesh::kRowsOfLeaf * Cube::kTriangles; ++i) {
    DesktopCube cube;
    cube.rows[i] = next_float(cube.rows[i]);
    CHECK_EQ(refusal_of(cube.sections()) / 1000, 133u);
  }
  DesktopCube cube;
  cube.rows[0] = next_float(cube.rows[0]);
  CHECK_EQ(refusal_of(cube.sections()), 133'000u);
}

TEST(R142ShapesSideBySideNotThereWithTheRowsOrNotOfThisMesh) {
  const DesktopCube cube;
  mesh::Sections s = cube.sections();
  s.rows = {};
  CHECK_EQ(refusal_of(s), 142'000u);
  check_cuts(&mesh::Sections::shape_rows, {1, 4, 48, DesktopCube::kShapeFloats * 4}, 142'000u);
}

TEST(R142ShapesSideBySideThatDoNotEndInZeros) {
  for (uint32_t i = 1; i <= mesh::kRowsEnd; ++i) {
    DesktopCube cube;
    cube.shape_rows[DesktopCube::kShapeFloats - i] = -0.0f;
    CHECK_EQ(refusal_of(cube.sections()), 142'001u);
  }
}

TEST(R143ShapeSideBySideThatIsNotOfItsCorners) {
  for (uint32_t i = 0; i < mesh::kRowsOfShapes * Cube::kTriangles; ++i) {
    DesktopCube cube;
    cube.shape_rows[i] = next_float(cube.shape_rows[i]);
    CHECK_EQ(refusal_of(cube.sections()) / 1000, 143u);
  }
}

TEST(R134DirectionsNotOfThisMesh) { check_cuts(&mesh::Sections::directions, {1, 4, 12}, 134'000u); }

TEST(R135DirectionThatIsNotWhatIsStored) {
  for (uint32_t i = 0; i < mesh::kFeatures * Cube::kTriangles; ++i) {
    float mesh::Vertex::*const axes[] = {&mesh::Vertex::x_m, &mesh::Vertex::y_m,
                                         &mesh::Vertex::z_m};
    for (float mesh::Vertex::*const axis : axes) {
      DesktopCube cube;
      cube.directions[i].*axis = next_float(cube.directions[i].*axis);
      CHECK_EQ(refusal_of(cube.sections()), 135'000u + i / mesh::kFeatures);
    }
  }
}
