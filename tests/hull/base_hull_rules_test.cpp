// The reject rules of a base hull, each condition tripped alone.
#include "small_hull.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using hull_test::refusal_with;
using hull_test::rule_with;
using hull_test::SmallHull;
using test::shorter;

}  // namespace

TEST(R540BaseHullOfTheWrongSize) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.sections.base_hull = {}; }), 540'000u);
  CHECK_EQ(
      refusal_with([](SmallHull& h) { h.sections.base_hull = shorter(h.sections.base_hull, 4); }),
      540'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) {
             h.sections.base_hull = shorter(h.sections.base_hull, 4);
             h.base_hull_head().bytes -= 4;
           }),
           540'001u);
}

// Wherever it ends, also behind the part that queries read.
TEST(R540BaseHullThatEndsEarly) {
  SmallHull whole;
  const uint32_t resident =
      static_cast<uint32_t>(whole.base_hull_ids() - whole.sections.base_hull.data());
  for (uint32_t bytes = 4; bytes < whole.sections.base_hull.size();
       bytes += bytes < resident - 44 ? 44 : 4) {
    test::note("bytes", bytes);
    const uint32_t refusal = refusal_with([=](SmallHull& h) {
      h.base_hull_head().bytes = bytes;
      h.sections.base_hull = {h.sections.base_hull.data(), bytes};
    });
    CHECK_EQ(refusal, bytes < sizeof(hull::BaseHullHead) ? 540'000u : 540'001u);
  }
}

TEST(R541CountsOutOfRange) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().cut = h.head().collapse_count + 1; }),
           541'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.base_hull_head().face_count; }), 541'001u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().made_count = 65537; }), 541'002u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().made_count = UINT32_MAX; }),
           541'002u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().triangle_count = UINT32_MAX; }),
           541'003u);
}

TEST(R542BoxOutsideTheHulls) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().high_m[1] += 1.0f; }), 542'001u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_head().high_m[2] = __builtin_nanf(""); }),
           542'002u);
}

TEST(R542_OfABaseHullThatIsOpenedAlone) {
  SmallHull small;
  hull::View view;
  hull::BaseHull base_hull;
  CHECK(hull::open(small.sections, view).ok());
  CHECK(hull::open_base_hull(small.sections.base_hull, view, base_hull).ok());
  small.base_hull_head().low_m[2] -= 1.0f;
  CHECK_EQ(test::refusal(hull::open_base_hull(small.sections.base_hull, view, base_hull)),
           542'002u);
  CHECK(!base_hull.is_open());
}

TEST(R543VertexThatIsNotThere) {
  CHECK_EQ(refusal_with([](SmallHull& h) { __builtin_memset(h.base_hull_ids(), 0, 2); }), 543'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) { __builtin_memset(h.base_hull_ids() + 2, 255, 2); }),
           543'001u);
  SmallHull small;
  const uint32_t made = small.base_hull_head().made_count;
  CHECK_EQ(refusal_with([](SmallHull& h) {
             const uint8_t* id = h.base_hull_ids();  // a made one among those kept
             h.base_hull_kept()[0].id = id[0] | static_cast<uint32_t>(id[1]) << 8;
           }),
           543'000u + made);
  CHECK_EQ(refusal_with([](SmallHull& h) {  // the first id that is none
             uint32_t& id = h.base_hull_kept()[0].id;
             id = h.add_origin(id);
           }),
           543'000u + made);
}

TEST(R544VertexThatLiesElsewhere) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_coordinates()[6 * 2] ^= 1; }), 544'002u);
  SmallHull small;
  const uint32_t made = small.base_hull_head().made_count;
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_kept()[0].y_m += 0.001f; }),
           544'000u + made);
}

TEST(R545CornerOutOfRange) {
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_corners()[1] = 60000; }), 545'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) {  // the first vertex that is none
             h.base_hull_corners()[1] = static_cast<uint16_t>(h.base_hull_head().made_count +
                                                              h.base_hull_head().kept_count);
           }),
           545'000u);
  CHECK_EQ(refusal_with([](SmallHull& h) {  // the first corner that is none of the leaf's
             hull::BaseHullFace& face = h.base_hull_faces()[3];
             face = static_cast<hull::BaseHullFace>((face & 0xFF0Fu) | hull::corners_of(face) << 4);
           }),
           545'003u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[3] |= 0x00F0; }), 545'003u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[3] ^= 0x1000; }), 545'003u);
  CHECK_EQ(refusal_with([](SmallHull& h) { h.base_hull_faces()[4] |= 0xF000; }), 545'004u);
  CHECK_EQ(refusal_with([](SmallHull& h) { ++h.base_hull_corner_offsets()[1]; }), 545'008u);
  SmallHull whole;
  const uint32_t last = (whole.base_hull_leaves() - 1) * hull::kLeafFaces;
  CHECK_EQ(refusal_with([&](SmallHull& h) {
             for (uint32_t i = last; i < h.base_hull_head().face_count; ++i)
               h.base_hull_faces()[i] =
                   static_cast<hull::BaseHullFace>(h.base_hull_faces()[i] + 0x1000);
           }),
           545'000u + last);
  CHECK_EQ(rule_with([&](SmallHull& h) {  // one corner that no leaf has
             for (uint32_t i = last; i < h.base_hull_head().face_count; ++i)
               h.base_hull_faces()[i] =
                   static_cast<hull::BaseHullFace>(h.base_hull_faces()[i] - 0x1000);
           }),
           hull::kRuleBaseHullCorners);
}

TEST(R546TrianglesThatAreNotTheFaces) {
  SmallHull whole;
  CHECK(whole.base_hull_head().triangle_count > 1);
  CHECK_EQ(rule_with([](SmallHull& h) { h.base_hull_triangles()[0].triangle ^= 1; }),
           hull::kRuleBaseHullTriangles);
  CHECK_EQ(rule_with([](SmallHull& h) { ++h.base_hull_triangles()[0].face; }),
           hull::kRuleBaseHullTriangles);
  CHECK_EQ(rule_with([](SmallHull& h) { h.base_hull_triangles()[0].triangle = 60000; }),
           hull::kRuleBaseHullTriangles);
  CHECK_EQ(rule_with([](SmallHull& h) {  // the first triangle that is none
             uint32_t& triangle = h.base_hull_triangles()[0].triangle;
             triangle = h.add_triangle(triangle);
           }),
           hull::kRuleBaseHullTriangles);
}

TEST(R546TriangleThatIsNotListed) {
  constexpr uint32_t kBytes = sizeof(hull::BaseHullTriangle);
  SmallHull whole;
  const uint32_t last = whole.base_hull_head().triangle_count - 1;
  const uint32_t face = whole.base_hull_triangles()[last].face;
  CHECK_EQ(refusal_with([](SmallHull& h) {
             --h.base_hull_head().triangle_count;
             h.base_hull_head().bytes -= kBytes;
             h.sections.base_hull = shorter(h.sections.base_hull, kBytes);
           }),
           546'000u + face);
}

TEST(R547FaceOutsideItsLeaf) {
  CHECK_EQ(rule_with([](SmallHull& h) { h.base_hull_boxes()[3] = 255; }),
           hull::kRuleBaseHullLeafBox);
}

TEST(R548FacesThatDoNotClose) {
  const auto turned = [](SmallHull& h) {
    const uint32_t face = h.base_hull_faces()[0];
    h.base_hull_faces()[0] =
        static_cast<hull::BaseHullFace>((face & 0xFF00u) | (face & 15u) << 4 | (face >> 4 & 15u));
  };
  CHECK_EQ(refusal_with(turned), 548'000u);
}
