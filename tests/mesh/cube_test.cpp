// Closed forms and hostile queries on a cube: run on the host and on the controller.
#include <float.h>

#include "cube.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

namespace {

using firmtouch::math::Vec3;
using namespace firmtouch;  // NOLINT: a test file

test::Lcg g_random(1);
float random_in(float low, float high) { return g_random.between(low, high); }

float larger(float a, float b) { return a > b ? a : b; }
float absolute(float a) { return a < 0 ? -a : a; }

// Signed distance of the cube |x|, |y|, |z| <= 1, squared outside.
float cube_outside2(Vec3 p) {
  const float x = larger(absolute(p.x) - 1, 0), y = larger(absolute(p.y) - 1, 0),
              z = larger(absolute(p.z) - 1, 0);
  return x * x + y * y + z * z;
}
float cube_depth(Vec3 p) { return 1 - larger(larger(absolute(p.x), absolute(p.y)), absolute(p.z)); }

mesh::Closest query_at(const mesh::View& view, Vec3 p, mesh::Hint& hint,
                       uint32_t steps = UINT32_MAX) {
  return mesh::closest_point(view, p, {steps}, hint);
}

void check_finite(const mesh::Closest& c) {
  const float values[] = {c.distance_m,  c.point_m.x,   c.point_m.y,   c.point_m.z,
                          c.direction.x, c.direction.y, c.direction.z, c.certificate.lower_m};
  for (const float v : values) CHECK(v - v <= 0);
  CHECK_LT(c.triangle, 12u);
}

}  // namespace

TEST(CubeOpens) { CHECK(mesh_test::Cube().view().is_open()); }

TEST(CubeDistancesHaveTheirClosedForm) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  mesh::Hint warm;
  for (int i = 0; i < 3000; ++i) {
    test::note("query", i);
    const float reach = i % 3 == 0 ? 1.2f : 3.0f;
    const Vec3 p{random_in(-reach, reach), random_in(-reach, reach), random_in(-reach, reach)};
    mesh::Hint cold;
    const mesh::Closest answers[] = {query_at(view, p, warm), query_at(view, p, cold)};
    for (const mesh::Closest& c : answers) {
      const float outside2 = cube_outside2(p), depth = cube_depth(p);
      const float scale = 3.5f + absolute(p.x) + absolute(p.y) + absolute(p.z);
      CHECK(c.certificate.exact);
      if (outside2 > 0)
        CHECK_LE(absolute(c.distance_m * c.distance_m - outside2), 1e-6f * scale * scale);
      else
        CHECK_LE(absolute(c.distance_m + depth), 4e-7f * scale);
      if (absolute(c.distance_m) > 1e-5f) CHECK_EQ(c.certificate.sign, outside2 > 0 ? 1 : -1);
      CHECK_LE(c.certificate.lower_m, absolute(c.distance_m));
    }
  }
}

TEST(CubeNormalsPointOutward) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  // Half a step of an edge's fold, 1 / 254, turns its normal by at most 8e-3 rad.
  const float fine = 2e-4f, coarse = 6e-3f;
  const struct {
    Vec3 query, normal;
    float error;
  } cases[] = {{{0.25f, 0.5f, 2}, {0, 0, 1}, fine},
               {{-3, 0.25f, 0.5f}, {-1, 0, 0}, fine},
               {{2, 2, 0.25f}, {0.70711f, 0.70711f, 0}, coarse},
               {{-2, 0.25f, -2}, {-0.70711f, 0, -0.70711f}, coarse},
               {{2, 2, 2}, {0.57735f, 0.57735f, 0.57735f}, fine},
               {{-2, 3, -2}, {-0.57735f, 0.57735f, -0.57735f}, fine}};
  for (const auto& a_case : cases) {
    mesh::Hint hint;
    const Vec3 n = query_at(view, a_case.query, hint).direction;
    CHECK_LE(absolute(n.x - a_case.normal.x), a_case.error);
    CHECK_LE(absolute(n.y - a_case.normal.y), a_case.error);
    CHECK_LE(absolute(n.z - a_case.normal.z), a_case.error);
  }
}

TEST(EveryBudgetKeepsItsPromise) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{random_in(-2, 2), random_in(-2, 2), random_in(-2, 2)};
    mesh::Hint cold;
    const float truth = absolute(query_at(view, p, cold).distance_m);
    float gap = FLT_MAX;
    for (uint32_t budget = 0; budget < 12; ++budget) {
      mesh::Hint hint;
      const mesh::Closest c = query_at(view, p, hint, budget);
      CHECK_LE(c.certificate.work, budget == 0 ? 1u : budget);
      CHECK_LE(c.certificate.lower_m, truth);
      CHECK_LE(truth, absolute(c.distance_m) + 2e-6f);
      CHECK_LE(absolute(c.distance_m) - c.certificate.lower_m, gap + 1e-6f);
      gap = absolute(c.distance_m) - c.certificate.lower_m;
      if (!c.certificate.exact) CHECK_EQ(c.certificate.sign, 0);
    }
  }
}

TEST(SignGoesOnByContinuityWithinCertifiedFreeDistance) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  mesh::Hint hint;
  CHECK_EQ(query_at(view, {0, 0, 1.8f}, hint).certificate.sign, 1);
  CHECK_EQ(query_at(view, {0.4f, 0, 1.8f}, hint, 1).certificate.sign,
           1);  // half of the free distance
  CHECK_EQ(query_at(view, {0, 0.9f, 1.8f}, hint, 1).certificate.sign,
           0);  // more than is left: unknown
}

TEST(HostileQueriesGiveFiniteAnswers) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  const uint32_t bits[] = {0x00000000, 0x80000000, 0x00000001, 0x007FFFFF, 0x00800000,
                           0x3F800000, 0x3F800001, 0xBF800000, 0x4E000000, 0x58635FA9,
                           0x58635FAA, 0x5F000000, 0x7149F2CA, 0x7F7FFFFF, 0x7F800000,
                           0xFF800000, 0x7FC00000, 0xFFFFFFFF, 0x7F800001};
  mesh::Hint warm;
  for (const uint32_t x : bits)
    for (const uint32_t y : bits)
      for (const uint32_t z : bits) {
        const Vec3 p{test::float_of(x), test::float_of(y), test::float_of(z)};
        mesh::Hint cold;
        const mesh::Closest answers[] = {query_at(view, p, warm), query_at(view, p, cold)};
        for (const mesh::Closest& c : answers) {
          check_finite(c);
          if (!(p.x - p.x <= 0) || !(p.y - p.y <= 0) || !(p.z - p.z <= 0)) {
            CHECK(!c.certificate.exact);
            CHECK_EQ(c.certificate.sign, 0);
            CHECK(c.certificate.lower_m <= 0);
          }
        }
      }
}

TEST(FarAwayIsExactToo) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (float r = 10; r < 1e37f; r *= 7) {
    mesh::Hint hint;
    const mesh::Closest c = query_at(view, {r, 0.25f, 0.5f}, hint);
    CHECK(c.certificate.exact);
    CHECK_EQ(c.certificate.sign, 1);
    CHECK_LE(absolute(c.distance_m - (r - 1)), 4e-7f * r);
    CHECK_LE(c.certificate.lower_m, c.distance_m);
  }
}

TEST(HintsOfRandomBitsAreOnlyHints) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (uint32_t i = 0; i < 4000; ++i) {
    mesh::Hint hint;
    hint.leaf_slot = i < 64 ? i : i * 2654435761u;
    const Vec3 p{random_in(-2, 2), random_in(-2, 2), random_in(-2, 2)};
    const mesh::Closest c = query_at(view, p, hint);
    mesh::Hint cold;
    CHECK_LE(absolute(c.distance_m - query_at(view, p, cold).distance_m), 1e-6f);
    CHECK(c.certificate.exact);
  }
}

TEST(SegmentsCrossTheCubeWhereTheyShould) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  const mesh::Hit through =
      mesh::cast_segment(view, {0.25f, 0.5f, 3}, {0.25f, 0.5f, -3}, query::kUnlimited);
  CHECK(through.hit);
  CHECK_LE(absolute(through.t - 1.0f / 3), 1e-6f);
  CHECK(!mesh::cast_segment(view, {2, 2, 3}, {2, 2, -3}, query::kUnlimited).hit);
  CHECK(!mesh::cast_segment(view, {0, 0, 0}, {0.5f, 0.5f, 0.5f}, query::kUnlimited).hit);
  CHECK(!mesh::cast_segment(view, {0, 0, 2}, {0, 0, 2}, query::kUnlimited).hit);
  const float nan = test::float_of(0x7FC00000);
  CHECK(!mesh::cast_segment(view, {nan, 0, 2}, {0, 0, 0}, query::kUnlimited).hit);
  CHECK(!mesh::cast_segment(view, {0, 0, 2}, {0, 0, 0}, {1}).exact);
}

TEST(NoSegmentLeaksThroughAnEdgeOrACorner) {
  const mesh_test::Cube cube;
  const mesh::View view = cube.view();
  for (int i = 0; i < 3000; ++i) {
    test::note("segment", i);
    // From inside through a corner, a point of an edge or a point of a side's diagonal, to far
    // outside.
    const float u = random_in(-1, 1);
    const Vec3 aims[3] = {{1, 1, 1}, {1, 1, u}, {u, u, 1}};
    const Vec3 aim = aims[i % 3],
               from{random_in(-0.9f, 0.9f), random_in(-0.9f, 0.9f), random_in(-0.9f, 0.9f)};
    const Vec3 to{from.x + 3 * (aim.x - from.x), from.y + 3 * (aim.y - from.y),
                  from.z + 3 * (aim.z - from.z)};
    CHECK(mesh::cast_segment(view, from, to, query::kUnlimited).hit);
  }
}
