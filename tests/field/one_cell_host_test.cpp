// Fields of few cells whose bounds have a closed form, checked against double.
#include <cmath>

#include "cube_field.hpp"
#include "firmtouch/field/distance_bounds.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace firmtouch {
namespace {

using tools::Random;

/// The cube from -1 to 1 and a grid about it of other counts on each axis.
struct Grid {
  static constexpr uint32_t kMaxCells = 64;
  mesh_test::Cube cube;
  mesh::View mesh = cube.view();
  field::Head head{};
  int16_t words[kMaxCells];
  uint32_t seeds[kMaxCells] = {};

  Grid() {
    head.is_signed = 1;
    head.quantum_m = 0x1p-12f;
    for (int16_t& word : words) word = field::kUnknown;
  }
  field::Sections sections() const {
    const uint32_t cells = head.count[0] * head.count[1] * head.count[2];
    return {test::bytes(&head, sizeof head), test::bytes(words, 2 * cells),
            test::bytes(seeds, 4 * cells)};
  }
  core::Verdict verdict() const { return test::verdict_of<field::View>(sections(), mesh); }
  field::View view() const {
    field::View view;
    CHECK(field::open(sections(), mesh, view).ok());
    return view;
  }
};

/// One cell of 4 m, its centre inside the cube, a thousand quanta from the face x = 1.
struct OneCell : Grid {
  static constexpr double kCentre[3] = {1 - 1000 * 0x1p-17, 0.0625, -0.03125};
  /// `nearer_m` nearer to the face.
  explicit OneCell(float nearer_m = 0) {
    head.cell_m = 4;
    head.quantum_m = 0x1p-17f;
    for (uint32_t k = 0; k < 3; ++k) {
      head.count[k] = 1;
      head.low_m[k] = static_cast<float>(kCentre[k] - 2);
    }
    head.low_m[0] += nearer_m;
  }
  OneCell& set_quanta(int quanta) {
    words[0] = static_cast<int16_t>(-1 - quanta);
    return *this;
  }
};

math::Vec3 some_point(Random& random, double reach) {
  float p[3];
  for (float& each : p) each = static_cast<float>(random.between(-reach, reach));
  return {p[0], p[1], p[2]};
}

}  // namespace

// A word stands for its quanta to two more. The mesh's answer may be off by 4e-7 of its diagonal,
// so an upper bound less than 5e-7 above it proves nothing; the lower bound is not above the
// answer's.
TEST(R310_BoundsCoverTheErrorOfTheMeshsAnswer) {
  const auto is_proven = [](float nearer_m, int quanta) {
    const core::Verdict verdict = OneCell(nearer_m).set_quanta(quanta).verdict();
    if (!verdict.ok()) CHECK_EQ(test::refusal(verdict), 310'000u);
    return verdict.ok();
  };
  CHECK(is_proven(0, 999));
  CHECK(!is_proven(0, 998));  // two quanta more are the distance itself
  CHECK(!is_proven(0, 1000));
  CHECK(!is_proven(12 * 0x1p-23f, 998));  // 4.1e-7 of the diagonal above it
  CHECK(is_proven(15 * 0x1p-23f, 998));   // 5.2e-7
}

TEST(OneCell_BoundsOfAnyPoint_AreRoundedOutward) {
  OneCell field;
  constexpr int kQuanta = 999;
  field.set_quanta(kQuanta);
  const field::View view = field.view();
  Random random(6);
  int known = 0;
  for (int i = 0; i < 6000; ++i) {
    test::note("point", i);
    const double reach = i % 4 == 0 ? 2 : i % 4 == 1 ? 0.002 : i % 4 == 2 ? 1e-5 : 20;
    const math::Vec3 off = some_point(random, reach);
    const math::Vec3 p{static_cast<float>(OneCell::kCentre[0]) + off.x,
                       static_cast<float>(OneCell::kCentre[1]) + off.y,
                       static_cast<float>(OneCell::kCentre[2]) + off.z};
    const field::Bounds bounds = field::distance_bounds(view, p);
    const double x = double{p.x} - OneCell::kCentre[0], y = double{p.y} - OneCell::kCentre[1],
                 z = double{p.z} - OneCell::kCentre[2], way = std::sqrt(x * x + y * y + z * z);
    const double lower = kQuanta * 0x1p-17 - way, upper = (kQuanta + 2) * 0x1p-17 + way;
    CHECK_GE(double{bounds.upper_m}, upper);
    CHECK_LE(double{bounds.upper_m}, upper * (1 + 0x1p-19));
    if (std::fmax(std::fabs(x), std::fmax(std::fabs(y), std::fabs(z))) > 2) continue;
    CHECK_LE(double{bounds.lower_m}, std::fmax(lower, 0));
    CHECK_GE(double{bounds.lower_m}, lower - 0x1p-19 * (lower + way));
    CHECK_EQ(bounds.sign, bounds.lower_m > 0 ? -1 : 0);
    known += bounds.sign != 0 ? 1 : 0;
  }
  CHECK_LT(2000, known);
}

TEST(GridThatEndsWithTheMesh_Passes) {
  Grid field;
  field.head.cell_m = 1;
  for (uint32_t k = 0; k < 3; ++k) field.head.count[k] = 2, field.head.low_m[k] = -1;
  CHECK(field.verdict().ok());
}

// A bound of no quanta states no side: here the centre is inside, and the word not negative.
TEST(OneCell_NoQuanta_StatesNoSide) {
  OneCell field(999 * 0x1p-17f);
  field.words[0] = 0;
  const field::View view = field.view();
  const field::Bounds bounds = field::distance_bounds(view, field::centre_of(view.head(), 0, 0, 0));
  CHECK_EQ(bounds.sign, 0);
  CHECK_EQ(bounds.lower_m, 0.0f);
  CHECK_GE(bounds.upper_m, 0x1p-16f);
  field.head.is_signed = field.cube.head.is_signed = 0;
  mesh::Sections sections = field.cube.sections();
  sections.vertex_normals = sections.edge_folds = {};
  field.mesh = test::opened<mesh::View>(sections);
  CHECK(field.verdict().ok());  // nor does one of a sheet
}

// On each axis another count of cells and another beginning.
TEST(UnknownCells_LowerBoundIsTheDistanceToTheGridsBox_RoundedDown) {
  Grid field;
  const uint32_t count[3] = {3, 4, 5};
  const float low_m[3] = {-1.125f, -1.25f, -1.75f};
  for (uint32_t k = 0; k < 3; ++k) field.head.count[k] = count[k], field.head.low_m[k] = low_m[k];
  field.head.cell_m = 0.75f;
  const field::View view = field.view();
  Random random(7);
  int inside = 0, outside = 0;
  for (int i = 0; i < 6000; ++i) {
    test::note("point", i);
    const math::Vec3 p = some_point(random, i % 3 == 0 ? 1e4 : i % 3 == 1 ? 4 : 2);
    const field::Bounds bounds = field::distance_bounds(view, p);
    const double at[3] = {double{p.x}, double{p.y}, double{p.z}};
    double sum = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const double low = double{low_m[k]}, high = low + 0.75 * count[k];
      const double off = std::fmax(0, std::fmax(low - at[k], at[k] - high));
      sum += off * off;
    }
    const double truth = std::sqrt(sum);
    CHECK_LE(double{bounds.lower_m}, truth);
    CHECK_GE(double{bounds.lower_m}, truth * (1 - 0x1p-19));
    CHECK_EQ(bounds.sign, truth > 0 ? 1 : 0);
    (truth > 0 ? outside : inside) += 1;
  }
  CHECK_LT(500, inside);
  CHECK_LT(3000, outside);
}

}  // namespace firmtouch
