// Each rule of a spline model, tripped alone: one thing is wrong, all that follows from it fits.
#include "harness/slices.hpp"
#include "harness/test.hpp"
#include "spline/small_spline.hpp"

namespace {

using firmtouch::core::Verdict;
using firmtouch::spline::Sections;
using firmtouch::spline::View;
using firmtouch::spline_test::SmallSpline;

Verdict verdict_of(const Sections& sections) {
  View view;
  const Verdict verdict = firmtouch::spline::open(sections, view);
  CHECK_EQ(verdict.ok(), view.is_open());
  return verdict;
}

void expect(const SmallSpline& model, uint32_t rule, uint32_t element) {
  const Verdict verdict = verdict_of(model.sections());
  CHECK_EQ(verdict.rule, rule);
  CHECK_EQ(verdict.element, element);
}

SmallSpline curve() { return SmallSpline(false); }
SmallSpline surface() { return SmallSpline(true); }
float nan_value() { return __builtin_nanf(""); }

}  // namespace

TEST(TheModelsThatTheRulesAreTriedOnAreGood) {
  for (uint32_t kind = 0; kind < 4; ++kind)
    expect(SmallSpline((kind & 1u) != 0, (kind & 2u) != 0), 0, 0);
}

TEST(OpeningInSlicesOfAnySizeSaysTheSame) {
  const SmallSpline model = surface();
  for (uint32_t slice = 1; slice < 100; slice += 33)
    CHECK_LT(firmtouch::test::slices_of<firmtouch::spline::Opening>(model.sections(), slice),
             1000u);
}

TEST(Rule601RefusesAMissingHead) {
  const SmallSpline model = curve();
  Sections s = model.sections();
  s.head = {};
  CHECK_EQ(verdict_of(s).rule, 601);
  CHECK_EQ(verdict_of({}).rule, 601);
}

TEST(Rule602RefusesCountsOutOfRange) {
  SmallSpline model = curve();
  model.head.leaf_count = 0;
  expect(model, 602, 0);
  model.head.leaf_count = 65536;
  expect(model, 602, 0);
  model.head.leaf_count = 4;
  model.head.piece_count = 0;
  expect(model, 602, 0);
  model = curve();
  model.head.point_count = 4;
  expect(model, 602, 0);
}

TEST(Rule603RefusesFlags) {
  SmallSpline model = curve();
  model.head.is_rational = 2;
  expect(model, 603, 0);
}

TEST(Rule604RefusesSectionsOfAnotherLength) {
  const SmallSpline model = curve();
  const Sections whole = model.sections();
  const SmallSpline other = surface();
  const Sections across = other.sections();
  for (uint32_t which = 0; which < 9; ++which)
    for (uint32_t kind = 0; kind < 2; ++kind) {
      if (which == 3) continue;  // is not used
      Sections s = kind == 0 ? whole : across;
      firmtouch::core::Bytes* const parts[] = {&s.pieces, &s.coefficients, &s.leaves,
                                               nullptr,   &s.nodes,        &s.points,
                                               &s.bends,  &s.grids,        &s.radii};
      if (parts[which]->size() == 0)  // of the other kind: of any length it is too much
        *parts[which] = whole.head;
      else
        *parts[which] = {parts[which]->data(), parts[which]->size() - 1};
      const Verdict verdict = verdict_of(s);
      CHECK_EQ(verdict.rule, 604);
      CHECK_EQ(verdict.element, which);
    }
}

TEST(Rule605RefusesABoxThatIsInvertedOrFarAway) {
  SmallSpline model = curve();
  model.head.low_m[1] = model.head.high_m[1] + 1.0f;
  expect(model, 605, 1);
  model = curve();
  model.head.high_m[2] = 2e6f;
  expect(model, 605, 2);
  model = curve();
  model.head.low_m[0] = nan_value();
  expect(model, 605, 0);
}

TEST(Rule606RefusesAnExtentThatTheBoxDoesNotHave) {
  SmallSpline model = curve();
  model.head.extent_m = 100.0f;
  expect(model, 606, 0);
  model.head.extent_m = 0.0f;
  expect(model, 606, 0);
}

TEST(Rule607RefusesALossThatBreaksThePromise) {
  SmallSpline model = curve();
  model.head.loss_m = model.head.extent_m * 1e-6f;
  expect(model, 607, 0);
  model.head.loss_m = nan_value();
  expect(model, 607, 0);
}

TEST(Rule608RefusesABudgetOfNothing) {
  SmallSpline model = curve();
  model.head.worst_steps = 0;
  expect(model, 608, 0);
}

TEST(Rule609RefusesAUnitOfRadiiThatIsNone) {
  SmallSpline model = curve();
  model.head.radius_unit_m = 0.0f;
  expect(model, 609, 0);
  model.head.radius_unit_m = 0x1p61f;
  expect(model, 609, 0);
  model.head.radius_unit_m = nan_value();
  expect(model, 609, 0);
  model = surface();
  model.head.radius_unit_m = 1.0f;
  expect(model, 609, 0);
}

TEST(Rule611RefusesADegreeOutOfRange) {
  SmallSpline model = curve();
  model.pieces[1].degree_u = 6;
  expect(model, 611, 1);
  model = curve();
  model.pieces[0].degree_v = 1;
  expect(model, 611, 0);
  model = surface();
  model.pieces[0].degree_v = 0;
  expect(model, 611, 0);
}

TEST(Rule612_RejectsUnannouncedWeightsAndTooManyHalvings) {
  SmallSpline model = curve();
  model.pieces[0].is_rational = 1;
  expect(model, 612, 0);
  model = curve();
  model.pieces[1].level_u = 9;
  expect(model, 612, 1);
}

TEST(Rule613RefusesCoefficientsOutOfTurn) {
  SmallSpline model = curve();
  model.pieces[1].coefficients += 3;
  expect(model, 613, 1);
  model = curve();
  model.pieces[1].degree_u = 4;
  expect(model, 613, 1);
  model = curve();
  model.pieces[1].degree_u = 2;
  expect(model, 613, 2);
}

TEST(Rule614_RejectsANanCoefficient) {
  SmallSpline model = curve();
  model.coefficients[7] = nan_value();
  expect(model, 614, 7);
}

TEST(Rule615_RejectsLeavesOutOfOrder) {
  SmallSpline model = curve();
  model.leaves[1] = 1;
  expect(model, 615, 0);
  model = curve();
  model.leaves[3] = 0;
  expect(model, 615, 1);
  model = curve();
  model.bends[1].first_leaf = 1;
  expect(model, 615, 1);
  model = curve();
  model.bends[1].first_leaf = 3;
  expect(model, 615, 1);
  model.leaves[2] = firmtouch::spline::kNoLeaf;  // now there is one too few
  expect(model, 615, 1);
  model = curve();
  model.bends[0].first_leaf = 1;
  model.leaves[0] = firmtouch::spline::kNoLeaf;
  expect(model, 615, 0);
  model = curve();
  model.pieces[1].level_u = 2;
  expect(model, 615, 1);
  model = curve();
  model.pieces[1].level_u = 0;
  expect(model, 615, 2);
}

TEST(Rule616_RejectsANanOriginOrParameter) {
  SmallSpline model = curve();
  model.pieces[1].origin_m[2] = nan_value();
  expect(model, 616, 1);
  model = curve();
  model.pieces[0].half_u = nan_value();
  expect(model, 616, 0);
}

TEST(Rule617RefusesAPointOutsideTheBox) {
  SmallSpline model = curve();
  model.points[2 * 3] = 9.0f;
  expect(model, 617, 3);
  model = curve();
  model.points[10 + 4] = nan_value();
  expect(model, 617, 4);
}

TEST(Rule618RefusesANodeThatIsNone) {
  SmallSpline model = curve();
  // Six leaves: those of node 7 would be the seventh and eighth.
  model.pieces[1].level_u = 2;
  model.head.leaf_count = 6;
  model.head.point_count = 7;
  const uint16_t leaves[] = {0, 0, 1, 1, 1, 1};
  float points[7 * 3];
  for (uint32_t k = 0; k < 21; ++k) points[k] = model.head.low_m[k < 14 ? k % 2 : 2];
  uint8_t radii[13] = {};
  const auto verdict = [&] {
    Sections s = model.sections();
    s.leaves = {reinterpret_cast<const uint8_t*>(leaves), sizeof leaves};
    s.points = {reinterpret_cast<const uint8_t*>(points), sizeof points};
    s.radii = {radii, sizeof radii};
    return verdict_of(s);
  };
  CHECK(verdict().rule != 618);
  radii[6] = 1;
  CHECK_EQ(verdict().rule, 618);
  CHECK_EQ(verdict().element, 6u);
  model = surface();
  model.boxes[0].axis[1][2] = 0.5f;
  expect(model, 618, 0);
  model = surface();
  model.boxes[0].half_m[1] = nan_value();
  expect(model, 618, 0);
}

TEST(Rule619RefusesWeightsThatVaryTooMuchOnALeaf) {
  SmallSpline model(false, true);
  model.coefficients[7] = 1.3f;  // of s
  expect(model, 619, 0);
}

TEST(Rule620RefusesBendsThatAreNotBounds) {
  SmallSpline model = curve();
  for (uint32_t piece = 0; piece < 2; ++piece) {
    model = SmallSpline(false, true);
    firmtouch::spline::CurveBend& bend = model.bends[piece];
    float* const bounds[] = {&bend.fixed_m2, &bend.turning_m, &bend.noise_m2,
                             &bend.noise_turning_m};
    for (float* const bound : bounds) {
      const float derived = *bound;
      CHECK(derived > 0.0f);
      *bound = derived * 0.999f;
      expect(model, 620, piece);
      *bound = nan_value();
      expect(model, 620, piece);
      *bound = __builtin_inff();
      expect(model, 620, piece);
      *bound = derived;
    }
  }
  for (uint32_t k = 0; k < 5; ++k) {
    for (uint32_t cell = 0; cell < 3; ++cell) {
      model = surface();
      firmtouch::spline::PatchBend& bend = model.patch_bends[cell];
      uint8_t* const bytes[] = {&bend.fixed[k], &bend.turning[k]};
      for (uint8_t* const byte : bytes) {
        if (*byte == 0) continue;  // below the unit
        *byte = static_cast<uint8_t>(*byte - 1);
        expect(model, 620, cell);
        *byte = static_cast<uint8_t>(*byte + 1);
      }
    }
  }
}

TEST(Rule621RefusesALossBelowWhatALeafLoses) {
  SmallSpline model = curve();
  model.head.loss_m *= 0.5f;
  const Verdict verdict = verdict_of(model.sections());
  CHECK_EQ(verdict.rule, 621);
}

TEST(Rule622RefusesALeafOutsideTheBox) {
  SmallSpline model = surface();
  model.head.high_m[1] -= 0.25f;
  const Verdict verdict = verdict_of(model.sections());
  CHECK_EQ(verdict.rule, 622);
}

TEST(Rule623RefusesANodeThatDoesNotHoldItsLeaves) {
  for (uint32_t node = 0; node < 7; ++node) {
    firmtouch::test::note("node", node);
    SmallSpline model = curve();
    model.curve_radii[node] = static_cast<uint8_t>(model.curve_radii[node] - 1);
    CHECK_EQ(verdict_of(model.sections()).rule, 623);
  }
  SmallSpline model = surface();
  model.boxes[0].half_m[2] *= 0.999f;
  CHECK_EQ(verdict_of(model.sections()).rule, 623);
  for (uint32_t part = 0; part < 6; ++part) {
    firmtouch::test::note("part", part);
    model = surface();
    model.radii[part] = static_cast<uint8_t>(model.radii[part] - 1);
    CHECK_EQ(verdict_of(model.sections()).rule, 623);
  }
  model = surface();
  CHECK(model.radii[7] > 0);  // the second piece's overlap
  model.radii[7] = static_cast<uint8_t>(model.radii[7] - 1);
  CHECK_EQ(verdict_of(model.sections()).rule, 623);
  model = surface();
  model.corners[4].z = static_cast<int16_t>(model.corners[4].z + 2000);
  CHECK_EQ(verdict_of(model.sections()).rule, 623);
}

TEST(Rule624RefusesCornersAndLeavesOutOfTurn) {
  SmallSpline model = surface();
  model.grids[1].first_corner = 5;
  expect(model, 624, 1);
  model = surface();
  model.grids[0].first_leaf = 1;
  expect(model, 624, 0);
  model = surface();
  model.grids[1].first_cell = 2;
  expect(model, 624, 1);
  model = surface();
  model.grids[1].cell_level = 0;
  expect(model, 624, 2);
  model = surface();
  model.grids[1].cell_level = 7;
  expect(model, 624, 1);
  model = surface();
  model.pieces[0].level_v = 1;
  expect(model, 624, 1);
  model = surface();
  model.pieces[1].level_u = 0;
  expect(model, 624, 2);
}

TEST(Rule625RefusesStepsAndUnitsThatAreNone) {
  SmallSpline model = surface();
  model.grids[1].step_m = 0x1.8p-13f;
  expect(model, 625, 1);
  model = surface();
  model.grids[0].step_m = nan_value();
  expect(model, 625, 0);
  model = surface();
  model.grids[1].fixed_unit_m2 = 0.0f;
  expect(model, 625, 1);
  model = surface();
  model.grids[1].turning_unit_m = nan_value();
  expect(model, 625, 1);
  model = surface();
  model.grids[0].radius_unit_m = 0x1p61f;
  expect(model, 625, 0);
}

TEST(Rule626RefusesAFlatCurveThatIsNotFlat) {
  SmallSpline model = curve();
  model.is_flat = true;
  expect(model, 626, 0);  // a power of s has a z
  const auto flatten = [&] {
    model = curve();
    model.is_flat = true;
    for (uint32_t k = 2; k < 24; k += 3) model.coefficients[k] = 0.0f;
    model.pieces[1].origin_m[2] = model.pieces[0].origin_m[2];
  };
  flatten();
  CHECK(verdict_of(model.sections()).rule != 626);
  model.pieces[1].origin_m[2] += 0x1p-6f;
  expect(model, 626, 1);
  flatten();
  model.coefficients[23] = 0x1p-20f;
  expect(model, 626, 1);
}
