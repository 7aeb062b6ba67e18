// The reject rules of a base hull, each condition tripped alone.
#include "small_hull.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using hull_test::SmallHull;

template <class Change>
uint32_t refusal_with(Change change) {
  SmallHull small;
  change(small);
  hull::View view;
  const core::Verdict verdict = hull::open(small.sections, view);
  CHECK_EQ(verdict.ok(), view.is_open());
  return verdict.rule * 1000u + verdict.element;
}

core::Bytes shorter(core::Bytes bytes, uint32_t by) { return {bytes.data(), bytes.size() - by}; }

}  // namespace

TEST(R540BaseHullOfTheWrongSize) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.sections.base_hull = {}; }),
           hull::kRuleBaseHullSize * 1000u);
  CHECK_EQ(
      refusal_with([](SmallHull& h) { h.sections.base_hull = shorter(h.sections.base_hull, 4); }),
      hull::kRuleBaseHullSize * 1000u);
  CHECK_EQ(refusal_with([](SmallHull& h) {
             h.sections.base_hull = shorter(h.sections.base_hull, 4);
             h.base_hull_head().bytes -= 4;
           }),
           hull::kRuleBaseHullSize * 1000u + 1u);
}

TEST(R541CountsOutOfRange) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().cut = h.head().collapse_count + 1; }),
           hull::kRuleBaseHullCounts * 1000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.base_hull_head().face_count; }),
           hull::kRuleBaseHullCounts * 1000u + 1u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().made_count = 65537; }),
           hull::kRuleBaseHullCounts * 1000u + 2u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().made_count = UINT32_MAX; }),
           hull::kRuleBaseHullCounts * 1000u + 2u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().triangle_count = UINT32_MAX; }),
           hull::kRuleBaseHullCounts * 1000u + 3u);
}

TEST(R542BoxOutsideTheHulls) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().high_m[1] += 1.0f; }),
           hull::kRuleBaseHullBox * 1000u + 1u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().high_m[2] = __builtin_nanf(""); }),
           hull::kRuleBaseHullBox * 1000u + 2u);
}

TEST(R543VertexThatIsNotThere) {
  CHECK_EQ(refusal_with([](SmallHull& h) { __builtin_memset(h.base_hull_ids(), 0, 2); }),
           hull::kRuleBaseHullVertex * 1000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { __builtin_memset(h.base_hull_ids() + 2, 255, 2); }),
           hull::kRuleBaseHullVertex * 1000u + 1u);
  SmallHull small;
  const uint32_t made = small.base_hull_head().made_count;
  CHECK_EQ(refusal_with([](SmallHull& h) {
             const uint8_t* id = h.base_hull_ids();  // a made one among those kept
             h.base_hull_kept()[0].id = id[0] | static_cast<uint32_t>(id[1]) << 8;
           }),
           hull::kRuleBaseHullVertex * 1000u + made);
}

TEST(R544VertexThatLiesElsewhere) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_coordinates()[6 * 2] ^= 1; }),
           hull::kRuleBaseHullPosition * 1000u + 2u);
  SmallHull small;
  const uint32_t made = small.base_hull_head().made_count;
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_kept()[0].y_m += 0.001f; }),
           hull::kRuleBaseHullPosition * 1000u + made);
}

TEST(R545CornerOutOfRange) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_corners()[1] = 60000; }),
           hull::kRuleBaseHullCorners * 1000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[3] |= 0x00F0; }),
           hull::kRuleBaseHullCorners * 1000u + 3u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[3] ^= 0x1000; }),
           hull::kRuleBaseHullCorners * 1000u + 3u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[4] |= 0xF000; }),
           hull::kRuleBaseHullCorners * 1000u + 4u);
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.base_hull_corner_offsets()[1]; }),
           hull::kRuleBaseHullCorners * 1000u + 8u);
  SmallHull whole;
  const uint32_t last = (whole.base_hull_leaves() - 1) * hull::kLeafFaces;
  CHECK_EQ(refusal_with([&](SmallHull& h) {
             for (uint32_t i = last; i < h.base_hull_head().face_count; ++i)
               h.base_hull_faces()[i] =
                   static_cast<hull::BaseHullFace>(h.base_hull_faces()[i] + 0x1000);
           }),
           hull::kRuleBaseHullCorners * 1000u + last);
  CHECK_EQ(refusal_with([&](SmallHull& h) {  // one corner that no leaf has
             for (uint32_t i = last; i < h.base_hull_head().face_count; ++i)
               h.base_hull_faces()[i] =
                   static_cast<hull::BaseHullFace>(h.base_hull_faces()[i] - 0x1000);
           }) / 1000,
           hull::kRuleBaseHullCorners);
}

TEST(R546TrianglesThatAreNotTheFaces) {
  SmallHull whole;
  CHECK(whole.base_hull_head().triangle_count > 1);
  const auto rule = [](uint32_t refusal) { return refusal / 1000; };
  CHECK_EQ(rule(refusal_with([](SmallHull& h) { h.base_hull_triangles()[0].triangle ^= 1; })),
           hull::kRuleBaseHullTriangles);
  CHECK_EQ(rule(refusal_with([](SmallHull& h) { ++h.base_hull_triangles()[0].face; })),
           hull::kRuleBaseHullTriangles);
  CHECK_EQ(rule(refusal_with([](SmallHull& h) { h.base_hull_triangles()[0].triangle = 60000; })),
           hull::kRuleBaseHullTriangles);
}

TEST(R547FaceOutsideItsLeaf) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_boxes()[3] = 255; }) / 1000,
           hull::kRuleBaseHullLeafBox);
}

TEST(R548FacesThatDoNotClose) {
  const auto turned = [](SmallHull& h) {
    const uint32_t face = h.base_hull_faces()[0];
    h.base_hull_faces()[0] =
        static_cast<hull::BaseHullFace>((face & 0xFF00u) | (face & 15u) << 4 | (face >> 4 & 15u));
  };
  CHECK_EQ(refusal_with(turned), hull::kRuleBaseHullOpen * 1000u);
}
