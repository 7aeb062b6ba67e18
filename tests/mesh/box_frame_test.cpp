// A mesh whose boxes are turned against the axes: the frame is checked, no vertex is left out by
// its roundings, and no distance is longer in it.
#include "firmtouch/mesh/box_frame.hpp"

#include "harness/random.hpp"
#include "refusal.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// The cube with a frame along its own axes: its boxes stay right.
struct TurnedCube {
  Cube cube;
  mesh::BoxFrame frame{};

  TurnedCube() {
    for (uint32_t k = 0; k < 3; ++k) frame.axis[k][k] = 1.0f - 0.75f * 0x1p-15f;
  }
  mesh::Sections sections() const {
    mesh::Sections s = cube.sections();
    s.box_frame = {static_cast<const uint8_t*>(static_cast<const void*>(&frame)), sizeof frame};
    return s;
  }
  uint32_t refusal() const { return refusal_of(sections()); }
};

template <class Change>
uint32_t refusal_with(Change change) {
  TurnedCube turned;
  change(turned);
  return turned.refusal();
}

}  // namespace

TEST(TurnedCubePasses) { CHECK_EQ(TurnedCube().refusal(), 0u); }

TEST(R101BoxFrameOfTheWrongSize) {
  const TurnedCube turned;
  mesh::Sections s = turned.sections();
  s.box_frame = shorter(s.box_frame, 4);
  CHECK_EQ(refusal_of(s), 101'000u);
}

TEST(R106BoxFrameIsNotSound) {
  for (uint32_t i = 0; i < 3; ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      CHECK_EQ(refusal_with([&](TurnedCube& t) { t.frame.axis[i][k] += 0x1p-17f; }), 106'007u);
      CHECK_EQ(refusal_with([&](TurnedCube& t) { t.frame.axis[i][k] = nan_value(); }), 106'007u);
      CHECK_EQ(refusal_with([&](TurnedCube& t) { t.frame.axis[i][k] += 0x1p-20f; }), 0u);
    }
  for (uint32_t k = 0; k < 3; ++k) {
    CHECK_EQ(refusal_with([&](TurnedCube& t) { t.frame.centre_m[k] = 2e7f; }), 106'007u);
    CHECK_EQ(refusal_with([&](TurnedCube& t) { t.frame.centre_m[k] = nan_value(); }), 106'007u);
  }
}

TEST(R106RootIsTooNearTheEdgeOfTheGrid) {
  CHECK_EQ(refusal_with([](TurnedCube& t) {
             t.cube.nodes[0].side[1].box[2] &= 0xFFFF0000u;
             t.cube.nodes[0].side[1].box[2] |= mesh::kTurnedFreeCells - 1;
           }),
           106'003u);
  CHECK_EQ(refusal_with([](TurnedCube& t) {
             t.cube.nodes[0].side[0].box[0] &= 0xFFFFu;
             t.cube.nodes[0].side[0].box[0] |= (mesh::kTurnedFreeCells - 1) << 16;
           }),
           106'003u);
}

// The cube's boxes have two cells to spare, of which a turned one needs 2^-6.
TEST(R127TurnedBoxWithoutSlack) {
  TurnedCube turned;
  const float cell_m = turned.cube.head.cell_m;
  turned.frame.centre_m[0] = 1.5f * cell_m;
  CHECK_EQ(turned.refusal(), 127'000u);
}

// Against the same in double: the bound of box_frame.hpp, reached to a third or more.
TEST(Turned_ErrsByFourRoundingsAtMost) {
  test::Xorshift random(5);
  const auto unit = [&random] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; };
  double most = 0;
  for (uint32_t i = 0; i < 200000; ++i) {
    mesh::BoxFrame frame{};
    for (float& x : frame.centre_m) x = unit();
    for (auto& axis : frame.axis)
      for (float& x : axis) x = unit();
    const math::Vec3 p{unit(), unit(), unit()}, v = mesh::turned(frame, p);
    const double from[3] = {static_cast<double>(p.x) - static_cast<double>(frame.centre_m[0]),
                            static_cast<double>(p.y) - static_cast<double>(frame.centre_m[1]),
                            static_cast<double>(p.z) - static_cast<double>(frame.centre_m[2])};
    for (uint32_t k = 0; k < 3; ++k) {
      double truth = 0, size = 0;
      for (uint32_t j = 0; j < 3; ++j) {
        truth += static_cast<double>(frame.axis[k][j]) * from[j];
        size += __builtin_fabs(static_cast<double>(frame.axis[k][j]) * from[j]);
      }
      const double share =
          __builtin_fabs(static_cast<double>((&v.x)[k]) - truth) / (4 * 0x1p-24 * size);
      most = share > most ? share : most;
    }
  }
  CHECK_LE(most, 1.0);
  CHECK_GT(most, 0.33);
}
