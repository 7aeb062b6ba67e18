// Small tools on shapes in closed form, against their distances in double, and on spline surfaces.
#include <algorithm>
#include <cmath>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "firmtouch/scene/spline_touched.hpp"
#include "harness/long.hpp"
#include "scene/spline_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

double wide(float a) { return static_cast<double>(a); }

struct Wide {
  double x, y, z;
};
Wide less(Vec3 a, Vec3 b) {
  return {wide(a.x) - wide(b.x), wide(a.y) - wide(b.y), wide(a.z) - wide(b.z)};
}
double dot(Wide a, Wide b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double size(Wide a) { return std::sqrt(dot(a, a)); }

// Of a rectangle of half extents, or a box; below 0 inside.
double to_box_m(Wide p, Wide half) {
  const Wide off{std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
  const double outside =
      size({std::fmax(off.x, 0.0), std::fmax(off.y, 0.0), std::fmax(off.z, 0.0)});
  return outside > 0 ? outside : std::max({off.x, off.y, off.z});
}

// The distance of each shape, signed.
double truth_m(const scene::PlaneTouched& s, Vec3 p) {
  const Wide n = less(s.normal, {});
  return dot(less(p, s.point_m), n) / size(n);
}
double truth_m(const scene::SphereTouched& s, Vec3 p) {
  return size(less(p, s.centre_m)) - wide(s.radius_m);
}
struct AlongAxis {
  double along_m, across_m, length_m;
};
AlongAxis along_axis(const Vec3 (&end_m)[2], Vec3 p) {
  const Wide axis = less(end_m[1], end_m[0]), off = less(p, end_m[0]);
  const double length = size(axis), along = dot(off, axis) / length;
  return {along,
          size({off.x - along * axis.x / length, off.y - along * axis.y / length,
                off.z - along * axis.z / length}),
          length};
}
double truth_m(const scene::CapsuleTouched& s, Vec3 p) {
  const AlongAxis at = along_axis(s.end_m, p);
  const double beyond = std::fmax(std::fmax(-at.along_m, at.along_m - at.length_m), 0.0);
  return std::hypot(at.across_m, beyond) - wide(s.radius_m);
}
double truth_m(const scene::CylinderTouched& s, Vec3 p) {
  const AlongAxis at = along_axis(s.end_m, p);
  return to_box_m({at.across_m, at.along_m - at.length_m / 2, 0},
                  {wide(s.radius_m), at.length_m / 2, 1});
}
double truth_m(const scene::BoxTouched& s, Vec3 p) {
  const Wide off = less(p, s.pose.translation_m), half = less(s.half_m, {});
  const Vec3(&row)[3] = s.pose.rotation.row;
  return to_box_m({dot(off, less({row[0].x, row[1].x, row[2].x}, {})),
                   dot(off, less({row[0].y, row[1].y, row[2].y}, {})),
                   dot(off, less({row[0].z, row[1].z, row[2].z}, {}))},
                  half);
}

class Shapes {
 public:
  explicit Shapes(uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return random_.between(low, high); }
  Vec3 any(double most) {
    return tools::to_vec3(
        {random_.between(-most, most), random_.between(-most, most), random_.between(-most, most)});
  }
  Vec3 unit() {
    for (;;) {
      const Vec3 v = any(1);
      if (math::length(v) > 0.2f) return v * (1.0f / math::length(v));
    }
  }
  // Thin ones, too: extents of 3 orders.
  float extent() { return static_cast<float>(0.05 * std::pow(10.0, random_.between(-3, 0))); }
  template <class Check>
  void each(const Check& check) {
    check(scene::PlaneTouched{any(0.05), unit(), 0.1f});
    check(scene::SphereTouched{any(0.05), extent()});
    const Vec3 end_m = any(0.05);
    check(scene::CapsuleTouched{{end_m, end_m + unit() * extent()}, extent()});
    check(scene::CylinderTouched{{end_m, end_m + unit() * extent()}, extent()});
    const Vec3 x = unit(), y0 = math::cross(x, unit());
    if (math::length(y0) < 0.1f) return;
    const Vec3 y = y0 * (1.0f / math::length(y0)), z = math::cross(x, y);
    const math::Mat3 rotation{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
    check(scene::BoxTouched{{rotation, any(0.05)}, {extent(), extent(), extent()}});
  }

 private:
  tools::Random random_;
};

}  // namespace

TEST(ClosedForm_FeatureOfAnyPoint_LiesInTheShape) {
  Shapes shapes(5);
  for (int round = 0; round < 5000; ++round)
    shapes.each([&](auto shape) {
      const scene::Feature feature = shape.near(shapes.any(0.1), {}, 0).feature;
      const Vec3(&corner_m)[3] = feature.corner;
      const auto check = [&](Vec3 p_m) { CHECK_LE(truth_m(shape, p_m), 2e-7); };
      if (feature.kind == scene::Feature::Kind::kTriangle)
        for (const Vec3& p_m : corner_m) check(p_m);
      if (feature.kind == scene::Feature::Kind::kBall)
        for (int k = 0; k < 8; ++k) check(corner_m[0] + shapes.unit() * corner_m[1].x);
    });
}

TEST(ClosedForm_FarFromTheOrigin_BoundsAreAsCloseAsNearIt) {
  Shapes shapes(6);
  const int rounds = firmtouch::test::is_long() ? 1000000 : 20000;
  for (int round = 0; round < rounds; ++round)
    shapes.each([&](auto shape) {
      const double size_m = wide(shape.size_m());
      const Vec3 any_m = shapes.any(0.1);
      const scene::Near far = shape.near(any_m, {}, 0);
      const Vec3 at_m = any_m - far.outward * (far.distance_m -
                                               static_cast<float>(size_m * shapes.between(0, 1)));
      const scene::Near near = shape.near(at_m, {}, 0);
      const double true_m = std::fabs(truth_m(shape, at_m));
      CHECK_LE(wide(near.lower_m), true_m);
      CHECK_LE(true_m - wide(near.lower_m), 2e-6 * (true_m + 1.5 * size_m));
    });
}

// Also inside, where a tool is led out the nearest way.
TEST(ClosedForm_OfAnyPoint_DistanceSideAndNearestPointAreTrue) {
  Shapes shapes(8);
  uint32_t inside = 0;
  for (int round = 0; round < 20000; ++round)
    shapes.each([&](auto shape) {
      const double size_m = wide(shape.size_m());
      const Vec3 any_m = shapes.any(0.1);
      const scene::Near before = shape.near(any_m, {}, 0);
      const Vec3 at_m =
          any_m - before.outward *
                      (before.distance_m + static_cast<float>(size_m * shapes.between(-0.1, 0.4)));
      const scene::Near near = shape.near(at_m, {}, 0);
      const double true_m = truth_m(shape, at_m), slack_m = 2e-6 * (std::fabs(true_m) + size_m);
      inside += true_m < 0 ? 1u : 0u;
      CHECK_LE(std::fabs(wide(near.distance_m) - std::fabs(true_m)), slack_m);
      if (std::fabs(true_m) > slack_m) CHECK_EQ(near.sign, true_m < 0 ? -1 : 1);
      const Vec3 nearest_m = at_m - near.outward * static_cast<float>(true_m);
      const double of_place_m = slack_m + 3e-8;  // what its coordinates round
      CHECK_LE(std::fabs(truth_m(shape, nearest_m)), of_place_m);
      if (near.feature.kind == scene::Feature::Kind::kTriangle)
        CHECK_LE(wide(scene::tangent_at(near.feature, nearest_m, {}).distance_m), of_place_m);
    });
  CHECK_GE(inside, 50000u);
}

TEST(SmallTool_WayThatAShapeProvesFree_IsFree) {
  Shapes shapes(3);
  uint32_t long_ways = 0, ways = 0;
  const uint32_t rounds = firmtouch::test::is_long() ? 1000000 : 20000;
  for (uint32_t round = 0; round < rounds; ++round)
    shapes.each([&](auto shape) {
      Vec3 from_m = shapes.any(0.1);
      const scene::Near near = shape.near(from_m, {}, 0);
      if (near.sign < 0) return;
      scene::Way way;
      way.radius_m = static_cast<float>(wide(shape.size_m()) * shapes.between(0, 0.01));
      // Most begin as near as a tool that touches, and go along.
      if (round % 4 != 0) {
        const double gap_m = wide(way.radius_m) + (wide(shape.size_m()) + size(less(from_m, {}))) *
                                                      shapes.between(0, 4e-6);
        from_m = from_m - near.outward * (near.distance_m - static_cast<float>(gap_m));
      }
      way.from_m = from_m;
      way.along_m = shapes.any(wide(shape.size_m()) * 0.3);
      if (round % 2 != 0) {
        way.along_m = way.along_m - near.outward * math::dot(way.along_m, near.outward);
        way.axis[way.axes++] = -near.outward;
      }
      if (round % 3 == 0) way.axis[way.axes++] = shapes.unit();
      uint32_t work = 0;
      const float part = shape.free_part(way, {}, work);
      CHECK_EQ(work, 1u);
      CHECK(part >= 0 && part <= 1);
      ++ways;
      if (round % 4 != 0 && part * math::length(way.along_m) > 4 * way.radius_m) ++long_ways;
      if (!(part > 0)) return;
      for (int k = 0; k <= 16; ++k) {
        const Vec3 at_m = way.from_m + way.along_m * (part * 0.0625f * static_cast<float>(k));
        CHECK_LE(wide(way.radius_m),
                 truth_m(shape, at_m) + 1e-7 * wide(shape.size_m()) + 6e-8 * size(less(at_m, {})));
      }
    });
  firmtouch::test::note("long ways of 100", 100 * long_ways / ways);
  CHECK_LT(ways / 4, long_ways);
}

TEST(SmallTool_OnShapesInClosedForm_FollowsTheHand) {
  Shapes shapes(4);
  for (int round = 0; round < 50; ++round) {
    const Vec3 origin_m = shapes.any(0.1), x = shapes.unit(),
               across = math::cross(x, shapes.unit());
    if (math::length(across) < 0.1f) continue;
    const Vec3 y = across * (1.0f / math::length(across)), z = math::cross(x, y);
    const math::Mat3 turn{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
    // Comes down to 2 mm below the top at 30 mm, goes along the shape, then leaps off it.
    const auto follow = [&](const auto& shape, Vec3 along) {
      scene::Proxy proxy;
      scene::ProxySettings settings;
      settings.radius_m = round % 2 == 0 ? 0.0f : 0.0001f;
      for (int tick = 0; tick < 200; ++tick) {
        const float up_m = tick < 100 ? 0.001f * static_cast<float>(128 - tick) : 0.028f;
        const float along_m = tick < 100 ? 0.0f : 0.0005f * static_cast<float>(tick - 100);
        const Vec3 hand_m = origin_m + turn * (Vec3{0, 0, up_m} + along * along_m);
        const scene::ProxyMoved moved = scene::move_proxy(settings, hand_m, shape, proxy);
        CHECK(!moved.is_starved);
        CHECK(proxy.phase == scene::Proxy::Phase::kFree);
        CHECK_LE(wide(proxy.radius_m) - 3e-6 * wide(shape.size_m()),
                 truth_m(shape, proxy.position_m));
        const double depth_m = wide(proxy.radius_m) - truth_m(shape, hand_m);
        CHECK_LE(size(less(proxy.position_m, hand_m)), std::fmax(depth_m, 0.0) + 1e-5);
      }
      const Vec3 beside_m = origin_m + turn * (along * 0.3f + Vec3{0, 0, 0.028f});
      if (truth_m(shape, beside_m) < 0) return;
      for (int tick = 0; tick < 50; ++tick)
        (void)scene::move_proxy(settings, beside_m, shape, proxy);
      CHECK_LE(size(less(proxy.position_m, beside_m)), 1e-6);
    };
    const auto to = [&](Vec3 p_m) { return origin_m + turn * p_m; };
    follow(scene::PlaneTouched{to({0, 0, 0.03f}), z, 0.1f}, {1, 0, 0});
    follow(scene::SphereTouched{origin_m, 0.03f}, {0.6f, 0.8f, 0});
    const Vec3 lying_m[2] = {to({-0.08f, 0, 0}), to({0.08f, 0, 0})};
    follow(scene::CapsuleTouched{{lying_m[0], lying_m[1]}, 0.03f}, {0.6f, 0.8f, 0});
    follow(scene::CylinderTouched{{lying_m[0], lying_m[1]}, 0.03f}, {0.6f, 0.8f, 0});
    follow(scene::CylinderTouched{{origin_m, to({0, 0, 0.03f})}, 0.08f}, {0.6f, 0.8f, 0});
    follow(scene::BoxTouched{{turn, origin_m}, {0.08f, 0.08f, 0.03f}}, {0.6f, 0.8f, 0});
  }
}

// Splines prove no way free: there a tool is at least as large as a fast hand needs.
TEST(SmallTool_OnASplineSurface_FollowsTheHand) {
  const spline_touch::Surface torus = spline_touch::torus();
  scene::SplineObject object;
  object.surface = &torus.view;
  spline::Hint hint;
  scene::SplineTouched shape{object, hint};
  for (const float radius_m : {0.0f, 0.00002f}) {
    scene::Proxy proxy;
    scene::ProxySettings settings;
    settings.radius_m = radius_m;
    double worst_m = 0;
    for (int tick = 0; tick < 1000; ++tick) {
      const double turn = tick < 100 ? 0 : (tick - 100) * 0.0003 / 0.05;
      const double up_m = tick < 100 ? 0.028 - 0.0001 * tick : 0.018;
      const Vec3 hand_m = tools::to_vec3({0.05 * std::cos(turn), 0.05 * std::sin(turn), up_m});
      (void)scene::move_proxy(settings, hand_m, shape, proxy);
      worst_m = std::fmax(worst_m, size(less(proxy.position_m, hand_m)));
    }
    CHECK(proxy.phase == scene::Proxy::Phase::kFree);
    CHECK_LE(worst_m, 0.0022);
  }
}
