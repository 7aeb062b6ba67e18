// The inner loop on hostile triangles, against brute force in double.
#include <cmath>

#include "brute_force.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "harness/test.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

Vec3 narrow(Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

struct Turned {
  Vec3 a, b, c;
};

// The longest edge first, as the baker leaves it.
Turned longest_first(Vec3 a, Vec3 b, Vec3 c) {
  const float ab = dot(b - a, b - a), bc = dot(c - b, c - b), ca = dot(a - c, a - c);
  if (ab >= bc && ab >= ca) return {a, b, c};
  return bc >= ca ? Turned{b, c, a} : Turned{c, a, b};
}

// Error beside the largest coordinate difference, for a triangle of length 1 and the given height.
double worst_error(double height, double reach, uint64_t seed) {
  Random random(seed);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point x{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)},
        y{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    const Point along = x * (1 / length(x)), side = cross(along, y),
                across = side * (height / length(side));
    const Vec3 a = narrow(y), b = narrow(y + along),
               c = narrow(y + along * random.in(0, 1) + across);
    const Turned t = longest_first(a, b, c);
    const Point where =
        wide(a) + (wide(b) - wide(a)) * random.in(-0.5, 1.5) + across * random.in(-2, 2);
    const Vec3 p =
        narrow(where + Point{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)} * reach);
    const mesh::Foot foot = mesh::closest_on_triangle(p, t.a, t.b, t.c);
    const double truth = true_distance(wide(p), wide(t.a), wide(t.b), wide(t.c));
    const double told = std::sqrt(double{foot.distance2_m2});
    worst = std::max(worst, std::fabs(told - truth) / std::max(1.0, truth));
  }
  return worst;
}

}  // namespace

TEST(SliversLoseNoMoreThanWellShapedTriangles) {
  for (const double reach : {0.0, 1e-6, 1e-3, 1.0, 1e2}) {
    const double well_shaped = worst_error(1, reach, 7);
    for (const double height : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      test::note("height 1e-", static_cast<int64_t>(-std::log10(height)));
      CHECK_LE(worst_error(height, reach, 7), 1.5 * well_shaped);
    }
  }
}

TEST(TheDegenerateTriangleAnswersItsLongestEdge) {
  const mesh::Foot foot =
      mesh::closest_on_triangle({0.25f, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0});
  CHECK_LE(std::fabs(foot.distance2_m2 - 1), 1e-6f);
  CHECK_EQ(static_cast<int>(foot.feature), static_cast<int>(mesh::Feature::kEdge0));
}

TEST(EachRegionTellsItsFeature) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0},
      c{3, 1, 0};  // obtuse at c: beyond c both short edges must be asked
  const struct {
    Vec3 p;
    mesh::Feature feature;
  } cases[] = {{{2, 0.25f, 1}, mesh::Feature::kFace},    {{2, -1, 0}, mesh::Feature::kEdge0},
               {{3.9f, 0.9f, 0}, mesh::Feature::kEdge1}, {{1, 2, 0}, mesh::Feature::kEdge2},
               {{-1, -1, 0}, mesh::Feature::kVertex0},   {{5, -1, 0}, mesh::Feature::kVertex1},
               {{2.9f, 3, 0}, mesh::Feature::kVertex2},  {{-1, 0.5f, 0}, mesh::Feature::kVertex0},
               {{6, 1, 0}, mesh::Feature::kVertex1},     {{3.8f, 1.6f, 0}, mesh::Feature::kEdge1}};
  for (const auto& a_case : cases)
    CHECK_EQ(static_cast<int>(mesh::closest_on_triangle(a_case.p, a, b, c).feature),
             static_cast<int>(a_case.feature));
}
