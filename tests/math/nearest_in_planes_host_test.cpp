// The projection on half-spaces, against all subsets of planes solved in double.
#include <float.h>
#include <stdint.h>
#include <string.h>

#include <initializer_list>

#include "firmtouch/math/nearest_in_planes.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace firmtouch::math;

namespace {

struct Wide {
  double x, y, z;
};
Wide wide(Vec3 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}
Wide operator-(Wide a, Wide b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Wide operator+(Wide a, Wide b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Wide operator*(Wide a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Wide a, Wide b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Wide cross(Wide a, Wide b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double root(double a) { return __builtin_sqrt(a); }

struct Problem {
  HalfSpace plane[kMaxHalfSpaces];
  uint32_t count = 0;
  Vec3 goal_m;
};

double depth_m(const Problem& problem, Wide x_m) {
  double worst_m = 0;
  for (uint32_t i = 0; i < problem.count; ++i) {
    const double out_m =
        static_cast<double>(problem.plane[i].offset_m) - dot(wide(problem.plane[i].normal), x_m);
    if (out_m > worst_m) worst_m = out_m;
  }
  return worst_m;
}

// The nearest of all candidates that are inside: the goal, its feet on planes and on lines of two,
// and the points of three. It knows nothing of multipliers.
struct Oracle {
  double distance_m = DBL_MAX;
  Wide point_m{};

  explicit Oracle(const Problem& problem) {
    const Wide goal_m = wide(problem.goal_m);
    take(problem, goal_m);
    for (uint32_t i = 0; i < problem.count; ++i) {
      const Wide n = wide(problem.plane[i].normal);
      const double a = static_cast<double>(problem.plane[i].offset_m);
      take(problem, goal_m + n * ((a - dot(n, goal_m)) / dot(n, n)));
      for (uint32_t j = 0; j < i; ++j) {
        const Wide m = wide(problem.plane[j].normal);
        const double b = static_cast<double>(problem.plane[j].offset_m);
        const Wide line = cross(n, m);
        const double size2 = dot(line, line);
        if (size2 < 1e-12) continue;
        // A point of the line of both planes, then its foot.
        const Wide on = (cross(m, line) * a + cross(line, n) * b) * (1 / size2);
        take(problem, on + line * (dot(goal_m - on, line) / size2));
        for (uint32_t k = 0; k < j; ++k) {
          const Wide o = wide(problem.plane[k].normal);
          const double along = dot(line, o);
          if (along * along < 1e-12) continue;
          take(problem,
               on + line * ((static_cast<double>(problem.plane[k].offset_m) - dot(o, on)) / along));
        }
      }
    }
  }
  void take(const Problem& problem, Wide x_m) {
    if (depth_m(problem, x_m) > 1e-10) return;
    const Wide off = x_m - wide(problem.goal_m);
    const double size_m = root(dot(off, off));
    if (size_m < distance_m) distance_m = size_m, point_m = x_m;
  }
};

float between(test::Xorshift& random, float low, float high) {
  return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
}

Vec3 direction(test::Xorshift& random) {
  for (;;) {
    const Vec3 a{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    const double size2 = dot(wide(a), wide(a));
    if (size2 > 1 || size2 < 0.01) continue;
    const float scale = static_cast<float>(1 / root(size2));
    return {a.x * scale, a.y * scale, a.z * scale};
  }
}

// As a proxy makes them: the origin is inside of every plane.
Problem make(test::Xorshift& random) {
  Problem problem;
  problem.count = random() % (kMaxHalfSpaces + 1);
  for (uint32_t i = 0; i < problem.count; ++i) {
    problem.plane[i].normal = direction(random);
    problem.plane[i].offset_m = random() % 3 == 0 ? 0.0f : -between(random, 0, 0.002f);
  }
  const Vec3 way = direction(random);
  const float size_m = between(random, 0, 0.01f);
  problem.goal_m = {way.x * size_m, way.y * size_m, way.z * size_m};
  return problem;
}

ActivePlanes any_active(test::Xorshift& random) {
  ActivePlanes active;
  active.count = static_cast<uint8_t>(random() % 5);
  for (uint8_t& plane : active.plane) plane = static_cast<uint8_t>(random() % 10);
  return active;
}

}  // namespace

TEST(NearestInPlanes_RandomPlanes_IsTheBruteForceInDouble) {
  test::Xorshift random(24);
  uint32_t of_three = 0, still = 0, flat = 0;
  for (uint32_t i = 0; i < 8000; ++i) {
    const Problem problem = make(random);
    // Every other time from what held a goal near by, or from any planes.
    ActivePlanes before = any_active(random);
    if (i % 2 == 0) {
      const float part = between(random, 0.9f, 1.0f);
      const Vec3 near_m{problem.goal_m.x * part, problem.goal_m.y * part, problem.goal_m.z * part};
      before = nearest_in_planes(problem.plane, problem.count, near_m).active;
    }
    const NearestInPlanes found =
        nearest_in_planes(problem.plane, problem.count, problem.goal_m, before);
    still += before.count != 0 && found.active.count == before.count &&
                     memcmp(found.active.plane, before.plane, before.count) == 0
                 ? 1
                 : 0;
    const Oracle oracle(problem);
    test::note("case", i);
    CHECK(found.is_found);
    const Wide goal = wide(problem.goal_m), off = wide(found.point_m) - goal;
    CHECK_LE(root(dot(off, off)), oracle.distance_m + 2e-7);
    CHECK_LE(oracle.distance_m, root(dot(off, off)) + 2e-7);
    // 5e-7 of the goal, and what the test rounds; more where three planes meet at small angles.
    const double depth = depth_m(problem, wide(found.point_m)) / root(dot(goal, goal));
    CHECK_LE(depth, 1e-5);
    flat += depth > 6e-7 ? 1 : 0;
    CHECK_LE(found.active.count, 3u);
    of_three += found.active.count == 3 ? 1 : 0;
  }
  CHECK_LE(flat, 8u);
  CHECK_GE(flat, 1u);
  CHECK_GE(of_three, 600u);
  CHECK_GE(still, 1000u);
}

TEST(NearestInPlanes_CornerOfThreeWalls_IsTheCorner) {
  const HalfSpace walls[3] = {{{1, 0, 0}, -0.001f}, {{0, 1, 0}, -0.002f}, {{0, 0, 1}, -0.003f}};
  const NearestInPlanes found = nearest_in_planes(walls, 3, {-0.01f, -0.01f, -0.01f});
  CHECK(found.is_found);
  CHECK_EQ(found.active.count, 3u);
  CHECK_LE(__builtin_fabsf(found.point_m.x + 0.001f), 2e-9f);
  CHECK_LE(__builtin_fabsf(found.point_m.y + 0.002f), 2e-9f);
  CHECK_LE(__builtin_fabsf(found.point_m.z + 0.003f), 2e-9f);
}

// Planes of a smooth concave surface: two facets whose normals differ by 1e-4 to 1e-2 rad.
TEST(NearestInPlanes_NearlyCoplanarFacets_MeetInTheirGroove) {
  const float tilts[] = {1e-4f, 1e-3f, 1e-2f};
  for (const float tilt : tilts) {
    const float level = static_cast<float>(root(1 - static_cast<double>(tilt * tilt)));
    const HalfSpace facets[2] = {{{tilt, 0, level}, 0}, {{-tilt, 0, level}, 0}};
    const NearestInPlanes found = nearest_in_planes(facets, 2, {0.1f * tilt * 0.005f, 0, -0.005f});
    CHECK(found.is_found);
    CHECK_LE(__builtin_fabsf(found.point_m.x), 1e-5f);
    CHECK_LE(__builtin_fabsf(found.point_m.z), 1e-7f);
  }
}

TEST(NearestInPlanes_SamePlaneEightTimes_CountsOnce) {
  HalfSpace planes[8];
  for (HalfSpace& plane : planes) plane = {{0, 0, 1}, -0.001f};
  const NearestInPlanes found = nearest_in_planes(planes, 8, {0.002f, 0, -0.005f});
  CHECK(found.is_found);
  CHECK_EQ(found.active.count, 1u);
  CHECK_LE(__builtin_fabsf(found.point_m.z + 0.001f), 1e-9f);
  CHECK_EQ(found.point_m.x, 0.002f);
}

TEST(NearestInPlanes_HostileInput_IsFinite) {
  const float nan = __builtin_nanf(""), infinite = __builtin_inff();
  const float special[] = {nan, infinite, -infinite, 0.0f, -0.0f, 1e6f, -1e6f, 1e-38f, 1.0f};
  test::Xorshift random(7);
  for (uint32_t i = 0; i < 20000; ++i) {
    Problem problem = make(random);
    float* const fields[] = {&problem.plane[0].normal.x, &problem.plane[1].offset_m,
                             &problem.plane[2].normal.z, &problem.goal_m.x, &problem.goal_m.z};
    *fields[random() % 5] = special[random() % 9];
    problem.count = random() % 12;
    if (problem.count > kMaxHalfSpaces) {
      CHECK_LE(nearest_in_planes(problem.plane, kMaxHalfSpaces, problem.goal_m).active.count, 3u);
      continue;
    }
    const NearestInPlanes found =
        nearest_in_planes(problem.plane, problem.count, problem.goal_m, any_active(random));
    test::note("case", i);
    CHECK(found.point_m.x - found.point_m.x <= 0 && found.point_m.y - found.point_m.y <= 0 &&
          found.point_m.z - found.point_m.z <= 0);
    const Slide slide = slide_with_friction(problem.plane, problem.count, problem.goal_m, found,
                                            {special[i % 9], i % 2 == 0 ? 0.5f : 0.0f});
    CHECK(slide.point_m.x - slide.point_m.x <= 0);
  }
}

// No point is inside both: the answer is finite, and says that it is none.
TEST(NearestInPlanes_OpposingWallsWithoutRoom_SaySo) {
  const HalfSpace walls[2] = {{{0, 0, 1}, 0.001f}, {{0, 0, -1}, 0.001f}};
  CHECK(!nearest_in_planes(walls, 2, {0.002f, 0, -0.005f}).is_found);
}

TEST(SlideWithFriction_Plane_TheRatioIsTheCoefficient) {
  const HalfSpace floor{{0, 0, 1}, 0};
  const float frictions[] = {0.05f, 0.3f, 1.0f, 2.0f};
  for (const float friction : frictions) {
    const Vec3 goal_m{0.02f, 0.01f, -0.004f};
    const NearestInPlanes nearest = nearest_in_planes(&floor, 1, goal_m);
    const Slide slide = slide_with_friction(&floor, 1, goal_m, nearest, {friction});
    CHECK(!slide.is_stuck);
    const double x = static_cast<double>(goal_m.x - slide.point_m.x),
                 y = static_cast<double>(goal_m.y - slide.point_m.y);
    CHECK_LE(__builtin_fabs(root(x * x + y * y) / 0.004 - static_cast<double>(friction)),
             1e-5 * (1 + static_cast<double>(friction)));
  }
  const Vec3 below_m{0.001f, 0, -0.004f};
  const NearestInPlanes nearest = nearest_in_planes(&floor, 1, below_m);
  CHECK(slide_with_friction(&floor, 1, below_m, nearest, {0.3f}).is_stuck);
}

// A wall rises from the floor where the origin is pressed on it, by little.
TEST(SlideWithFriction_WallWhereItIsPressed_StaysInFront) {
  const Vec3 goal_m{0.01f, 0, -0.004f};
  const float goal = 0.01077f;
  for (const float high : {3e-6f, 5e-6f, 1e-5f, 1e-3f, 1e-2f}) {
    Problem problem;
    problem.count = 2;
    problem.plane[0] = {{0, 0, 1}, -0.001f};
    problem.plane[1] = {{0.6f, 0, 0.8f}, -0.0008f + high * goal};
    problem.goal_m = goal_m;
    const NearestInPlanes nearest = nearest_in_planes(problem.plane, 2, goal_m);
    CHECK_EQ(nearest.active.count, 1u);
    const Slide slide = slide_with_friction(problem.plane, 2, goal_m, nearest, {10.0f});
    CHECK_LE(depth_m(problem, wide(slide.point_m)), 2.2e-6 * static_cast<double>(goal));
  }
}

// A hand at constant speed is ahead by friction * depth + c v / K, with c / K = T share / (1 -
// share). A step in two parts ends where it ends in one.
TEST(SlideWithFriction_Viscous_LagsByTheSpeed) {
  const HalfSpace floor{{0, 0, 1}, 0};
  constexpr float kDepth_m = 0.004f, kStep_m = 1e-4f, kCoulomb = 0.2f;
  const float shares[] = {0.1f, 0.5f, 0.9f};
  for (const float share : shares) {
    double ahead_m = 0;
    float slid_m = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 goal_m{static_cast<float>(ahead_m) + kStep_m, 0, -kDepth_m};
      const NearestInPlanes nearest = nearest_in_planes(&floor, 1, goal_m);
      slid_m = slide_with_friction(&floor, 1, goal_m, nearest, {kCoulomb, share}).point_m.x;
      ahead_m = static_cast<double>(goal_m.x - slid_m);
      const Vec3 rest_m{goal_m.x - slid_m, 0, -kDepth_m};
      const Slide again = slide_with_friction(
          &floor, 1, rest_m, nearest_in_planes(&floor, 1, rest_m), {kCoulomb, share, slid_m});
      CHECK_LE(__builtin_fabs(static_cast<double>(again.point_m.x)), 1e-8);
    }
    const double wanted_m = static_cast<double>(kCoulomb * kDepth_m) +
                            static_cast<double>(kStep_m * share) / (1 - static_cast<double>(share));
    CHECK_LE(__builtin_fabs(ahead_m / wanted_m - 1), 1e-4);
  }
}

// With the point of the tick's beginning instead of where the proxy is, the distance grew by up to
// 226 um in 126 of 200,000 ticks.
TEST(SlideWithFriction_RandomPlanes_NeverGoesAwayFromTheGoal) {
  test::Xorshift random(3);
  for (uint32_t i = 0; i < 20000; ++i) {
    const Problem problem = make(random);
    const NearestInPlanes nearest = nearest_in_planes(problem.plane, problem.count, problem.goal_m);
    const Slide slide = slide_with_friction(
        problem.plane, problem.count, problem.goal_m, nearest,
        {between(random, 0, 2), between(random, 0, 0.99f), between(random, 0, 0.01f)});
    const Wide off = wide(slide.point_m) - wide(problem.goal_m);
    test::note("case", i);
    CHECK_LE(root(dot(off, off)),
             root(dot(wide(problem.goal_m), wide(problem.goal_m))) * (1 + 1e-6) + 1e-9);
    CHECK_LE(depth_m(problem, wide(slide.point_m)), 2.1e-7);
  }
}
