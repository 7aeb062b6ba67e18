#include "firmtouch/spline/proof/leaf_shape.hpp"

#include "firmtouch/spline/numbers.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// A polynomial of degree 5 moved to another middle: at most 10 |c| a coefficient in 10 roundings.
constexpr float kShiftNoise = 128.0f * kUnit;
constexpr float kUp = 1.0f + 0x1p-16f;  // for sums and products of a few dozen roundings

float half_of(uint32_t level) { return math::float_of((127u - level) << 23); }

struct Four {
  float v[4];

  void add(float times, const Four& f) {
    v[0] += times * f.v[0];
    v[1] += times * f.v[1];
    v[2] += times * f.v[2];
    v[3] += times * f.v[3];
  }
};

// Powers of s about 0 become powers of x about middle, with s = middle + half x, for `count` rows.
void shift(Four* c, uint32_t degree, uint32_t stride, float middle, float half) {
  for (uint32_t low = 0; low < degree; ++low)
    for (uint32_t k = degree; k-- > low;) c[k * stride].add(middle, c[(k + 1) * stride]);
  float scale = half;
  for (uint32_t k = 1; k <= degree; ++k, scale *= half)
    for (uint32_t d = 0; d < 4; ++d) c[k * stride].v[d] *= scale;
}

Vec3 vec(const Four& f) { return {f.v[0], f.v[1], f.v[2]}; }

// A length and what a query loses when it measures against a node of that size.
float with_slack(float derived_m, float size_m) {
  return derived_m * (1.0f + 0x1p-18f) + size_m * 0x1p-19f;
}

// What is lost when evaluation.hpp computes a point: Horner's rule rounds twice a power, the
// query's difference from the origin and the sum of a square once each.
struct Sums {
  float points_m = 0, weights = 0;    // of the coefficients' sizes
  float lost_m = 0, lost_weight = 0;  // in units of kUnit
};
Sums sums_of(const Four* c, uint32_t degree_u, uint32_t degree_v) {
  Sums sums;
  for (uint32_t j = 0; j <= degree_v; ++j)
    for (uint32_t i = 0; i <= degree_u; ++i) {
      const Four& f = c[j * (degree_u + 1) + i];
      const float size_m = math::length(vec(f)), weight = f.v[3] < 0.0f ? -f.v[3] : f.v[3];
      const float roundings = static_cast<float>(2 * (i + j) + 1);
      sums.points_m += size_m;
      sums.weights += weight;
      sums.lost_m += roundings * size_m;
      sums.lost_weight += roundings * weight;
    }
  return sums;
}

// a + b x^2 for x from -1 to 1 is longest at an end, for the norm is convex.
float longest(Vec3 a, Vec3 b) {
  const float at_0 = math::length(a), at_1 = math::length(a + b);
  return at_0 > at_1 ? at_0 : at_1;
}

// How far the leaf is from the straight line from a to b, rounded up; a curve's.
float off_chord_m(const LeafShape& shape, Vec3 a_m, Vec3 b_m) {
  // (point - (a + b) / 2 - x (b - a) / 2) * weight, as a polynomial of one degree more.
  const Vec3 half_m = (b_m - a_m) * 0.5f, off_m = (a_m + half_m) - shape.middle_m;
  Vec3 e[kMaxDegree + 3] = {};
  for (uint32_t k = 0; k <= shape.degree_u; ++k) {
    e[k] = e[k] + shape.c[k] - off_m * shape.w[k];
    e[k + 1] = e[k + 1] - half_m * shape.w[k];
  }
  float sum_m = longest(e[0], e[2]) + longest(e[1], e[3]);
  for (uint32_t k = 4; k <= kMaxDegree + 1; ++k) sum_m += math::length(e[k]);
  return sum_m / shape.min_weight * kUp + shape.noise_m +
         4.0f * kUnit * (math::length(a_m) + math::length(b_m));
}

// How far a point is from that line, rounded up.
float off_line_m(Vec3 p_m, Vec3 a_m, Vec3 b_m) {
  const Vec3 along_m = b_m - a_m, from_m = p_m - a_m;
  const float length2_m2 = dot(along_m, along_m), progress_m2 = dot(from_m, along_m);
  float t = length2_m2 > 0.0f ? progress_m2 / length2_m2 : 0.0f;
  t = t > 0.0f ? t < 1.0f ? t : 1.0f : 0.0f;
  return math::length(from_m - along_m * t) * kUp +
         4.0f * kUnit * (math::length(p_m) + math::length(a_m) + math::length(b_m));
}

}  // namespace

Region region_of(const Halvings& made, uint32_t u, uint32_t v) {
  const float half_u = half_of(made.u), half_v = half_of(made.v);
  return {static_cast<float>(2 * u + 1) * half_u - 1.0f, half_u,
          static_cast<float>(2 * v + 1) * half_v - 1.0f, half_v};
}
Region region_of(const Piece& piece, uint32_t index_u, uint32_t index_v) {
  return region_of(Halvings{piece.level_u, piece.level_v}, index_u, index_v);
}

void derive(const Piece& piece, const float* coefficients, const Region& region, LeafShape& shape) {
  const uint32_t nu = piece.degree_u + 1u, nv = piece.degree_v + 1u;
  Four c[LeafShape::kMax];
  for (uint32_t k = 0; k < nu * nv; ++k) {
    const float* from = coefficients + k * (piece.is_rational != 0 ? 4u : 3u);
    for (uint32_t d = 0; d < 3; ++d) c[k].v[d] = from[d];
    c[k].v[3] = piece.is_rational != 0 ? from[3] : k == 0 ? 1.0f : 0.0f;
  }
  const Sums sums = sums_of(c, piece.degree_u, piece.degree_v);
  for (uint32_t j = 0; j < nv; ++j)
    shift(c + j * nu, piece.degree_u, 1, region.middle_u, region.half_u);
  for (uint32_t i = 0; i < nu; ++i)
    shift(c + i, piece.degree_v, nu, region.middle_v, region.half_v);

  shape.is_rational = piece.is_rational != 0;
  shape.degree_u = piece.degree_u;
  shape.degree_v = piece.degree_v;
  const float weight = c[0].v[3], per_weight = 1.0f / weight;
  const Vec3 middle_m = vec(c[0]) * per_weight;  // from the origin
  const Vec3 origin_m{piece.origin_m[0], piece.origin_m[1], piece.origin_m[2]};
  shape.local_m = middle_m;
  shape.middle_m = origin_m + middle_m;
  const float away_m = math::length(middle_m);
  float others = 0, reach_m = 0;
  for (uint32_t k = 0; k < nu * nv; ++k) {
    shape.w[k] = c[k].v[3] * per_weight;
    shape.c[k] = vec(c[k]) * per_weight - middle_m * shape.w[k];
    if (k > 0) others += shape.w[k] < 0.0f ? -shape.w[k] : shape.w[k];
    reach_m += math::length(shape.c[k]);
  }
  const float noise_w = piece.is_rational != 0 ? kShiftNoise * sums.weights * per_weight : 0.0f;
  const float noise_m = kShiftNoise * sums.points_m * per_weight + noise_w * away_m;
  shape.min_weight = piece.is_rational != 0 ? 1.0f - others * kUp - noise_w : 1.0f;
  if (!(weight > 0.0f && shape.min_weight > 0.5f)) {
    shape.min_weight = 0.0f;
    return;
  }
  const float per_least = 1.0f / shape.min_weight;
  const float origin_size_m = math::length(origin_m);
  shape.reach_m = (reach_m + noise_m) * per_least * kUp;
  shape.noise_m = noise_m * per_least * kUp + 2.0f * kUnit * (origin_size_m + away_m);
  const float point_m = away_m + shape.reach_m;
  const float lost_m = sums.lost_m + (piece.is_rational != 0 ? sums.lost_weight * point_m : 0.0f);
  const float lowest = weight * shape.min_weight;
  shape.loss_m = kUnit * kUp * (lost_m / lowest + (piece.is_rational != 0 ? 5.0f : 2.0f) * point_m);
  shape.numerator_noise_m = noise_m;
  shape.weight_noise = noise_w;
}

Extent extent_along(const LeafShape& shape, Vec3 centre_m, Vec3 axis, By by) {
  float low = 0, high = 0;
  for (uint32_t at = 1, j = by == By::kBall ? shape.degree_v + 1 : 0; j <= shape.degree_v; ++j)
    for (uint32_t i = j == 0 ? 1 : 0; i <= shape.degree_u; ++i, ++at) {
      const float along = dot(shape.c[at], axis);
      const float size = along < 0.0f ? -along : along;
      const bool is_even = (i & 1u) == 0 && (j & 1u) == 0;  // then x^i y^j is never below 0
      if (!is_even || along > 0.0f) high += size;
      if (!is_even || along < 0.0f) low -= size;
    }
  const Vec3 off_m = shape.middle_m - centre_m;
  const float off = dot(off_m, axis);
  // Divided by the weight: the numerator by the least one where that leads outward.
  const float noise_m = shape.noise_m + 8.0f * kUnit * math::length(off_m);
  low = low / shape.min_weight * kUp;
  high = high / shape.min_weight * kUp;
  if (by == By::kBall) low = -shape.reach_m, high = shape.reach_m;
  return {off + low - noise_m, off + high + noise_m};
}

float radius_for(const LeafShape& shape, Vec3 a_m, Vec3 b_m) {
  return with_slack(off_chord_m(shape, a_m, b_m), math::length(b_m - a_m));
}

// The distance to a straight line is convex: along the leaf's own line it is most at an end.
float radius_above(float leaf_radius_m, Vec3 leaf_a_m, Vec3 leaf_b_m, Vec3 a_m, Vec3 b_m) {
  const float first_m = off_line_m(leaf_a_m, a_m, b_m), last_m = off_line_m(leaf_b_m, a_m, b_m);
  return with_slack((first_m > last_m ? first_m : last_m) + leaf_radius_m, math::length(b_m - a_m));
}

void enlarge(const LeafShape& shape, Box& box, By by) {
  const Vec3 a{box.axis[0][0], box.axis[0][1], box.axis[0][2]};
  const Vec3 b{box.axis[1][0], box.axis[1][1], box.axis[1][2]};
  const Vec3 axes[3] = {a, b, cross(a, b)};
  float needed[3], size_m = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const Extent e =
        extent_along(shape, {box.centre_m[0], box.centre_m[1], box.centre_m[2]}, axes[k], by);
    needed[k] = -e.low > e.high ? -e.low : e.high;
    size_m += needed[k];
  }
  for (uint32_t k = 0; k < 3; ++k) {
    const float half_m = with_slack(needed[k], size_m);
    if (!(half_m <= box.half_m[k])) box.half_m[k] = half_m;
  }
}

bool leaf_fits(const LeafShape& shape, const Box& box) {
  const auto fits = [&](By by) {
    Box enlarged = box;
    enlarge(shape, enlarged, by);
    for (uint32_t k = 0; k < 3; ++k)
      if (!(enlarged.half_m[k] <= box.half_m[k])) return false;
    return true;
  };
  return fits(By::kBall) || fits(By::kCoefficients);
}

uint32_t byte_above(float unit, float value) {
  if (!(value > unit)) return value <= unit ? 0 : 256;
  const uint32_t over = math::bits_of(value) - math::bits_of(unit);
  const uint32_t byte = (over + 0xFFFFFu) >> 20;
  return byte < 256 ? byte : 256;
}

}  // namespace firmtouch::spline
