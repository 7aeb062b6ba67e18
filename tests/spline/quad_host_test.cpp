// How near the quads that stand for parts of surfaces may be, and what lies about them.
#include <cmath>

#include "firmtouch/spline/proof/patch_radius.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace spline = firmtouch::spline;
namespace math = firmtouch::math;
using firmtouch::tools::Random;

namespace {

struct WidePoint {
  double x, y, z;
};
WidePoint wide(math::Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

struct Area {
  double low[2] = {-1, -1}, high[2] = {1, 1};
};
double distance(const spline::Quad& quad, math::Vec3 q, double x, double y) {
  const WidePoint c = wide(quad.centre), a = wide(quad.a), b = wide(quad.b), t = wide(quad.twist),
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
  const WidePoint c = wide(quad.centre), a = wide(quad.a), b = wide(quad.b), t = wide(quad.twist);
  return {static_cast<float>(c.x + x * a.x + y * b.x + x * y * t.x + off * random.bell()),
          static_cast<float>(c.y + x * a.y + y * b.y + x * y * t.y + off * random.bell()),
          static_cast<float>(c.z + x * a.z + y * b.z + x * y * t.z + off * random.bell())};
}

// A point without weights: coefficients are to come.
spline::LeafShape leaf_of(uint32_t degree_u, uint32_t degree_v) {
  spline::LeafShape leaf;
  leaf.degree_u = degree_u, leaf.degree_v = degree_v;
  for (float& weight : leaf.w) weight = 0.0f;
  return leaf;
}
// Fills what derive() finds of coefficients and weights.
void finish(spline::LeafShape& leaf) {
  float sizes_m = 0.0f, weights = 0.0f;
  for (uint32_t k = 1; k < (leaf.degree_u + 1) * (leaf.degree_v + 1); ++k) {
    sizes_m += math::length(leaf.c[k]);
    weights += std::fabs(leaf.w[k]);
  }
  leaf.w[0] = 1.0f;
  leaf.min_weight = 1.0f - weights;
  leaf.reach_m = sizes_m / leaf.min_weight;
}
spline::LeafShape any_leaf(Random& random, const spline::Quad& quad, bool is_rational) {
  const auto one = [&](double size) { return static_cast<float>(random.between(-size, size)); };
  const auto degree_u = 1 + static_cast<uint32_t>(random.between(0, 4.99));
  spline::LeafShape leaf = leaf_of(degree_u, 1 + static_cast<uint32_t>(random.between(0, 4.99)));
  leaf.is_rational = is_rational;
  leaf.local_m = quad.centre;
  const uint32_t count = (leaf.degree_u + 1) * (leaf.degree_v + 1);
  for (uint32_t k = 1; k < count; ++k) {
    leaf.c[k] = {one(3000), one(3000), one(3000)};
    if (is_rational) leaf.w[k] = one(0.9 / count);
  }
  finish(leaf);
  return leaf;
}
math::Vec3 point_of(const spline::LeafShape& leaf, double x, double y) {
  WidePoint sum{};
  double weight = 0;
  for (uint32_t j = 0; j <= leaf.degree_v; ++j)
    for (uint32_t i = 0; i <= leaf.degree_u; ++i) {
      const uint32_t k = j * (leaf.degree_u + 1) + i;
      const double power = std::pow(x, i) * std::pow(y, j);
      const WidePoint c = wide(leaf.c[k]);
      sum = {sum.x + c.x * power, sum.y + c.y * power, sum.z + c.z * power};
      weight += static_cast<double>(leaf.w[k]) * power;
    }
  const WidePoint at = wide(leaf.local_m);
  return {static_cast<float>(at.x + sum.x / weight), static_cast<float>(at.y + sum.y / weight),
          static_cast<float>(at.z + sum.z / weight)};
}
// Of points of the leaf, from a part of the quad.
double most_off(const spline::LeafShape& leaf, const spline::Quad& quad, const Area& area) {
  double most = 0;
  for (int k = 0; k < 81; ++k)
    most = std::fmax(most, distance(quad, point_of(leaf, k % 9 / 4.0 - 1, k / 9 / 4.0 - 1), area));
  return most;
}
double radius_of(const spline::LeafShape& leaf, const spline::Quad& quad,
                 const spline::RegionOfQuad& own, const spline::RegionOfQuad& within = {}) {
  return static_cast<double>(spline::radius_for(spline::LeafPoints(leaf), quad, own, within));
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

TEST(NoPointOfALeafIsFartherOffAPartOfAQuadThanItsRadius) {
  Random random(78);
  for (int i = 0; i < 400; ++i) {
    firmtouch::test::note("leaf", i);
    const spline::Quad quad = any_quad(random, i % 4);
    const spline::LeafShape leaf = any_leaf(random, quad, i % 3 == 0);
    spline::RegionOfQuad own, within;
    for (int axis = 0; axis < 2; ++axis) {
      const double wide_by = std::pow(2.0, std::floor(random.between(-3, 1.99)));
      own.low[axis] = static_cast<float>(random.between(-1, 1 - wide_by));
      own.high[axis] = own.low[axis] + static_cast<float>(wide_by);
    }
    within.high[i / 4 % 2] = static_cast<float>(random.between(0, 1));
    const Area area{{static_cast<double>(within.low[0]), static_cast<double>(within.low[1])},
                    {static_cast<double>(within.high[0]), static_cast<double>(within.high[1])}};
    CHECK(most_off(leaf, quad, area) <= radius_of(leaf, quad, own, within));
  }
}

// A small part of a quad is compared with a leaf at s and t of -1, 0 and 1 alone. Between them its
// powers, its weights or the quad's twist lead farther off than there.
TEST(ARadiusHoldsWhatIsBetweenThePointsComparedToo) {
  const spline::RegionOfQuad own{{-0.2f, -0.2f}, {0.2f, 0.2f}};
  spline::LeafShape by_powers = leaf_of(3, 1);
  by_powers.c[1] = {0.2f, 0, -1}, by_powers.c[3] = {0, 0, 1}, by_powers.c[4] = {0, 0.2f, 0};
  spline::LeafShape by_weights = leaf_of(2, 1);
  by_weights.is_rational = true;
  by_weights.c[1] = {0.2f, 0, 0}, by_weights.c[3] = {0, 0.2f, 1};
  by_weights.w[1] = -0.25f, by_weights.w[2] = 0.25f;
  spline::LeafShape by_twist = leaf_of(1, 1);
  by_twist.local_m = {0, 0, 0.05f}, by_twist.c[1] = {0.5f, 0.5f, 0.05f};
  const struct {
    spline::LeafShape& leaf;
    spline::Quad quad;
  } cases[] = {{by_powers, {{}, {1, 0, 0}, {0, 1, 0}, {}}},
               {by_weights, {{}, {1, 0, 0}, {0, 1, 0}, {}}},
               {by_twist, {{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.2f}}}};
  for (const auto& of : cases) {
    finish(of.leaf);
    CHECK(most_off(of.leaf, of.quad, Area{}) <= radius_of(of.leaf, of.quad, own));
  }
}
