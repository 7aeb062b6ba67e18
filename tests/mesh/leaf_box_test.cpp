// Boxes of leaves: the reject rules, each condition tripped alone, and a cube's answers.
#include "firmtouch/mesh/leaf_box.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using mesh_test::Cube;
using mesh_test::refusal_of;
using mesh_test::shorter;

constexpr uint32_t kLeaves = Cube::kTriangles / 2;

// About each side of the cube, its two triangles, a box turned by half a right angle.
struct BoxedCube {
  static constexpr uint32_t kWords = mesh::kLeafBoxStride * Cube::kTriangles + mesh::kLeafBoxesEnd;
  Cube cube;
  uint32_t words[kWords] = {};

  BoxedCube() {
    for (uint32_t leaf = 0; leaf < kLeaves; ++leaf) put_box(leaf);
    words[kWords - mesh::kLeafBoxesEnd] = mesh::kNoLeafBox;
    words[kWords - mesh::kLeafBoxesEnd + 1] = mesh::kNoLeafBox;
  }
  uint32_t* box(uint32_t leaf) { return words + mesh::kLeafBoxWords * leaf; }
  void set_axis(uint32_t leaf, uint32_t axis, uint32_t i, int32_t component) {
    uint32_t& word = box(leaf)[i < 2 ? 4 + axis : axis < 2 ? 7 : 3];
    const bool is_high = i < 2 ? i == 1 : axis != 0;
    word = is_high ? pair_of(static_cast<int32_t>(word), component)
                   : pair_of(component, static_cast<int32_t>(word >> 16));
  }
  mesh::Sections sections() const {
    mesh::Sections s = cube.sections();
    s.leaf_boxes = {reinterpret_cast<const uint8_t*>(words), sizeof words};
    return s;
  }

 private:
  static uint32_t pair_of(int32_t low, int32_t high) {
    return (static_cast<uint32_t>(low) & 0xFFFFu) | static_cast<uint32_t>(high) << 16;
  }
  void put_box(uint32_t leaf) {
    constexpr int32_t kLong = 32760, kSlant = 23164;
    int32_t axes[3][3] = {};
    const uint32_t across = leaf / 2, u = (across + 1) % 3, v = (across + 2) % 3;
    axes[0][u] = axes[0][v] = kSlant;
    axes[1][u] = kSlant, axes[1][v] = -kSlant;
    axes[2][across] = kLong;
    int32_t centre[3] = {};  // the grid's middle is the cube's
    const int32_t side = static_cast<int32_t>(2.0f * cube.head.high_m[across] / cube.head.cell_m);
    centre[across] = leaf % 2 == 0 ? -side : side;
    uint32_t* const to = box(leaf);
    to[2] = pair_of(centre[0], centre[1]);
    to[3] = pair_of(centre[2], axes[2][2]);
    for (int k = 0; k < 3; ++k) to[4 + k] = pair_of(axes[k][0], axes[k][1]);
    to[7] = pair_of(axes[0][2], axes[1][2]);
    // The shortest that hold: one axis after the other, the others as long as may be.
    int32_t half[3] = {0xFFFF, 0xFFFF, 0xFFFF};
    for (int k = 0; k < 3; ++k) {
      int32_t below = -1;
      while (half[k] - below > 1) {
        const int32_t whole = half[k], middle = (whole + below) / 2;
        half[k] = middle;
        to[0] = pair_of(half[0], half[1]);
        to[1] = pair_of(0xFFFF, half[2]);
        if (!is_held(leaf)) half[k] = whole, below = middle;
      }
    }
    to[0] = pair_of(half[0], half[1]);
    to[1] = pair_of(0xFFFF, half[2]);
  }
  bool is_held(uint32_t leaf) {
    const mesh::LeafBox found(box(leaf));
    for (uint32_t t = 2 * leaf; t < 2 * leaf + 2; ++t)
      for (const uint16_t corner : cube.triangles[t].corner) {
        const mesh::Vertex& v = cube.vertices[corner];
        const float per_cell = 1.0f / cube.head.cell_m;
        if (!found.holds({(v.x_m - cube.head.grid_low_m[0]) * per_cell,
                          (v.y_m - cube.head.grid_low_m[1]) * per_cell,
                          (v.z_m - cube.head.grid_low_m[2]) * per_cell},
                         mesh::kErrorHalfCells))
          return false;
      }
    return true;
  }
};

// Points within two half sides of the cube's centre.
class RandomLeaf {
 public:
  math::Vec3 point() {
    const float x = next(), y = next();
    return {x, y, next()};
  }

 private:
  float next() {
    seed_ ^= seed_ << 13, seed_ ^= seed_ >> 17, seed_ ^= seed_ << 5;
    return static_cast<float>(static_cast<int32_t>(seed_ >> 8) - (1 << 23)) * 0x1p-22f;
  }
  uint32_t seed_ = 3;
};

}  // namespace

TEST(BoxesOfLeavesMayBeThereOrNot) {
  const BoxedCube cube;
  CHECK_EQ(refusal_of(cube.sections()), 0u);
  mesh::View with;
  CHECK(mesh::open(cube.sections(), with).ok());
  CHECK(with.leaf_boxes() != nullptr);
  CHECK(cube.cube.view().leaf_boxes() == nullptr);
}

TEST(BoxesOfLeavesChangeNoBitOfACubesAnswers) {
  const BoxedCube cube;
  mesh::View with;
  CHECK(mesh::open(cube.sections(), with).ok());
  constexpr uint32_t kPoints = 600;
  query::ProbePoint points[kPoints];
  RandomLeaf random;
  for (query::ProbePoint& point : points) {
    const math::Vec3 p = random.point();
    point = {p.x, p.y, p.z};
  }
  const core::Span<const query::ProbePoint> all(points, kPoints);
  CHECK_EQ(mesh::probe_hash(with, all), mesh::probe_hash(cube.cube.view(), all));
}

TEST(R136BoxesNotOfThisMesh) {
  const BoxedCube cube;
  const uint32_t cuts[] = {1, 4, 16, 32};
  for (const uint32_t cut : cuts) {
    mesh::Sections s = cube.sections();
    s.leaf_boxes = shorter(s.leaf_boxes, cut);
    CHECK_EQ(refusal_of(s), 136'000u);
  }
}

TEST(R136_BoxesWithoutTheLastEmptyOne) {
  for (uint32_t i = 1; i <= mesh::kLeafBoxesEnd; ++i) {
    BoxedCube cube;
    cube.words[BoxedCube::kWords - i] ^= 1u;
    CHECK_EQ(refusal_of(cube.sections()), 136'001u);
  }
}

TEST(R137_HalfAnEmptyBox) {
  for (uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
    BoxedCube cube;
    cube.box(leaf)[1] ^= 0x0100u;
    CHECK_EQ(refusal_of(cube.sections()), 137'000u + 2 * leaf);
  }
}

TEST(R138AxesThatLengthen) {
  for (uint32_t leaf = 0; leaf < kLeaves; ++leaf)
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const int32_t length =
          axis < 2 ? 23171 : 32769 - 65536;  // 2^15 and a bit, or nearly as long ...
      BoxedCube cube;
      for (uint32_t i = 0; i < 3; ++i) {
        const int32_t component = mesh::LeafBox(cube.box(leaf)).axis[axis][i];
        if (component != 0) cube.set_axis(leaf, axis, i, component < 0 ? -length : length);
      }
      if (axis == 2) cube.set_axis(leaf, axis, (leaf / 2 + 1) % 3, 300);  // ... and askew
      CHECK_EQ(refusal_of(cube.sections()), 138'000u + 2 * leaf);
    }
}

TEST(R138TwoAxesThatAreOne) {
  for (uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
    BoxedCube cube;
    for (uint32_t i = 0; i < 3; ++i)
      cube.set_axis(leaf, 1, i, mesh::LeafBox(cube.box(leaf)).axis[0][i]);
    CHECK_EQ(refusal_of(cube.sections()), 138'000u + 2 * leaf);
  }
}

// A side that is `cells` farther out or in than the middle of its box, which is one cell long
// across it. All other boxes are as long as they may be.
static uint32_t refusal_of_turned(uint32_t leaf, float cells) {
  BoxedCube cube;
  for (uint32_t other = 0; other < kLeaves; ++other) {
    cube.box(other)[0] = 0xFFFFFFFFu;
    if (other != leaf) cube.box(other)[1] = 0xFFFFFFFFu;
  }
  constexpr float kShorter = 0.75f * 0x1p-15f;
  mesh::BoxFrame frame{};
  for (uint32_t k = 0; k < 3; ++k) frame.axis[k][k] = 1.0f - kShorter;
  const float side_m = leaf % 2 == 0 ? -1.0f : 1.0f;
  frame.centre_m[leaf / 2] = cells * cube.cube.head.cell_m - side_m * kShorter;
  mesh::Sections s = cube.sections();
  s.box_frame = {reinterpret_cast<const uint8_t*>(&frame), sizeof frame};
  return refusal_of(s);
}

// Half of a cell and 0.041 are needed along the axes, 2^-6 more where they are turned.
TEST(R139TurnedBoxNeedsMoreRoom) {
  for (uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
    CHECK_EQ(refusal_of_turned(leaf, 0.435f), 0u);
    CHECK_EQ(refusal_of_turned(leaf, 0.45f) / 1000, 139u);
  }
}

TEST(R139BoxThatDoesNotHoldItsLeaf) {
  for (uint32_t leaf = 0; leaf < kLeaves; ++leaf)
    for (uint32_t k = 0; k < 3; ++k) {
      BoxedCube cube;
      cube.box(leaf)[k / 2] -= k == 1 || k == 2 ? 0x10000u : 1u;
      CHECK_EQ(refusal_of(cube.sections()) / 1000, 139u);
      CHECK_EQ((refusal_of(cube.sections()) % 1000) / 2, leaf);
    }
}

TEST(R139BoxSoFarOffThatItsLeafIsBeyondTheReach) {
  BoxedCube cube;
  cube.box(0)[2] = 0x7FFF7FFFu;
  cube.box(0)[0] = 0xFFFFFFFFu;
  cube.box(0)[1] = 0xFFFFFFFFu;
  CHECK_EQ(refusal_of(cube.sections()) / 1000, 139u);
}
