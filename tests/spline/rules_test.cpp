// Each rule of a spline model, tripped alone: one thing is wrong, all that follows from it fits.
#include "harness/rules.hpp"
#include "harness/float_bits.hpp"
#include "harness/slices.hpp"
#include "spline/small_spline.hpp"

namespace {

using firmtouch::spline::kNoLeaf;
using firmtouch::spline::Sections;
using firmtouch::spline::View;
using firmtouch::spline_test::SmallSpline;
using firmtouch::test::nan_value;

uint32_t refusal_of(const Sections& sections) {
  return firmtouch::test::refusal(firmtouch::test::verdict_of<View>(sections));
}
uint32_t refusal_of(const SmallSpline& model) { return refusal_of(model.sections()); }

SmallSpline curve() { return SmallSpline(false); }
SmallSpline surface() { return SmallSpline(true); }

// The same of a model in which something is changed.
template <class Change>
uint32_t curve_with(Change change) {
  SmallSpline model = curve();
  change(model);
  return refusal_of(model);
}
template <class Change>
uint32_t surface_with(Change change) {
  SmallSpline model = surface();
  change(model);
  return refusal_of(model);
}

}  // namespace

TEST(TheModelsThatTheRulesAreTriedOnAreGood) {
  for (uint32_t kind = 0; kind < 4; ++kind)
    CHECK_EQ(refusal_of(SmallSpline((kind & 1u) != 0, (kind & 2u) != 0)), 0u);
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
  CHECK_EQ(refusal_of(s), 601'000u);
  CHECK_EQ(refusal_of(Sections{}), 601'000u);
}

TEST(Rule602RefusesCountsOutOfRange) {
  CHECK_EQ(curve_with([](auto& m) { m.head.leaf_count = 0; }), 602'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.leaf_count = 65536; }), 602'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.piece_count = 0; }), 602'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.point_count = 4; }), 602'000u);
}

TEST(Rule603RefusesFlags) {
  CHECK_EQ(curve_with([](auto& m) { m.head.is_rational = 2; }), 603'000u);
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
      CHECK_EQ(refusal_of(s), 604'000u + which);
    }
}

TEST(Rule605RefusesABoxThatIsInvertedOrFarAway) {
  CHECK_EQ(curve_with([](auto& m) { m.head.low_m[1] = m.head.high_m[1] + 1.0f; }), 605'001u);
  CHECK_EQ(curve_with([](auto& m) { m.head.high_m[2] = 2e6f; }), 605'002u);
  CHECK_EQ(curve_with([](auto& m) { m.head.low_m[0] = nan_value(); }), 605'000u);
}

TEST(Rule606RefusesAnExtentThatTheBoxDoesNotHave) {
  CHECK_EQ(curve_with([](auto& m) { m.head.extent_m = 100.0f; }), 606'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.extent_m = 0.0f; }), 606'000u);
}

TEST(Rule607RefusesALossThatBreaksThePromise) {
  CHECK_EQ(curve_with([](auto& m) { m.head.loss_m = m.head.extent_m * 1e-6f; }), 607'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.loss_m = nan_value(); }), 607'000u);
}

TEST(Rule608RefusesABudgetOfNothing) {
  CHECK_EQ(curve_with([](auto& m) { m.head.worst_steps = 0; }), 608'000u);
}

TEST(Rule609RefusesAUnitOfRadiiThatIsNone) {
  CHECK_EQ(curve_with([](auto& m) { m.head.radius_unit_m = 0.0f; }), 609'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.radius_unit_m = 0x1p61f; }), 609'000u);
  CHECK_EQ(curve_with([](auto& m) { m.head.radius_unit_m = nan_value(); }), 609'000u);
  CHECK_EQ(surface_with([](auto& m) { m.head.radius_unit_m = 1.0f; }), 609'000u);
}

TEST(Rule611RefusesADegreeOutOfRange) {
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].degree_u = 6; }), 611'001u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[0].degree_v = 1; }), 611'000u);
  CHECK_EQ(surface_with([](auto& m) { m.pieces[0].degree_v = 0; }), 611'000u);
}

TEST(Rule612_RejectsUnannouncedWeightsAndTooManyHalvings) {
  CHECK_EQ(curve_with([](auto& m) { m.pieces[0].is_rational = 1; }), 612'000u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].level_u = 9; }), 612'001u);
}

TEST(Rule613RefusesCoefficientsOutOfTurn) {
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].coefficients += 3; }), 613'001u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].degree_u = 4; }), 613'001u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].degree_u = 2; }), 613'002u);
}

TEST(Rule614_RejectsANanCoefficient) {
  CHECK_EQ(curve_with([](auto& m) { m.coefficients[7] = nan_value(); }), 614'007u);
}

TEST(Rule615_RejectsLeavesOutOfOrder) {
  CHECK_EQ(curve_with([](auto& m) { m.leaves[1] = 1; }), 615'000u);
  CHECK_EQ(curve_with([](auto& m) { m.leaves[3] = 0; }), 615'001u);
  CHECK_EQ(curve_with([](auto& m) { m.bends[1].first_leaf = 1; }), 615'001u);
  CHECK_EQ(curve_with([](auto& m) { m.bends[1].first_leaf = 3; }), 615'001u);
  // One leaf too few.
  CHECK_EQ(curve_with([](auto& m) { m.bends[1].first_leaf = 3, m.leaves[2] = kNoLeaf; }), 615'001u);
  CHECK_EQ(curve_with([](auto& m) { m.bends[0].first_leaf = 1, m.leaves[0] = kNoLeaf; }), 615'000u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].level_u = 2; }), 615'001u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].level_u = 0; }), 615'002u);
}

TEST(Rule616_RejectsANanOriginOrParameter) {
  CHECK_EQ(curve_with([](auto& m) { m.pieces[1].origin_m[2] = nan_value(); }), 616'001u);
  CHECK_EQ(curve_with([](auto& m) { m.pieces[0].half_u = nan_value(); }), 616'000u);
}

TEST(Rule617RefusesAPointOutsideTheBox) {
  CHECK_EQ(curve_with([](auto& m) { m.points[2 * 3] = 9.0f; }), 617'003u);
  CHECK_EQ(curve_with([](auto& m) { m.points[10 + 4] = nan_value(); }), 617'004u);
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
  const auto refusal = [&] {
    Sections s = model.sections();
    s.leaves = {reinterpret_cast<const uint8_t*>(leaves), sizeof leaves};
    s.points = {reinterpret_cast<const uint8_t*>(points), sizeof points};
    s.radii = {radii, sizeof radii};
    return refusal_of(s);
  };
  CHECK_NE(refusal() / 1000, 618u);
  radii[6] = 1;
  CHECK_EQ(refusal(), 618'006u);
  CHECK_EQ(surface_with([](auto& m) { m.boxes[0].axis[1][2] = 0.5f; }), 618'000u);
  CHECK_EQ(surface_with([](auto& m) { m.boxes[0].half_m[1] = nan_value(); }), 618'000u);
}

TEST(Rule619RefusesWeightsThatVaryTooMuchOnALeaf) {
  SmallSpline model(false, true);
  model.coefficients[7] = 1.3f;  // of s
  CHECK_EQ(refusal_of(model), 619'000u);
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
      CHECK_EQ(refusal_of(model), 620'000u + piece);
      *bound = nan_value();
      CHECK_EQ(refusal_of(model), 620'000u + piece);
      *bound = __builtin_inff();
      CHECK_EQ(refusal_of(model), 620'000u + piece);
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
        CHECK_EQ(refusal_of(model), 620'000u + cell);
        *byte = static_cast<uint8_t>(*byte + 1);
      }
    }
  }
}

TEST(Rule621RefusesALossBelowWhatALeafLoses) {
  SmallSpline model = curve();
  model.head.loss_m *= 0.5f;
  CHECK_EQ(refusal_of(model) / 1000, 621u);
}

TEST(Rule622RefusesALeafOutsideTheBox) {
  SmallSpline model = surface();
  model.head.high_m[1] -= 0.25f;
  CHECK_EQ(refusal_of(model) / 1000, 622u);
}

TEST(Rule623RefusesANodeThatDoesNotHoldItsLeaves) {
  for (uint32_t node = 0; node < 7; ++node) {
    firmtouch::test::note("node", node);
    SmallSpline model = curve();
    model.curve_radii[node] = static_cast<uint8_t>(model.curve_radii[node] - 1);
    CHECK_EQ(refusal_of(model) / 1000, 623u);
  }
  SmallSpline model = surface();
  model.boxes[0].half_m[2] *= 0.999f;
  CHECK_EQ(refusal_of(model) / 1000, 623u);
  for (uint32_t part = 0; part < 6; ++part) {
    firmtouch::test::note("part", part);
    model = surface();
    model.radii[part] = static_cast<uint8_t>(model.radii[part] - 1);
    CHECK_EQ(refusal_of(model) / 1000, 623u);
  }
  model = surface();
  CHECK(model.radii[7] > 0);  // the second piece's overlap
  model.radii[7] = static_cast<uint8_t>(model.radii[7] - 1);
  CHECK_EQ(refusal_of(model) / 1000, 623u);
  model = surface();
  model.corners[4].z = static_cast<int16_t>(model.corners[4].z + 2000);
  CHECK_EQ(refusal_of(model) / 1000, 623u);
}

TEST(Rule624RefusesCornersAndLeavesOutOfTurn) {
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].first_corner = 5; }), 624'001u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[0].first_leaf = 1; }), 624'000u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].first_cell = 2; }), 624'001u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].cell_level = 0; }), 624'002u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].cell_level = 7; }), 624'001u);
  CHECK_EQ(surface_with([](auto& m) { m.pieces[0].level_v = 1; }), 624'001u);
  CHECK_EQ(surface_with([](auto& m) { m.pieces[1].level_u = 0; }), 624'002u);
}

TEST(Rule625RefusesStepsAndUnitsThatAreNone) {
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].step_m = 0x1.8p-13f; }), 625'001u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[0].step_m = nan_value(); }), 625'000u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].fixed_unit_m2 = 0.0f; }), 625'001u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[1].turning_unit_m = nan_value(); }), 625'001u);
  CHECK_EQ(surface_with([](auto& m) { m.grids[0].radius_unit_m = 0x1p61f; }), 625'000u);
}

TEST(Rule626RefusesAFlatCurveThatIsNotFlat) {
  SmallSpline model = curve();
  model.is_flat = true;
  CHECK_EQ(refusal_of(model), 626'000u);  // a power of s has a z
  const auto flatten = [&] {
    model = curve();
    model.is_flat = true;
    for (uint32_t k = 2; k < 24; k += 3) model.coefficients[k] = 0.0f;
    model.pieces[1].origin_m[2] = model.pieces[0].origin_m[2];
  };
  flatten();
  CHECK_NE(refusal_of(model) / 1000, 626u);
  model.pieces[1].origin_m[2] += 0x1p-6f;
  CHECK_EQ(refusal_of(model), 626'001u);
  flatten();
  model.coefficients[23] = 0x1p-20f;
  CHECK_EQ(refusal_of(model), 626'001u);
}
