// Leaves and blocks measured eight triangles at once have the bits of scalar ones, and a triangle
// that a prism excludes is farther.
#include <cmath>

#include "../mesh/random_leaf.hpp"
#include "harness/test.hpp"
#include "simd/prism.hpp"
#include "simd/search/leaf.hpp"
#include "surface/point.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// The rows of a leaf's block, among values that are no triangle's.
struct Rows {
  float corners[simd::kCornerArrays * kTriangles + simd::kLanes];
  float prisms[simd::kPrismArrays * kTriangles + simd::kLanes];
  float shapes[simd::kShapeArrays * kTriangles + simd::kLanes];
  simd::WideTree tree{};

  Rows(const Leaf& leaf, const simd::Block& block) {
    for (float& f : corners) f = coordinate(true);
    for (float& f : prisms) f = coordinate(true);
    for (float& f : shapes) f = coordinate(true);
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      const math::Vec3 a = corner(leaf, i, 0), b = corner(leaf, i, 1), c = corner(leaf, i, 2);
      put({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z}, i, block, corners);
      float prism[simd::kPrismArrays];
      simd::put_prism(a, b, c, prism);
      put(prism, i, block, prisms);
      float shape[simd::kShapeArrays];
      simd::put_floats(simd::shape_of(a, b, c), shape);
      put(shape, i, block, shapes);
    }
    tree.corners = corners;
    tree.prisms = prisms;
    tree.shapes = shapes;
  }

 private:
  template <size_t kRows>
  static void put(const float (&values)[kRows], uint32_t triangle, const simd::Block& block,
                  float* rows) {
    for (uint32_t row = 0; row < kRows; ++row)
      rows[kRows * block.first + row * block.count + (triangle - block.first)] = values[row];
  }
};

// A block of up to eight triangles, anywhere.
simd::Block any_block() {
  const uint32_t count = 1 + random_bits() % simd::kLanes;
  return {random_bits() % (kTriangles - count + 1), count};
}

// A leaf squeezed flat, to needles whose height is no float's difference at last.
Leaf flattened(uint32_t turn) {
  Leaf leaf(turn);
  const float by[] = {1.0f, 1.0f, 0x1p-6f, 0x1p-12f, 0x1p-22f, 0x1p-30f};
  for (mesh::Vertex& v : leaf.vertices) v.y_m *= by[turn % 6];
  turn_longest_first(leaf);
  return leaf;
}

struct Reported {
  uint32_t wrong = 0, left_out = 0, farther = 0;
};

// What is only just nearer than another or as near, too.
void compare_prisms(uint32_t turn, Reported& reported) {
  const Leaf leaf = flattened(turn);
  const float slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
  const simd::Block block = any_block();
  const Rows rows(leaf, block);
  for (uint32_t other = 0; other < block.count; ++other) {
    const float upper2_m2 = closest_on(leaf, block.first + other).distance2_m2;
    if (!(upper2_m2 <= FLT_MAX)) continue;
    const float scales[] = {1.0f, 1.0f + 0x1p-20f, 1.0f - 0x1p-20f, 0.9f};
    for (const float scale : scales) {
      const float min2_m2 = upper2_m2 * scale;
      const uint32_t may_be = simd::may_be_nearer(simd::BlockTriangles(rows.tree, block), leaf.p_m,
                                                  simd::prism_limit2(min2_m2, slack_m2));
      for (uint32_t lane = 0; lane < block.count; ++lane) {
        const float at2_m2 = closest_on(leaf, block.first + lane).distance2_m2;
        reported.farther += at2_m2 > min2_m2 * 1.1f + slack_m2 ? 1u : 0u;
        if ((may_be >> lane & 1u) != 0) continue;
        ++reported.left_out;
        if (at2_m2 <= min2_m2) ++reported.wrong;  // a triangle that is a point gives NaN
      }
    }
  }
}

// Whether a triangle of the block outside the leaf is reported nearer than `min2_m2`.
bool has_nearer_outside(const Leaf& leaf, uint32_t child, const simd::Block& block, float min2_m2) {
  for (uint32_t i = block.first; i < block.first + block.count; ++i)
    if (i - mesh::leaf_first(child) >= mesh::leaf_count(child) &&
        closest_on(leaf, i).distance2_m2 < min2_m2)
      return true;
  return false;
}

struct Compared {
  uint32_t differ = 0, improved = 0, wrongly_clear = 0, clear = 0;
};

// Whether a triangle that is taken at once is what measuring all of the leaf takes, without a
// rival.
bool begins_without_rivals(const simd::BlockTriangles& triangles, const Leaf& leaf, uint32_t last,
                           float slack_m2) {
  mesh::Rivals rivals{};
  rivals.clear();
  rivals.slack_m2 = 0.01f;
  const auto limit2 = [&rivals](float distance2_m2) { return rivals.limit2_m2(distance2_m2); };
  mesh::Best best, of_all;
  if (!simd::begin_at(triangles, leaf.p_m, 5, last & 0xFFFFu, slack_m2, limit2, best).is_taken)
    return true;
  simd::take_rivals(simd::feet_on(triangles, leaf.p_m), simd::CornerArrays(triangles),
                    triangles.lanes(), triangles.first, 5, of_all, rivals);
  return same(best, of_all) && rivals.count == 0;
}

void compare_leaves(uint32_t turn, Compared& compared) {
  const Leaf leaf = flattened(turn);
  const float slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
  const simd::Block block = any_block();
  const uint32_t most = block.count < 7 ? block.count : 7, count = 1 + random_bits() % most;
  const uint32_t first = block.first + random_bits() % (block.count - count + 1);
  const uint32_t child = mesh::make_leaf(first, count);
  const Rows rows(leaf, block);
  const simd::BlockTriangles triangles(rows.tree, simd::make_wide_leaf(child, block));
  const float bound2_m2 = turn % 5 == 0 ? 0.25f : FLT_MAX;
  mesh::Best scalar;
  const float min2_m2 = measured_one_by_one(leaf, child, bound2_m2, scalar);
  compared.improved += min2_m2 < bound2_m2 ? 1u : 0u;
  mesh::Best at_once, near;
  const float upper2_m2[] = {
      simd::measure_wide_leaf(triangles, leaf.p_m, 5, bound2_m2, at_once),
      simd::measure_near_leaf(triangles, leaf.p_m, 5, bound2_m2,
                              simd::prism_limit2(bound2_m2, slack_m2), near)};
  compared.differ += same(upper2_m2[0], min2_m2) && same(at_once, scalar) ? 0u : 1u;
  compared.differ += same(upper2_m2[1], min2_m2) && same(near, scalar) ? 0u : 1u;
  if (bound2_m2 < FLT_MAX) return;
  const uint32_t lasts[] = {scalar.triangle, first, random_bits()};
  for (const uint32_t last : lasts) {
    mesh::Best best;
    const auto same_distance2 = [](float distance2_m2) { return distance2_m2; };
    const simd::Begun begun =
        simd::begin_at(triangles, leaf.p_m, 5, last & 0xFFFFu, slack_m2, same_distance2, best);
    if (!begun.is_taken)
      simd::take_nearest(simd::feet_on(triangles, leaf.p_m), triangles.lanes(), first, 5, FLT_MAX,
                         best);
    compared.differ += same(best, scalar) ? 0u : 1u;
    compared.differ += begins_without_rivals(triangles, leaf, last, slack_m2) ? 0u : 1u;
    if (begun.clear == firmtouch::query::kNowhere) continue;
    ++compared.clear;
    compared.wrongly_clear +=
        begun.clear != block.first || has_nearer_outside(leaf, child, block, best.distance2_m2)
            ? 1u
            : 0u;
  }
}

// The units of 2^-24 that a stored prism is off by, at most: simd/search/prism_bound.hpp counts
// with 4, 8 and 4.
struct Off {
  double longer = 0, skew = 0, beyond = 0;
  uint32_t unbounded = 0;  // of how many the normal is 0

  void add(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m) {
    using namespace firmtouch::tools;  // NOLINT: its points
    float row[simd::kPrismArrays];
    simd::put_prism(a_m, b_m, c_m, row);
    const auto direction = [&row](uint32_t k) {
      return to_point(math::Vec3{row[k], row[k + 1], row[k + 2]});
    };
    const Point ab = to_point(b_m) - to_point(a_m), ac = to_point(c_m) - to_point(a_m),
                bc = ac - ab;
    const double longest = std::fmax(length(ab), std::fmax(length(ac), length(bc)));
    const Point n = direction(3);
    for (uint32_t k = 3; k < 15; k += 3) {
      const Point v = direction(k);
      most(longer, (length(v) - 1) * 0x1p24);
      if (k > 3) most(skew, std::fabs(dot(n, v)) * 0x1p24);
      const double out = k == 12 ? static_cast<double>(row[15]) : 0;
      const Point corners[] = {{}, ab, ac};
      for (const Point& q : corners) {
        const double along = k == 3 ? std::fabs(dot(v, q)) : dot(v, q) - out;
        if (longest > 0) most(beyond, along / longest * 0x1p24);
      }
    }
    unbounded += length(n) > 0 ? 0u : 1u;
  }

 private:
  static void most(double& so_far, double v) { so_far = v <= so_far ? so_far : v; }
};

}  // namespace

TEST(StoredPrism_IsWithinTheDerivedRounding) {
  Off off, off_of_needles;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    const Leaf leaf = flattened(turn);
    for (uint32_t i = 0; i < 3; ++i)
      off.add(corner(leaf, i, 0), corner(leaf, i, 1), corner(leaf, i, 2));
    // Where the cross product of two sides is all rounding, even in double.
    const float tiny = std::ldexp(1.0f, -30 - static_cast<int>(turn % 40)),
                far = 1.0f + unit() * 0.5f;
    off_of_needles.add({tiny * unit(), tiny * unit(), 0}, {far, far, far},
                       {far / 2, far / 2, far / 2});
  }
  const Off both[] = {off, off_of_needles};
  for (const Off& each : both) {
    CHECK_LT(each.longer, 4.0);
    CHECK_LT(each.skew, 8.0);
    CHECK_LT(each.beyond, 4.0);
  }
  CHECK_LT(500u, off_of_needles.unbounded);
  CHECK_LT(off_of_needles.unbounded, 19500u);
}

// From corners, by the formulas of a triangle alone.
TEST(EightTriangles_HaveTheBitsOfEach) {
  uint32_t differ = 0, seen[7] = {};
  for (uint32_t turn = 0; turn < 4000; ++turn) {
    const Leaf leaf(turn);
    const simd::Block block{0, simd::kLanes};
    const Rows rows(leaf, block);
    const simd::Feet feet = simd::feet_on(simd::BlockTriangles(rows.tree, block), leaf.p_m);
    const simd::Mask8 features = feet.features();
    for (uint32_t lane = 0; lane < simd::kLanes; ++lane) {
      const mesh::Foot foot = closest_on(leaf, lane);
      const math::Vec3 offset_m{simd::lane_of(feet.offset_m.x, lane),
                                simd::lane_of(feet.offset_m.y, lane),
                                simd::lane_of(feet.offset_m.z, lane)};
      differ += same(offset_m, foot.offset_m) &&
                        same(simd::lane_of(feet.distance2_m2, lane), foot.distance2_m2) &&
                        simd::lane_of(features, lane) == static_cast<int32_t>(foot.feature)
                    ? 0u
                    : 1u;
      ++seen[static_cast<uint32_t>(foot.feature)];
    }
  }
  CHECK_EQ(differ, 0u);
  for (const uint32_t times : seen) CHECK(times > 200u);
}

TEST(TriangleExcludedByItsPrism_IsFarther) {
  Reported reported;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    compare_prisms(turn, reported);
  }
  CHECK_EQ(reported.wrong, 0u);
  CHECK_LT(reported.farther / 2, reported.left_out);
}

TEST(WideLeaf_HasTheBitsOfTheScalarLeaf) {
  Compared compared;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    compare_leaves(turn, compared);
  }
  CHECK_EQ(compared.differ, 0u);
  CHECK_EQ(compared.wrongly_clear, 0u);
  CHECK_LT(10000u, compared.improved);
  CHECK_LT(10000u, compared.clear);
}
