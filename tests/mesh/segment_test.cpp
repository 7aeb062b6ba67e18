// Segments through a cube: on the host and on the controller, with the same bits.

#include "cube.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "harness/float_bits.hpp"
#include "harness/test.hpp"

namespace {

using firmtouch::math::Vec3;
using namespace firmtouch;  // NOLINT: a test file

uint32_t g_random = 1;
float random_in(float low, float high) {
  g_random = g_random * 1664525u + 1013904223u;
  const float part = (high - low) * static_cast<float>(g_random >> 8) * 0x1p-24f;
  return low + part;
}

// Corners, middles of edges and of sides, points of the sides' diagonals, and others.
Vec3 aim(uint32_t i) {
  constexpr float kOf[] = {-1, 0, 1};
  if (i % 2 == 0)
    return {kOf[(g_random >> 9) % 3], kOf[(g_random >> 13) % 3], kOf[(g_random >> 17) % 3]};
  const float u = random_in(-1, 1), v = random_in(-1.5f, 1.5f), w = random_in(-1.5f, 1.5f);
  if (i % 6 == 1) return {u, u, 1};
  return {u, v, w};
}

struct Reported {
  mesh::SurfaceCrossing buffer[16];
  mesh::Crossings all;
  int balance() const {
    int sum = 0;
    for (uint32_t i = 0; i < all.reported; ++i) sum += buffer[i].enters ? -1 : 1;
    return sum;
  }
};
Reported reported(const mesh::View& view, Vec3 a, Vec3 b) {
  Reported result;
  result.all = mesh::all_crossings(view, a, b, query::kUnlimited, {result.buffer});
  return result;
}

}  // namespace

TEST(Segment_ThroughCornerEdgeOrDiagonal_CrossesOnceInOnceOut) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  const struct {
    Vec3 a, b;
  } through[] = {{{-2, -2, -2}, {2, 2, 2}}, {{-2, -2, 0}, {2, 2, 0}},
                 {{0, 0, -3}, {0, 0, 3}},   {{0.5f, 0.5f, 3}, {0.5f, 0.5f, -3}},
                 {{3, 0, 0}, {-3, 0, 0}},   {{-3, 1.5f, 0}, {1.5f, -3, 0}}};
  for (const auto& s : through) {
    const Reported there = reported(view, s.a, s.b);
    CHECK_EQ(there.all.found, 2u);
    CHECK(there.buffer[0].enters);
    CHECK(!there.buffer[1].enters);
    CHECK(there.buffer[0].t < there.buffer[1].t);
    CHECK_EQ(reported(view, s.b, s.a).all.found, 2u);
  }
}

TEST(AlongAnEdgeOrWithinASideIsNothingOrInAndOut) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  const struct {
    Vec3 a, b;
  } along[] = {{{-3, 1, 1}, {3, 1, 1}},
               {{-3, -1, -1}, {3, -1, -1}},
               {{-3, 0.5f, 1}, {3, 0.25f, 1}},
               {{-3, -3, -1}, {3, 3, -1}},
               {{2, 0, 1}, {0, 2, 1}}};
  for (const auto& s : along) {
    const Reported there = reported(view, s.a, s.b);
    CHECK(there.all.found == 0 || there.all.found == 2);
    CHECK_EQ(there.balance(), 0);
  }
}

TEST(AChainOfSegmentsComesInAsOftenAsItGoesOut) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (uint32_t i = 0; i < 1500; ++i) {
    test::note("chain", i);
    const Vec3 a = aim(3 * i), b = aim(3 * i + 1), c = aim(3 * i + 2);
    CHECK_EQ(reported(view, a, b).balance() + reported(view, b, c).balance() +
                 reported(view, c, a).balance(),
             0);
  }
}

TEST(HostileSegmentsGetFiniteAnswers) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  const uint32_t bits[] = {0x00000000, 0x80000001, 0x007FFFFF, 0x3F800000, 0xBF800000, 0x4E000000,
                           0x7149F2CA, 0xFF7FFFFF, 0x7F800000, 0x7FC00000, 0xFFFFFFFF};
  constexpr uint32_t kCount = sizeof bits / sizeof bits[0];
  uint32_t i = 0;
  for (const uint32_t x : bits)
    for (const uint32_t y : bits)
      for (const uint32_t z : bits) {
        const Vec3 a{test::float_of(x), test::float_of(y), test::float_of(z)};
        const Vec3 b{test::float_of(bits[++i % kCount]), test::float_of(bits[i / 5 % kCount]),
                     test::float_of(bits[i / 25 % kCount])};
        const float sum =
            (a.x - a.x) + (a.y - a.y) + (a.z - a.z) + (b.x - b.x) + (b.y - b.y) + (b.z - b.z);
        const bool finite = sum <= 0;
        const Reported there = reported(view, a, b);
        const mesh::Hit first = mesh::cast_segment(view, a, b, query::kUnlimited);
        const mesh::Hit any = mesh::any_crossing(view, a, b, query::kUnlimited);
        CHECK_EQ(there.all.exact, finite);
        CHECK_EQ(first.exact, finite);
        CHECK_EQ(first.hit, there.all.found > 0);
        CHECK_EQ(any.hit, first.hit);
        CHECK(first.t >= 0 && first.t <= 1);
        CHECK_LT(first.triangle, 12u);
        if (!finite) continue;
        // Round by a point that is certainly outside.
        const Vec3 out{5, 4, 3};
        CHECK_EQ(
            there.balance() + reported(view, b, out).balance() + reported(view, out, a).balance(),
            0);
      }
}

TEST(AFarAwaySegmentIsStillExact) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (float far = 10; far < 1e38f; far *= 9) {
    const Reported through = reported(view, {-far, 0.25f, 0.5f}, {far, 0.25f, 0.5f});
    CHECK_EQ(through.all.found, 2u);
    CHECK_EQ(through.balance(), 0);
    CHECK_EQ(reported(view, {-far, 0.25f, 0.5f}, {0.5f, 0.25f, 0.5f}).balance(), -1);
    CHECK_EQ(reported(view, {-far, 1.0000001f, 0.5f}, {far, 1.0000001f, 0.5f}).all.found, 0u);
  }
}

// The same number on every compiler, level and controller.
TEST(SegmentsHaveOneHashEverywhere) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  core::Hash hash;
  g_random = 99;
  for (uint32_t i = 0; i < 2000; ++i) {
    const float reach = i % 5 == 0 ? 1e6f : 3.0f;
    const Vec3 a{random_in(-reach, reach), random_in(-reach, reach), random_in(-reach, reach)};
    const Vec3 b = i % 3 == 0 ? Vec3{-a.x, -a.y, -a.z} : aim(i);
    const uint32_t budget = i % 7 == 0 ? 2 : UINT32_MAX;
    const mesh::Hit hits[] = {mesh::cast_segment(view, a, b, {budget}),
                              mesh::any_crossing(view, a, b, {budget})};
    for (const mesh::Hit& hit : hits) {
      hash.add(test::bits_of(hit.t));
      hash.add(hit.triangle);
      hash.add(hit.steps);
      hash.add((hit.hit ? 1u : 0u) | (hit.exact ? 2u : 0u) | (hit.enters ? 4u : 0u));
    }
    const Reported there = reported(view, a, b);
    hash.add(there.all.found);
    hash.add(there.all.steps);
    for (uint32_t k = 0; k < there.all.reported; ++k) {
      hash.add(test::bits_of(there.buffer[k].t));
      hash.add(there.buffer[k].triangle);
    }
  }
  CHECK_EQ(static_cast<uint32_t>(hash.value()), 3601469350u);
}
