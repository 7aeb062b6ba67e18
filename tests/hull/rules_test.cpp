// The reject rules of a hull, each condition tripped alone.
#include "harness/rules.hpp"
#include "harness/float_bits.hpp"
#include "small_hull.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using hull_test::refusal_with;
using hull_test::rule_with;
using hull_test::SmallHull;
using test::nan_value;
using test::shorter;

}  // namespace

TEST(WholeHullPasses) {
  SmallHull small;
  CHECK_EQ(refusal_with([](SmallHull&) {}), 0u);
  CHECK(small.head().collapse_count >= 50);
  CHECK(small.base_hull_head().kept_count > 0);
}

TEST(R501HeadOfTheWrongSize) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.sections.head = shorter(h.sections.head, 4); }),
           501'000u);
}

TEST(R502CountsThatAreNotTheMeshs) {
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.head().mesh_vertex_count; }), 502'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.head().mesh_triangle_count; }), 502'001u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().collapse_count = 129; }), 502'002u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().collapse_count = UINT32_MAX; }), 502'002u);
}

TEST(R503WidthsThatAreNeitherTwoNorThree) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().id_bytes = 4; }), 503'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().coordinate_bytes = 1; }), 503'001u);
}

TEST(R504To509SectionsOfTheWrongSize) {
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.vertices = shorter(h.sections.vertices, 6); }),
           hull::kRuleVerticesSize);
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.origins = shorter(h.sections.origins, 2); }),
           hull::kRuleOriginsSize);
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.records = shorter(h.sections.records, 2); }),
           hull::kRuleRecordsSize);
  CHECK_EQ(rule_with([](SmallHull& h) {
             h.sections.record_offsets = shorter(h.sections.record_offsets, 4);
           }),
           hull::kRuleRecordOffsetsSize);
  CHECK_EQ(
      rule_with([](SmallHull& h) { h.sections.star_boxes = shorter(h.sections.star_boxes, 6); }),
      hull::kRuleStarBoxesSize);
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.boxes = shorter(h.sections.boxes, 6); }),
           hull::kRuleBoxesSize);
}

TEST(R510GridThatIsNone) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().grid_low_m[0] = -2e8f; }), 510'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().grid_low_m[1] = nan_value(); }), 510'001u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().grid_low_m[2] = 2e8f; }), 510'002u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().cell_m *= 1.5f; }), 510'003u);
}

TEST(R511BoxThatDoesNotHoldTheMesh) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().low_m[0] = nan_value(); }), 511'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.head().high_m[2] = h.head().low_m[2]; }), 511'001u);
}

TEST(R512To515AMeshThatIsNone) {
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.mesh_head = {}; }), hull::kRuleMeshHead);
  CHECK_EQ(rule_with([](SmallHull& h) {
             h.sections.mesh_vertices = shorter(h.sections.mesh_vertices, 12);
           }),
           hull::kRuleMeshVerticesSize);
  CHECK_EQ(rule_with([](SmallHull& h) { h.sections.triangles16 = {}; }),
           hull::kRuleMeshTrianglesSize);
  CHECK_EQ(rule_with([](SmallHull& h) { h.mesh_head().high_m[1] = 2e8f; }), hull::kRuleMeshBox);
}

TEST(R520VertexOutsideTheMeshsBox) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.mesh_coordinate(7) = 50.0f; }), 520'002u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.mesh_coordinate(0) = nan_value(); }), 520'000u);
}

TEST(R521NumberOutOfRange) {
  CHECK_EQ(refusal_with([](SmallHull& h) { SmallHull::open_up(h.sections.origins)[11] = 0xFF; }),
           521'005u);
}

TEST(R523NumbersThatTwoIdsShare) {
  const auto twice = [](SmallHull& h) {
    uint8_t* origins = SmallHull::open_up(h.sections.origins);
    __builtin_memcpy(origins, origins + 2, 2);
  };
  CHECK_EQ(rule_with(twice), hull::kRuleOriginTwice);
}

TEST(R524RecordsThatDoNotStandWhereTheyShould) {
  CHECK_EQ(
      refusal_with([](SmallHull& h) { SmallHull::open_up(h.sections.record_offsets)[4] += 2; }),
      524'008u);
  const auto long_last = [](SmallHull& h) {
    uint8_t* last = h.record(h.head().collapse_count - 1);
    last[1] = static_cast<uint8_t>(last[1] | 0xFC);
  };
  CHECK_EQ(rule_with(long_last), hull::kRuleRecordOffset);
}

TEST(R525StarsThatAreNone) {
  CHECK_EQ(refusal_with([](SmallHull& h) {
             uint8_t* record = h.record(3);
             record[0] = static_cast<uint8_t>(record[0] & 0x1F);
             record[1] = static_cast<uint8_t>(record[1] & 0xFC);
           }),
           525'003u);
}

TEST(R526CornersThatAreGoneOrNotYetThere) {
  CHECK_EQ(refusal_with([](SmallHull& h) { SmallHull::set_id(h.record(9), 1, 4); }), 526'009u);
  CHECK_EQ(refusal_with([](SmallHull& h) { SmallHull::set_id(h.record(9), 1, 65535); }), 526'009u);
  const auto first_that_is_none = [](SmallHull& h) {
    SmallHull::set_id(h.record(9), 1, h.add_origin(SmallHull::get_id(h.record(9), 1)));
  };
  CHECK_EQ(refusal_with(first_that_is_none), 526'009u);
  const auto too_young = [](SmallHull& h) {
    SmallHull::set_id(h.record(9), 1, SmallHull::get_id(h.record(20), 0));
  };
  CHECK_EQ(refusal_with(too_young), 526'009u);
}

TEST(R527NewVertexThatIsAnother) {
  const auto other = [](SmallHull& h) {
    SmallHull::set_id(h.record(5), 0, SmallHull::get_id(h.record(6), 0));
  };
  CHECK_EQ(refusal_with(other), 527'005u);
  const auto first_that_is_none = [](SmallHull& h) {
    SmallHull::set_id(h.record(5), 0, h.add_origin(SmallHull::get_id(h.record(5), 0)));
  };
  CHECK_EQ(refusal_with(first_that_is_none), 527'005u);
}

TEST(R528TrianglesThatAreNotTheStars) {
  const auto other = [](SmallHull& h) {
    uint8_t* record = h.record(0);
    const uint32_t at = 1 + hull::link_of(hull::View::head_of(record));
    SmallHull::set_id(record, at, SmallHull::get_id(record, at + 1));
  };
  CHECK_EQ(refusal_with(other), 528'000u);
  const auto first_that_is_none = [](SmallHull& h) {
    uint8_t* record = h.record(0);
    const uint32_t at = 1 + hull::link_of(hull::View::head_of(record));
    SmallHull::set_id(record, at, h.add_triangle(SmallHull::get_id(record, at)));
  };
  CHECK_EQ(refusal_with(first_that_is_none), 528'000u);
}

TEST(R529VertexOutsideTheHullsBox) {
  const auto outside = [](SmallHull& h) {
    for (uint32_t k = 0; k < 3; ++k)
      if (h.head().low_m[k] < h.mesh_head().low_m[k]) h.head().low_m[k] = h.mesh_head().low_m[k];
  };
  CHECK_EQ(rule_with(outside), hull::kRuleNewVertexOutside);
}

TEST(R530StarBoxThatDoesNotHoldItsStar) {
  const auto small = [](SmallHull& h) {
    __builtin_memset(SmallHull::open_up(h.sections.star_boxes) + 6 * 4, 0, 6);
  };
  CHECK_EQ(refusal_with(small), 530'004u);
}

TEST(R531BytesBehindTheLastRecord) {
  const auto fewer = [](SmallHull& h) {
    // The last record says fewer triangles than there are: what is over belongs to none.
    const uint32_t bytes = h.head().record_bytes + 4;
    h.head().record_bytes = bytes;
    h.sections.records = {h.sections.records.data(), bytes};
  };
  CHECK_EQ(rule_with(fewer), hull::kRuleRecordsEnd);
}

TEST(R532CornerOutOfRange) {
  CHECK_EQ(rule_with([](SmallHull& h) {
             h.head().collapse_count = 0;
             h.head().record_bytes = 0;
             h.sections.vertices = h.sections.records = h.sections.record_offsets = {};
             h.sections.star_boxes = {};
             h.sections.origins = {h.sections.origins.data(), 2 * h.head().mesh_vertex_count};
             for (uint32_t i = 0; i < h.head().mesh_vertex_count; ++i) {
               uint8_t* at = SmallHull::open_up(h.sections.origins) + 2 * i;
               at[0] = static_cast<uint8_t>(i);
               at[1] = static_cast<uint8_t>(i >> 8);
             }
             h.mesh_corner(4) = 60000;
           }),
           hull::kRuleTriangleCorner);
}

TEST(R533TriangleOutsideItsLeaf) {
  CHECK_EQ(rule_with([](SmallHull& h) { SmallHull::open_up(h.sections.boxes)[0] = 200; }),
           hull::kRuleLeafBox);
  const auto small_leaf = [](SmallHull& h) {
    uint8_t* last = SmallHull::open_up(h.sections.boxes) + h.sections.boxes.size() - 6;
    for (uint32_t k = 0; k < 3; ++k) last[k] = 255;
  };
  CHECK_EQ(rule_with(small_leaf), hull::kRuleLeafBox);
}

TEST(R534AFaceThatNobodyReplaces) {
  // A link turned about by two places replaces faces that are not there.
  const auto turned = [](SmallHull& h) {
    const uint32_t last = h.head().collapse_count - 1;
    for (uint32_t k = last; k > 0; --k) {
      uint8_t* record = h.record(k);
      const uint32_t word = hull::View::head_of(record), link = hull::link_of(word);
      if (hull::triangles_of(word) != 0) continue;
      const uint32_t first = SmallHull::get_id(record, 1);
      for (uint32_t i = 1; i < link; ++i)
        SmallHull::set_id(record, i, SmallHull::get_id(record, i + 1));
      SmallHull::set_id(record, link, first);
      return;
    }
  };
  CHECK_EQ(rule_with(turned), hull::kRuleFaces);
}
