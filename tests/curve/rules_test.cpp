// Each rule of a curve, tripped alone: one thing is wrong, all that follows from it fits.
#include "curve/rule_curves.hpp"
#include "harness/float_bits.hpp"
#include "harness/slices.hpp"

namespace {

using firmtouch::core::Verdict;
using namespace firmtouch::curve;       // NOLINT: a test file
using namespace firmtouch::curve_test;  // NOLINT
using firmtouch::test::nan_value;

constexpr Sample kHook[] = {{0, 0, 0},           {0.125f, 0, 0},
                            {0.25f, 0.0625f, 0}, {0.25f, 0.25f, 0.5f},
                            {0, 0.25f, 0.25f},   {-0.5f, 0.125f, 0}};
constexpr Sample kRing[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};

// A section that is `less` or `more` bytes away from its size is rejected.
void check_sizes(const Sections& sections, firmtouch::core::Bytes Sections::*section, uint32_t less,
                 uint32_t more, uint32_t rule) {
  Sections s = sections;
  const firmtouch::core::Bytes whole = s.*section;
  s.*section = {whole.data(), whole.size() - less};
  CHECK_EQ(verdict_of(s).rule, rule);
  s.*section = {whole.data(), whole.size() + more};
  CHECK_EQ(verdict_of(s).rule, rule);
}

}  // namespace

TEST(TheCurvesThatTheRulesAreTriedOnAreGood) {
  expect(SmallCurve(kHook), 0, 0);
  expect(SmallCurve(kRing), 0, 0);
  CHECK_EQ(SmallCurve(kRing).view().is_closed(), true);
  CHECK_EQ(SmallCurve(kHook).view().is_closed(), false);
}

TEST(OpeningInSlicesOfAnySizeSaysTheSame) {
  const SmallCurve c(kHook);
  for (uint32_t slice = 1; slice < 8; ++slice) {
    // 6 samples by three stages, a box, a run, and the run's 16 smallest parts.
    uint32_t expected = 1, used = 0;
    for (uint32_t i = 0; i < 18 + 2 + 16; ++i) {
      if (used >= slice) ++expected, used = 0;
      used += i < 6 ? 1 : i < 12 ? 3 : i < 18 ? 8 : i < 20 ? 1 : 50;
    }
    CHECK_EQ(firmtouch::test::slices_of<firmtouch::curve::Opening>(c.sections(), slice), expected);
  }
}

TEST(Rule201RefusesAMissingHead) {
  const SmallCurve c(kHook);
  Sections s = c.sections();
  s.head = {};
  CHECK_EQ(verdict_of(s).rule, firmtouch::curve::kRuleHeadSize);
  s.head = {c.sections().head.data(), 44};
  CHECK_EQ(verdict_of(s).rule, firmtouch::curve::kRuleHeadSize);
  CHECK_EQ(verdict_of({}).rule, firmtouch::curve::kRuleHeadSize);
}

TEST(Rule202RefusesFewerThanTwoSamplesAndTooMany) {
  SmallCurve c(kHook);
  static const uint32_t counts[] = {0u, 1u, 1u << 22, 0xFFFFFFFFu};
  for (const uint32_t count : counts) {
    c.head.sample_count = count;
    Sections s = SmallCurve(kHook).sections();
    s.head = {reinterpret_cast<const uint8_t*>(&c.head), sizeof c.head};
    CHECK_EQ(verdict_of(s).rule, firmtouch::curve::kRuleSampleCount);
  }
}

TEST(Rule203RefusesAKindOfPiecesBeyondOne) {
  SmallCurve c(kHook);
  c.head.is_smooth = 2;
  expect(c, firmtouch::curve::kRuleSmoothFlag, 0);
}

TEST(Rule204RefusesAClosednessBeyondOne) {
  SmallCurve c(kRing);
  c.head.is_closed = 2;
  expect(c, firmtouch::curve::kRuleClosedFlag, 0);
}

TEST(Rules205To207RefuseSectionsOfAnotherLength) {
  const SmallCurve c(kHook);
  const Sections s = c.sections();
  check_sizes(s, &Sections::samples, 12, 12, firmtouch::curve::kRuleSamplesSize);
  check_sizes(s, &Sections::arcs, 4, 1, firmtouch::curve::kRuleArcsSize);
  check_sizes(s, &Sections::tree, 4, 4, firmtouch::curve::kRuleTreeSize);
}

TEST(Rule208RefusesABoxThatIsNotOneOrTooFarAway) {
  const float wrong[] = {nan_value(), __builtin_inff(), 1.1e9f};
  for (uint32_t k = 0; k < 3; ++k) {
    for (const float value : wrong) {
      SmallCurve c(kHook);
      c.head.high_m[k] = value;
      expect(c, firmtouch::curve::kRuleHeadBox, k);
      c.head.high_m[k] = SmallCurve(kHook).head.high_m[k];
      c.head.low_m[k] = -value;
      expect(c, firmtouch::curve::kRuleHeadBox, k);
    }
    SmallCurve c(kHook);
    c.head.low_m[k] = c.head.high_m[k] + 1.0f;
    expect(c, firmtouch::curve::kRuleHeadBox, k);
  }
}

TEST(Rule209RefusesAnotherDiagonalAndACurveOfNoSize) {
  SmallCurve c(kHook);
  c.head.diagonal_m *= 1.0f + 0x1p-23f;
  expect(c, firmtouch::curve::kRuleDiagonal, 0);
  c.head.diagonal_m = nan_value();
  expect(c, firmtouch::curve::kRuleDiagonal, 0);
  const Sample dust[] = {{0, 0, 0}, {0x1p-22f, 0, 0}};
  expect(SmallCurve(dust), firmtouch::curve::kRuleDiagonal, 0);
}

TEST(Rule210RefusesALengthShorterThanTheBoxAllowsOrEndless) {
  const float wrong[] = {nan_value(), __builtin_inff(), 0.0f, -1.0f};
  for (const float value : wrong) {
    SmallCurve c(kHook);
    c.head.length_m = value;
    expect(c, firmtouch::curve::kRuleLength, 0);
  }
}

TEST(Rule211RefusesSamplesOutsideTheBoxAndNaN) {
  for (uint32_t k = 0; k < 3; ++k) {
    SmallCurve c(kHook);
    (&c.samples[2].x_m)[k] = 0.75f;
    expect(c, firmtouch::curve::kRuleSampleOutside, 2);
    (&c.samples[2].x_m)[k] = nan_value();
    expect(c, firmtouch::curve::kRuleSampleOutside, 2);
  }
}

TEST(Rule212RefusesABoxWiderThanTheSamples) {
  for (uint32_t k = 0; k < 3; ++k) {
    SmallCurve c(kHook);
    c.head.high_m[k] += 0.25f;
    c.head.diagonal_m = firmtouch::curve::diagonal_m(c.head);
    c.derive_runs();
    expect(c, firmtouch::curve::kRuleLooseBox, k);
  }
}

TEST(Rule213RefusesAClosednessThatTheSamplesDeny) {
  SmallCurve c(kHook);
  c.head.is_closed = 1;
  expect(c, firmtouch::curve::kRuleClosure, 0);
  SmallCurve ring(kRing);
  ring.head.is_closed = 0;
  expect(ring, firmtouch::curve::kRuleClosure, 0);
}

TEST(Rule214RefusesArcPositionsOutsideZeroToOneAndLooseEnds) {
  SmallCurve c(kHook);
  c.arcs[2] = nan_value();
  expect(c, firmtouch::curve::kRuleArcRange, 2);
  c.arcs[2] = -0x1p-30f;
  expect(c, firmtouch::curve::kRuleArcRange, 2);
  c = SmallCurve(kHook);
  c.arcs[5] = 1.0f + 0x1p-23f;
  expect(c, firmtouch::curve::kRuleArcRange, 5);
  c.arcs[5] = 1.0f - 0x1p-24f;
  expect(c, firmtouch::curve::kRuleArcRange, 5);
  c = SmallCurve(kHook);
  c.arcs[0] = 0x1p-30f;
  expect(c, firmtouch::curve::kRuleArcRange, 0);
}

TEST(Rule215RefusesASampleThatRepeatsTheOneBefore) {
  const Sample repeated[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0x1p-41f}, {2, 0, 0}};
  expect(SmallCurve(repeated), firmtouch::curve::kRuleSpacing, 2);
}

TEST(Rule216RefusesArcPositionsThatRunBackwards) {
  const Sample close[] = {{0, 0, 0}, {1, 0, 0}, {1, 0x1p-30f, 0}, {2, 0, 0}};
  SmallCurve c(close);
  c.arcs[2] = c.arcs[1] - 0x1p-24f;  // less than what rule 217 would notice
  expect(c, firmtouch::curve::kRuleArcOrder, 2);
}

TEST(Rule217RefusesArcPositionsThatTheSamplesDeny) {
  SmallCurve c(kHook);
  c.arcs[3] += 0x1p-19f;
  expect(c, firmtouch::curve::kRuleArcValue, 3);
  c = SmallCurve(kHook);
  c.head.length_m *= 1.0f + 0x1p-10f;
  expect(c, firmtouch::curve::kRuleArcValue, 1);
}

TEST(Rule218RefusesNodesThatNameNoSampleOrNoAxis) {
  SmallCurve c(kHook);
  c.tree[5] = firmtouch::curve::make_node(6, 0);
  expect(c, firmtouch::curve::kRuleTreeNode, 5);
  c = SmallCurve(kHook);
  c.tree[5] |= 3u << 30;
  expect(c, firmtouch::curve::kRuleTreeNode, 5);
}

TEST(Rule219RefusesASampleOnTheWrongSideOfANodeAbove) {
  SmallCurve c(kHook);
  const uint32_t moved = c.tree[3];
  c.tree[3] = c.tree[5];  // one stands below the first child, one below the second
  c.tree[5] = moved;
  expect(c, firmtouch::curve::kRuleTreeOrder, 3);
}

TEST(Rule219RefusesASampleThatStandsInTwoNodes) {
  for (uint32_t to = 0; to < 6; ++to) {
    for (uint32_t from = 0; from < 6; ++from) {
      if (to == from) continue;
      SmallCurve c(kHook);
      const uint32_t axis = firmtouch::curve::axis_of(c.tree[to]);
      c.tree[to] = firmtouch::curve::make_node(firmtouch::curve::sample_of(c.tree[from]), axis);
      CHECK_EQ(verdict_of(c.sections()).rule, firmtouch::curve::kRuleTreeOrder);
    }
  }
}

TEST(Rule221RefusesBoxesAndRunsOfAnotherCount) {
  const Sections s = long_hook().sections();
  check_sizes(s, &Sections::boxes, 12, 12, firmtouch::curve::kRuleRunsSize);
  check_sizes(s, &Sections::runs, 8, 8, firmtouch::curve::kRuleRunsSize);
  check_sizes(s, &Sections::radii, 2, 2, firmtouch::curve::kRuleRunsSize);
}

TEST(Rule222RefusesAGridThatItsBoundsDoNotHoldOn) {
  const float cells[] = {nan_value(), 0.0f, 1.0f / 3.0f, -0x1p-14f, 0x1p-70f, 0x1p70f};
  for (const float cell_m : cells) {
    SmallCurve c(kHook);
    c.head.cell_m = cell_m;
    expect(c, firmtouch::curve::kRuleGrid, 0);
  }
  SmallCurve c(kHook);
  c.head.cell_m *= 4.0f;
  expect(c, firmtouch::curve::kRuleGrid, 1);
  for (uint32_t k = 0; k < 3; ++k) {
    const float moves[] = {nan_value(), 0.01f, -0.8f};
    for (const float move_m : moves) {
      c = SmallCurve(kHook);
      c.head.grid_low_m[k] += move_m;
      expect(c, firmtouch::curve::kRuleGrid, 2 + k);
    }
  }
}

TEST(Rule223RefusesAnotherLongestSegment) {
  SmallCurve c(kHook);
  const float wrong[] = {nan_value(), 0.0f, c.head.longest_half_m * (1.0f + 0x1p-23f)};
  for (const float value : wrong) {
    c.head.longest_half_m = value;
    expect(c, firmtouch::curve::kRuleLongestHalf, 0);
  }
}

TEST(Rule224RefusesABoxThatIsInvertedOrOffTheGrid) {
  LongCurve c = long_hook();
  c.boxes[4].side[1] = firmtouch::query::make_axis(700, 699);
  expect(c, firmtouch::curve::kRuleBoxRange, 4);
  c = long_hook();
  c.boxes[4].side[2] |= 0x80000000u;
  expect(c, firmtouch::curve::kRuleBoxRange, 4);
}

TEST(Rule225RefusesABoxThatLeavesTheOneAbove) {
  for (uint32_t k = 0; k < 3; ++k) {
    for (uint32_t side = 0; side < 2; ++side) {
      LongCurve c = long_hook();
      c.boxes[2].side[k] = c.boxes[0].side[k] - (side == 0 ? 1u : 0x10000u);
      expect(c, firmtouch::curve::kRuleBoxNesting, 2);
    }
  }
}

TEST(Rule226RefusesRunsAndLeavesThatAreNotOneToOne) {
  const uint32_t wrong[] = {1u, 2u, 99u, 0xFFFFFFFFu};
  for (const uint32_t other : wrong) {
    LongCurve c = long_hook();
    c.runs[0].leaf = other;
    CHECK_EQ(verdict_of(c.sections()).rule, firmtouch::curve::kRuleRunOrder);
    c = long_hook();
    c.runs[0].run = other;
    CHECK_EQ(verdict_of(c.sections()).rule, firmtouch::curve::kRuleRunOrder);
  }
}

TEST(Rule227RefusesASampleThatLeavesTheBoxOfItsRun) {
  for (uint32_t k = 0; k < 3; ++k) {
    for (uint32_t side = 0; side < 2; ++side) {
      LongCurve c = long_hook();
      c.boxes[2 * (c.run_count() - 1)].side[k] += side == 0 ? 1u : 0x10000u;  // run 0
      CHECK_EQ(verdict_of(c.sections()).rule, firmtouch::curve::kRuleRunBox);
    }
  }
}

TEST(Rule228RefusesAnyOtherRadius) {
  for (uint32_t i = 0; i < long_hook().run_count(); ++i) {
    for (uint32_t k = 0; k < 31; ++k) {
      LongCurve c = long_hook();
      c.radii[32 * i + k] ^= 1;
      expect(c, firmtouch::curve::kRuleRadius, i);
    }
  }
}

TEST(Rule229RefusesARadiusBeyondThePartsOfARun) {
  LongCurve c = long_hook();
  c.radii[32 + 31] = 1;
  expect(c, firmtouch::curve::kRuleRadiusPadding, 1);
}

TEST(Rule231RefusesRunsTooShortOrTooLong) {
  const uint32_t wrong[] = {0u, 1u, 9u, 0xFFFFFFFFu};
  for (const uint32_t levels : wrong) {
    LongCurve c = long_hook();
    c.head.run_levels = levels;
    Sections s = c.sections();
    CHECK_EQ(verdict_of({s.head, s.samples, s.arcs, s.tree, {}, {}, {}}).rule,
             firmtouch::curve::kRuleRunLevels);
  }
}

TEST(RunsOfEveryLengthAreGood) {
  for (uint32_t levels = 2; levels <= 8; ++levels) {
    LongCurve c = long_hook();
    c.head.run_levels = levels;
    c.derive_runs();
    expect(c, 0, 0);
    CHECK_EQ(c.view().run_levels(), levels);
    c.radii[0] ^= 1;
    expect(c, firmtouch::curve::kRuleRadius, 0);
  }
}

TEST(FlippedBit_IsRejectedByARule_OrQueriesStayWithinBounds) {
  static SmallCurve c(kHook);
  uint32_t refused = 0, kept = 0;
  uint8_t* const parts[] = {
      reinterpret_cast<uint8_t*>(&c.head), reinterpret_cast<uint8_t*>(c.samples),
      reinterpret_cast<uint8_t*>(c.arcs),  reinterpret_cast<uint8_t*>(c.tree),
      reinterpret_cast<uint8_t*>(c.boxes), reinterpret_cast<uint8_t*>(c.runs),
      reinterpret_cast<uint8_t*>(c.radii)};
  const uint32_t sizes[] = {68, 72, 24, 24, 12, 8, 64};
  const Sections sections = c.sections();  // of these sizes, whatever the head says
  for (uint32_t part = 0; part < 7; ++part) {
    for (uint32_t bit = 0; bit < 8 * sizes[part]; ++bit) {
      uint8_t& byte = parts[part][bit / 8];
      const auto flipped = static_cast<uint8_t>(byte ^ (1u << (bit % 8)));
      const uint8_t before = byte;
      byte = flipped;
      View view;
      const bool is_open = firmtouch::curve::open(sections, view).ok();
      byte = before;
      if (!is_open) {
        ++refused;
        continue;
      }
      ++kept;
      byte = flipped;
      firmtouch::curve::Hint hint;
      const firmtouch::curve::Closest found =
          firmtouch::curve::closest_point(view, {0.3f, -0.2f, 0.1f}, {6}, hint);
      byte = before;
      CHECK(found.distance_m - found.distance_m <= 0.0f);
      CHECK(found.tangent.x - found.tangent.x <= 0.0f);
      CHECK(found.arc >= 0.0f && found.arc <= 1.0f);
      CHECK_LT(found.segment, 5u);
      CHECK_LE(found.certificate.steps, 6u);
    }
  }
  CHECK_GE(refused, 1200u);
  CHECK_GE(kept, 1u);  // the last bits of a coordinate move a sample by less than any rule detects
}
