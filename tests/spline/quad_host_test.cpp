// How near the quads that stand for parts of surfaces may be, and what lies about them.
#include <cmath>

#include "firmtouch/spline/surface/patch_grid.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace spline = firmtouch::spline;
namespace math = firmtouch::math;
using firmtouch::tools::Random;

namespace {

struct Point {
  double x, y, z;
};
Point wide(math::Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

struct Area {
  double low[2] = {-1, -1}, high[2] = {1, 1};
};
double distance(const spline::Quad& quad, math::Vec3 q, double x, double y) {
  const Point c = wide(quad.centre), a = wide(quad.a), b = wide(quad.b), t = wide(quad.twist),
              p = wide(q);
  return std::hypot(c.x + x * a.x + y * b.x + x * y * t.x - p.x,
                    c.y + x * a.y + y * b.y + x * y * t.y - p.y,
                    c.z + x * a.z + y * b.z + x * y * t.z - p.z);
}
// Of points of it, finer and finer about the nearest: at least what it is.
double distance(const spline::Quad& quad, math::Vec3 q, Area in) {
  constexpr int kSteps = 16;
  double least = HUGE_VAL;
  for (int turn = 0; turn < 8; ++turn) {
    const double step[2] = {(in.high[0] - in.low[0]) / kSteps, (in.high[1] - in.low[1]) / kSteps};
    double best[2] = {};
    double here = HUGE_VAL;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; k <= kSteps; ++k) {
        const double x = in.low[0] + i * step[0], y = in.low[1] + k * step[1];
        const double d = distance(quad, q, x, y);
        if (d < here) here = d, best[0] = x, best[1] = y;
      }
    least = std::fmin(least, here);
    for (int k = 0; k < 2; ++k) {
      in.low[k] = std::fmax(in.low[k], best[k] - 2 * step[k]);
      in.high[k] = std::fmin(in.high[k], best[k] + 2 * step[k]);
    }
  }
  return least;
}

double size_of(math::Vec3 v) { return distance({{}, {}, {}, {}}, v, 0, 0); }
// As much as stored radii hold beside.
double slack(const spline::Quad& quad) {
  return 0x1p-18 * (size_of(quad.centre) + size_of(quad.a) + size_of(quad.b) + size_of(quad.twist));
}

spline::Corner corner(Random& random, double size) {
  const auto one = [&] { return static_cast<int16_t>(random.between(-size, size)); };
  return {one(), one(), one()};
}
// Any four corners; those of a part that tapers, to a point too; next to flat ones.
spline::Quad any_quad(Random& random, int kind) {
  spline::Corner of[4];
  const double size = kind == 3 ? 30 : 3000;
  for (spline::Corner& c : of) c = corner(random, size);
  const auto near = [&](const spline::Corner& c, int by) {
    const auto one = [&](int v) { return static_cast<int16_t>(v + random.between(-by, by)); };
    return spline::Corner{one(c.x), one(c.y), one(c.z)};
  };
  if (kind == 1) of[1] = near(of[0], 0), of[3] = near(of[2], 900);
  if (kind == 2) {
    of[1] = near(of[0], 40);
    of[3] = near({static_cast<int16_t>(of[2].x + of[1].x - of[0].x),
                  static_cast<int16_t>(of[2].y + of[1].y - of[0].y),
                  static_cast<int16_t>(of[2].z + of[1].z - of[0].z)},
                 20);
  }
  return spline::quarters_between(of, 1, 2);
}
math::Vec3 any_query(Random& random, const spline::Quad& quad, int i) {
  const double x = random.between(-1.5, 1.5), y = random.between(-1.5, 1.5);
  const double off = std::pow(10.0, random.between(-2, 3)) * (i % 5 == 0 ? 0 : 20);
  const Point c = wide(quad.centre), a = wide(quad.a), b = wide(quad.b), t = wide(quad.twist);
  return {static_cast<float>(c.x + x * a.x + y * b.x + x * y * t.x + off * random.bell()),
          static_cast<float>(c.y + x * a.y + y * b.y + x * y * t.y + off * random.bell()),
          static_cast<float>(c.z + x * a.z + y * b.z + x * y * t.z + off * random.bell())};
}

}  // namespace

TEST(NoPointOfAQuadIsNearerThanItsBoundNorOfItsHalvesThanTheirs) {
  Random random(77);
  double reported = 0, true_ = 0;
  for (int i = 0; i < 4000; ++i) {
    firmtouch::test::note("quad", i);
    const spline::Quad quad = any_quad(random, i % 4);
    const math::Vec3 q = any_query(random, quad, i / 4);
    spline::Seen seen;
    spline::see(quad, q, seen);
    spline::Foot foot;
    spline::foot_on(quad, seen, foot);
    const double least = distance(quad, q, Area{});
    const auto lower = [](float reported_of) {
      return static_cast<double>(reported_of) * (1 - 0x1p-20);
    };
    CHECK(lower(foot.distance) <= least + slack(quad));
    reported += static_cast<double>(foot.distance);
    true_ += least;
    const double overlap = random.between(0, 0.25);
    const spline::Axis u{quad.a, foot.x}, v{quad.b, foot.y};
    for (int axis = 0; axis < 2; ++axis) {
      const float at = axis == 0 ? foot.x : foot.y;
      const float excess = std::fabs(at) - static_cast<float>(overlap);
      if (!(excess > 0.0f)) continue;
      Area half;
      if (at < 0.0f)
        half.low[axis] = -overlap;
      else
        half.high[axis] = overlap;
      const float bound =
          axis == 0 ? spline::half_bound(foot, u, v, quad.twist, seen.ab, seen.per_bb, excess)
                    : spline::half_bound(foot, v, u, quad.twist, seen.ab, seen.per_aa, excess);
      const double of_half = distance(quad, q, half);
      CHECK(lower(bound) <= of_half + slack(quad));
      reported += static_cast<double>(bound);
      true_ += of_half;
    }
  }
  CHECK(reported > 0.8 * true_);  // a bound of next to nothing would hold too
}
