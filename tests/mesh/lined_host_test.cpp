// Leaves as a processor with vector instructions reads them tell what leaves in turn tell, and what a prism
// leaves out is told farther.
#include <cmath>

#include "bake/mesh/prism.hpp"
#include "harness/test.hpp"
#include "random_leaf.hpp"
#include "surface/point.hpp"

namespace {

using namespace mesh_test;  // NOLINT: a test file

// The rows of a leaf's block, among values that are no triangle's.
struct Rows {
  float corners[mesh::kRowsOfCorners * kTriangles + mesh::kMaxLanes];
  float prisms[mesh::kRowsOfPrisms * kTriangles + mesh::kMaxLanes];
  float shapes[mesh::kRowsOfShapes * kTriangles + mesh::kMaxLanes];
  mesh::Ahead ahead{};

  Rows(const Leaf& leaf, uint32_t child, const mesh::Block& block) {
    for (float& f : corners) f = coordinate(true);
    for (float& f : prisms) f = coordinate(true);
    for (float& f : shapes) f = coordinate(true);
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      const math::Vec3 a = corner(leaf, i, 0), b = corner(leaf, i, 1), c = corner(leaf, i, 2);
      put({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z}, i, block, corners);
      float prism[mesh::kRowsOfPrisms];
      firmtouch::tools::put_prism(a, b, c, prism);
      put(prism, i, block, prisms);
    }
    const mesh::Block own{mesh::leaf_first(child), mesh::leaf_count(child)};
    for (uint32_t i = own.first; i < own.first + own.count; ++i) {
      float shape[mesh::kRowsOfShapes];
      mesh::put_rows(shape_at(leaf, i), shape);
      put(shape, i, own, shapes);
    }
    ahead.corners = corners;
    ahead.prisms = prisms;
    ahead.shapes = shapes;
  }

 private:
  template <size_t kRows>
  static void put(const float (&values)[kRows], uint32_t triangle, const mesh::Block& block,
                  float* rows) {
    for (uint32_t row = 0; row < kRows; ++row)
      rows[kRows * block.first + row * block.count + (triangle - block.first)] = values[row];
  }
};

// A block of as many triangles as a Float holds or of fewer, anywhere.
template <class Float>
mesh::Block any_block() {
  const uint32_t count = 1 + next_random() % math::kLanesOf<Float>;
  return {next_random() % (kTriangles - count + 1), count};
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
template <class Float>
void compare_what_may_be_nearer(uint32_t turn, Reported& reported) {
  const Leaf leaf = flattened(turn);
  const float slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
  const mesh::Block block = any_block<Float>();
  const Rows rows(leaf, mesh::make_leaf(block.first, 1), block);
  for (uint32_t other = 0; other < block.count; ++other) {
    const float upper2_m2 = closest_on(leaf, block.first + other).distance2_m2;
    if (!(upper2_m2 <= FLT_MAX)) continue;
    const float scales[] = {1.0f, 1.0f + 0x1p-20f, 1.0f - 0x1p-20f, 0.9f};
    for (const float scale : scales) {
      const float min2_m2 = upper2_m2 * scale;
      const uint32_t may_be = mesh::may_be_nearer<Float>(mesh::Lined(rows.ahead, block), leaf.p_m,
                                                         mesh::prism_limit2(min2_m2, slack_m2));
      for (uint32_t lane = 0; lane < block.count; ++lane) {
        const float at2_m2 = closest_on(leaf, block.first + lane).distance2_m2;
        reported.farther += at2_m2 > min2_m2 * 1.1f + slack_m2 ? 1u : 0u;
        if ((may_be >> lane & 1u) != 0) continue;
        ++reported.left_out;
        if (at2_m2 <= min2_m2) ++reported.wrong;  // a triangle that is a point is told no number
      }
    }
  }
}

// Whether a triangle of the block that is none of the leaf is told nearer than `min2_m2`.
bool has_nearer_beside(const Leaf& leaf, uint32_t child, const mesh::Block& block, float min2_m2) {
  for (uint32_t i = block.first; i < block.first + block.count; ++i)
    if (i - mesh::leaf_first(child) >= mesh::leaf_count(child) &&
        closest_on(leaf, i).distance2_m2 < min2_m2)
      return true;
  return false;
}

struct Compared {
  uint32_t differ = 0, improved = 0, wrongly_clear = 0, clear = 0;
};

template <class Float>
void compare_leaves(uint32_t turn, Compared& compared) {
  const Leaf leaf = flattened(turn);
  const float slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
  const mesh::Block block = any_block<Float>();
  const uint32_t most = block.count < 7 ? block.count : 7, count = 1 + next_random() % most;
  const uint32_t first = block.first + next_random() % (block.count - count + 1);
  const uint32_t child = mesh::make_leaf(first, count);
  const Rows rows(leaf, child, block);
  const mesh::Lined lined(rows.ahead, mesh::make_lined(child, block));
  const float bound2_m2 = turn % 5 == 0 ? 0.25f : FLT_MAX;
  mesh::Best in_turn;
  const float min2_m2 = measured_in_turn(leaf, child, bound2_m2, in_turn);
  compared.improved += min2_m2 < bound2_m2 ? 1u : 0u;
  mesh::Best at_once, beside;
  const float upper2_m2[] = {
      mesh::measure_lined<Float>(lined, leaf.p_m, 5, bound2_m2, at_once),
      mesh::measure_lined_beside<Float>(lined, leaf.p_m, 5, bound2_m2,
                                        mesh::prism_limit2(bound2_m2, slack_m2), beside)};
  compared.differ += same(upper2_m2[0], min2_m2) && same(at_once, in_turn) ? 0u : 1u;
  compared.differ += same(upper2_m2[1], min2_m2) && same(beside, in_turn) ? 0u : 1u;
  if (bound2_m2 < FLT_MAX) return;
  const uint32_t lasts[] = {in_turn.triangle, first, next_random()};
  for (const uint32_t last : lasts) {
    mesh::Best best;
    const uint32_t clear =
        mesh::measure_lined_last<Float>(lined, leaf.p_m, 5, last & 0xFFFFu, slack_m2, best);
    compared.differ += same(best, in_turn) ? 0u : 1u;
    if (clear == firmtouch::query::kNowhere) continue;
    ++compared.clear;
    compared.wrongly_clear +=
        clear != block.first || has_nearer_beside(leaf, child, block, best.distance2_m2) ? 1u : 0u;
  }
}

// The units of 2^-24 that a stored prism is off by, at most: mesh/prism.hpp counts with 4, 8 and 4.
struct Off {
  double longer = 0, skew = 0, beyond = 0;
  uint32_t nothing_reported = 0;  // of how many the normal is 0

  void add(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m) {
    using namespace firmtouch::tools;  // NOLINT: its points
    float row[mesh::kRowsOfPrisms];
    put_prism(a_m, b_m, c_m, row);
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
    nothing_reported += length(n) > 0 ? 0u : 1u;
  }

 private:
  static void most(double& so_far, double v) { so_far = v <= so_far ? so_far : v; }
};

}  // namespace

TEST(WhatIsStoredOfAPrismIsNoWorseThanCountedWith) {
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
  CHECK_LT(500u, off_of_needles.nothing_reported);
  CHECK_LT(off_of_needles.nothing_reported, 19500u);
}

TEST(WhatAPrismLeavesOutIsToldFarther) {
  Reported four, wide;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    compare_what_may_be_nearer<math::Float4>(turn, four);
    compare_what_may_be_nearer<math::FloatWide>(turn, wide);
  }
  CHECK_EQ(four.wrong, 0u);
  CHECK_EQ(wide.wrong, 0u);
  CHECK_LT(four.farther / 2, four.left_out);
  CHECK_LT(wide.farther / 2, wide.left_out);
}

TEST(ALeafReadAheadTellsWhatALeafInTurnTells) {
  Compared compared;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    compare_leaves<math::Float4>(turn, compared);
    compare_leaves<math::FloatWide>(turn, compared);
  }
  CHECK_EQ(compared.differ, 0u);
  CHECK_EQ(compared.wrongly_clear, 0u);
  CHECK_LT(20000u, compared.improved);
  CHECK_LT(20000u, compared.clear);
}
