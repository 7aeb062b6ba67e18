// The inner loop on hostile triangles, against brute force in double.
#include <cmath>

#include "brute_force.hpp"
#include "firmtouch/mesh/leaf.hpp"
#include "harness/test.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

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
    const Point x{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)},
        y{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Point along = x * (1 / length(x)), side = cross(along, y),
                across = side * (height / length(side));
    const Vec3 a = narrow(y), b = narrow(y + along),
               c = narrow(y + along * random.between(0, 1) + across);
    const Turned t = longest_first(a, b, c);
    const Point where =
        wide(a) + (wide(b) - wide(a)) * random.between(-0.5, 1.5) + across * random.between(-2, 2);
    const Vec3 p = narrow(
        where + Point{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)} * reach);
    const mesh::Foot foot = mesh::closest_on_triangle(p, t.a, t.b, t.c);
    const double truth = true_distance(wide(p), wide(t.a), wide(t.b), wide(t.c));
    const double reported = std::sqrt(double{foot.distance2_m2});
    worst = std::max(worst, std::fabs(reported - truth) / std::max(1.0, truth));
  }
  return worst;
}

struct LeftOut {
  uint32_t wrongly = 0, at_twice = 0;
};

// Triangles of length `size` or less, beside one of length `longest`, and points up to `reach` off.
LeftOut leave_out(float size, double height, double reach, float longest, uint64_t seed) {
  Random random(seed);
  LeftOut left_out;
  const float slack_m2 = mesh::Nearer::slack_m2(longest);
  for (int i = 0; i < 4000; ++i) {
    const Point x{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)},
        y{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Point along = x * (1 / length(x)), side = cross(along, y),
                across = side * (height / length(side)), up = cross(along, side);
    const Point corner = along * random.between(0, 1) + across;
    const Turned t =
        longest_first(narrow(y * size), narrow((y + along) * size), narrow((y + corner) * size));
    const Point off = up * (random.between(-1, 1) / length(up)) +
                      Point{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)} *
                          random.between(0, 1);
    const Vec3 p = narrow(
        (y + along * random.between(-1, 2) + across * random.between(-2, 2) + off * reach) * size);
    mesh::Foot reported, foot;
    mesh::find_foot(p, mesh::OfCorners{t.a, t.b, t.c}, mesh::Everything{}, reported);
    const float ulp_nearer = std::nextafter(reported.distance2_m2, INFINITY);
    const auto is_left_out = [&](float min2_m2) {
      const mesh::Nearer nearer = mesh::Nearer::than(min2_m2, slack_m2);
      return !mesh::find_foot(p, mesh::OfCorners{t.a, t.b, t.c}, nearer, foot);
    };
    left_out.wrongly += is_left_out(ulp_nearer) ? 1u : 0u;
    left_out.at_twice += is_left_out(0.25f * reported.distance2_m2) ? 1u : 0u;
  }
  return left_out;
}

}  // namespace

// Also of the coarsest bound that is allowed: a mesh of no longer edge.
TEST(NoTriangleThatIsAnUlpNearerIsLeftOut) {
  for (const float size : {1e-12f, 1e-11f, 1e-10f, 1e-9f, 1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f, 1e9f})
    for (const double height : {0.8, 1e-2, 1e-4, 1e-6, 1e-8, 0.0})
      for (const double reach : {1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3}) {
        test::note("height 1e-", static_cast<int64_t>(-std::log10(height + 1e-9)));
        CHECK_EQ(leave_out(size, height, reach, size, 11).wrongly, 0u);
      }
}

TEST(MostTrianglesTwiceAsFarAreLeftOut) {
  for (const double reach : {1.0, 3.0, 10.0})
    CHECK_LT(3000u, leave_out(0.01f, 0.8, reach, 0.02f, 12).at_twice);  // of 4,000
}

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

TEST(EachRegion_HasItsFeature) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0},
      c{3, 1, 0};  // obtuse at c: beyond c both short edges must be tested
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
