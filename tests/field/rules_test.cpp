// The reject rules of a distance field, each condition tripped alone.
#include "harness/rules.hpp"
#include "cube_field.hpp"
#include "harness/float_bits.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using field_test::CubeField;
using test::nan_value;
using test::shorter;

uint32_t refusal_of(const field::Sections& sections, const mesh::View& mesh) {
  return test::refusal(test::verdict_of<field::View>(sections, mesh));
}
uint32_t refusal_of(const CubeField& distance_field) {
  return refusal_of(distance_field.sections(), distance_field.cube.view());
}

template <class Change>
uint32_t refusal_with(Change change) {
  CubeField distance_field;
  change(distance_field);
  return refusal_of(distance_field);
}

}  // namespace

TEST(SoundField_Passes) { CHECK_EQ(refusal_of(CubeField()), 0u); }

TEST(R301HeadOfTheWrongSize) {
  const CubeField distance_field;
  field::Sections s = distance_field.sections();
  s.head = shorter(s.head, 4);
  CHECK_EQ(refusal_of(s, distance_field.cube.view()), 301'000u);
  s.head = {};
  CHECK_EQ(refusal_of(s, distance_field.cube.view()), 301'000u);
}

TEST(R302CountsOutOfRange) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.count[1] = 0; }), 302'001u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.count[2] = 1025; }), 302'002u);
  CHECK_EQ(refusal_with(
               [](CubeField& m) { m.head.count[0] = m.head.count[1] = m.head.count[2] = 1024; }),
           302'003u);
}

TEST(R303DistancesDoNotMatchTheCells) {
  const CubeField distance_field;
  field::Sections s = distance_field.sections();
  s.distances = shorter(s.distances, 2);
  CHECK_EQ(refusal_of(s, distance_field.cube.view()), 303'511u);
}

TEST(R304SeedsDoNotMatchTheCells) {
  const CubeField distance_field;
  field::Sections s = distance_field.sections();
  s.seeds = shorter(s.seeds, 4);
  CHECK_EQ(refusal_of(s, distance_field.cube.view()), 304'511u);
}

TEST(R305SidesThatAreNotTheMeshs) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.is_signed = 0; }), 305'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.is_signed = 2; }), 305'000u);
  const CubeField distance_field;
  CHECK_EQ(refusal_of(distance_field.sections(), mesh::View()), 305'000u);
  CubeField unsigned_field;
  unsigned_field.head.is_signed = 0;
  CHECK_EQ(refusal_of(unsigned_field.sections(), mesh::View()), 305'000u);
}

TEST(R306ReservedWordsAreZero) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.reserved[2] = 1; }), 306'000u);
}

TEST(R307GridThatDoesNotHoldTheMesh) {
  for (uint32_t k = 0; k < 3; ++k) {
    CHECK_EQ(refusal_with([=](CubeField& m) { m.head.low_m[k] = -0.99f; }), 307'000u + k);
    CHECK_EQ(refusal_with([=](CubeField& m) { m.head.low_m[k] = -1.8f; }), 307'000u + k);
  }
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.low_m[0] = -2e8f; }), 307'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.low_m[0] = nan_value(); }), 307'000u);
  for (uint32_t k = 0; k < 3; ++k) {  // to 6e8 m, from -2e8 m
    const auto huge = [=](CubeField& m) {
      for (float& low_m : m.head.low_m) low_m = -1e8f;
      m.head.low_m[k] = -2e8f;
      m.head.cell_m = 1e8f;
    };
    CHECK_EQ(refusal_with(huge), 307'000u + k);
  }
}

TEST(R308CellsOfNoSize) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.cell_m = 0; }), 308'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.cell_m = -0.4f; }), 308'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.cell_m = nan_value(); }), 308'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.cell_m = 2e8f; }), 308'000u);
}

TEST(R309QuantumThatIsNoPowerOfTwo) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.quantum_m = 3.0f; }), 309'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.quantum_m = -0.5f; }), 309'000u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.quantum_m = nan_value(); }), 309'000u);
}

TEST(R310BoundsAndSidesThatTheMeshDoesNotAnswer) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.words[7] = static_cast<int16_t>(m.words[7] + 2); }),
           310'007u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.words[7] = static_cast<int16_t>(m.words[7] - 2); }),
           310'007u);
  const auto other_side = [](CubeField& m) {
    m.words[300] = static_cast<int16_t>(-1 - m.words[300]);
  };
  CHECK_EQ(refusal_with(other_side), 310'300u);
  CHECK_EQ(refusal_with([](CubeField& m) { m.head.quantum_m *= 2; }), 310'000u);
}

TEST(ACellMaySayNothingAndASeedAnything) {
  CHECK_EQ(refusal_with([](CubeField& m) { m.words[9] = field::kUnknown; }), 0u);
  CHECK_EQ(refusal_with([](CubeField& m) {
             for (uint32_t i = 0; i < CubeField::kCells; ++i) m.seeds[i] = i * 2654435761u;
           }),
           0u);
}
