#include "firmtouch/spline/proof/bend_bounds.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/numbers.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

constexpr uint32_t kOrders = 6;         // derivatives of order 0 to 5 are bounded
constexpr float kUp = 1.0f + 0x1p-16f;  // for sums and products of a few dozen roundings
constexpr float kChoose[kOrders][kOrders] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0},
                                             {1, 2, 1, 0, 0, 0}, {1, 3, 3, 1, 0, 0},
                                             {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};

// [j][k]: j (j - 1) ... of k factors.
constexpr float kFalling[kOrders][kOrders] = {
    {1}, {1, 1}, {1, 2, 2}, {1, 3, 6, 6}, {1, 4, 12, 24, 24}, {1, 5, 20, 60, 120, 120}};

float least(float a, float b) { return a < b ? a : b; }
float size_of(float a) { return a < 0.0f ? -a : a; }

float power(float base, uint32_t exponent) {
  float product = 1.0f;
  for (uint32_t k = 0; k < exponent; ++k) product *= base;
  return product;
}

/// By [order in x][order in y].
struct Sizes {
  float of[kOrders][kOrders];
};
struct Vectors {
  Vec3 of[kOrders - 1][kOrders - 1];
};

// Of a polynomial with coefficients of such sizes: the sums of what its derivatives' may amount to.
[[gnu::noinline]] void bound_sums(const LeafShape& shape, const float* size, Sizes& sums) {
  for (uint32_t b = 0; b < kOrders; ++b)
    for (uint32_t a = 0; a + b < kOrders; ++a) {
      float sum = 0.0f;
      for (uint32_t j = b; j <= shape.degree_v; ++j) {
        const float* const row = size + j * (shape.degree_u + 1);
        for (uint32_t i = a; i <= shape.degree_u; ++i)
          sum += kFalling[i][a] * kFalling[j][b] * row[i];
      }
      sums.of[a][b] = sum;
    }
}

// Of the numerator and of the weight.
void bound_sums(const LeafShape& shape, const Region& region, Sizes& c, Sizes& w) {
  float size_m[LeafShape::kMax], weight[LeafShape::kMax];
  float half_v = 1.0f;
  for (uint32_t at = 0, j = 0; j <= shape.degree_v; ++j, half_v *= region.half_v) {
    float half_u = 1.0f;
    for (uint32_t i = 0; i <= shape.degree_u; ++i, ++at, half_u *= region.half_u) {
      const float small = half_u * half_v;
      size_m[at] = math::length(shape.c[at]) + small * shape.numerator_noise_m;
      weight[at] = size_of(shape.w[at]) + small * shape.weight_noise;
    }
  }
  bound_sums(shape, size_m, c);
  if (shape.is_rational) bound_sums(shape, weight, w);
}

// With numerator = point * weight, Leibniz' rule gives each derivative of the point by the lower
// ones.
void quotient(const LeafShape& shape, Sizes& c, const Sizes& w) {
  for (uint32_t order = 0; order < kOrders; ++order)
    for (uint32_t b = 0; b <= order; ++b) {
      const uint32_t a = order - b;
      float sum = c.of[a][b];
      for (uint32_t l = 0; l <= b && shape.is_rational; ++l)
        for (uint32_t k = 0; k <= a; ++k)
          if (k + l < order) sum += kChoose[a][k] * kChoose[b][l] * c.of[k][l] * w.of[a - k][b - l];
      c.of[a][b] = sum / shape.min_weight * kUp;
    }
}

// The same in the middle, as vectors; the weight there is 1.
void middle_derivatives(const LeafShape& shape, Vectors& x) {
  const uint32_t columns = shape.degree_u + 1;
  for (uint32_t order = 0; order + 1 < kOrders; ++order)
    for (uint32_t b = 0; b <= order; ++b) {
      const uint32_t a = order - b;
      Vec3 sum{};
      if (a <= shape.degree_u && b <= shape.degree_v)
        sum = shape.c[b * columns + a] * (kFalling[a][a] * kFalling[b][b]);
      for (uint32_t l = 0; l <= b && shape.is_rational; ++l)
        for (uint32_t k = 0; k <= a; ++k) {
          const uint32_t i = a - k, j = b - l;
          if (k + l >= order || i > shape.degree_u || j > shape.degree_v) continue;
          const float weight = shape.w[j * columns + i] * kFalling[i][i] * kFalling[j][j];
          sum = sum - x.of[k][l] * (kChoose[a][k] * kChoose[b][l] * weight);
        }
      x.of[a][b] = sum;
    }
}

// What changes over the leaf, at most, from what it is in the middle: nothing is lost to the sizes
// of terms that cancel there. The numerator's own noise is in the sums already.
void tighten(const Vectors& x, Sizes& c) {
  for (uint32_t order = kOrders - 1; order-- > 1;)
    for (uint32_t b = 0; b <= order; ++b) {
      const uint32_t a = order - b;
      const float from_middle = (math::length(x.of[a][b]) + c.of[a + 1][b] + c.of[a][b + 1]) * kUp;
      c.of[a][b] = least(c.of[a][b], from_middle);
    }
}

// |p . q| over the leaf, p and q being the derivatives (a, b) and (k, l): by their sizes, or by
// what it is in the middle and how fast it may change from there.
float product(const Vectors& x, const Sizes& c, uint32_t a, uint32_t b, uint32_t k, uint32_t l) {
  const float sizes = c.of[a][b] * c.of[k][l];
  const float along_u = c.of[a + 1][b] * c.of[k][l] + c.of[a][b] * c.of[k + 1][l];
  const float along_v = c.of[a][b + 1] * c.of[k][l] + c.of[a][b] * c.of[k][l + 1];
  const float in_middle = size_of(dot(x.of[a][b], x.of[k][l])) + 0x1p-18f * sizes;
  return least(sizes, in_middle + along_u + along_v) * kUp;
}

// Sums of products p . q over the leaf, p and q being the derivatives (a, b) and (k, l): by their
// sizes, or by what each, or all together, are in the middle and how fast they may change from
// there.
struct Products {
  const Vectors& x;
  const Sizes& c;
  float in_middle = 0, change = 0;  // of all
  float most = 0, below = 0;  // of each by itself: its size, and by how much it may be below 0

  [[gnu::noinline]] void add(float times, uint32_t a, uint32_t b, uint32_t k, uint32_t l) {
    const float sizes = c.of[a][b] * c.of[k][l];
    const float along_u = product(x, c, a + 1, b, k, l) + product(x, c, a, b, k + 1, l);
    const float along_v = product(x, c, a, b + 1, k, l) + product(x, c, a, b, k, l + 1);
    const float middle = dot(x.of[a][b], x.of[k][l]);
    const float own_change = (0x1p-18f * sizes + along_u + along_v) * kUp;
    const bool is_square = a == k && b == l;
    in_middle += times * middle;
    change += times * own_change;
    most += times * least(sizes, size_of(middle) + own_change);
    below += times * least(is_square ? 0.0f : sizes, own_change - middle);
  }
  float size() const { return least(most, size_of(in_middle) + change) * kUp; }
  // Where it is less than 0, by so much it is above.
  float depth() const {
    const float depth = least(below, change - in_middle);
    return depth + size_of(depth) * 0x1p-16f;
  }
};

void bound_derivatives(const Region& region, LeafShape& shape, Vectors& x, Sizes& c) {
  Sizes w;
  bound_sums(shape, region, c, w);
  quotient(shape, c, w);
  middle_derivatives(shape, x);
  tighten(x, c);
}

// Of a part of something no two points of which are farther apart than span_m.
void bound_bends(const Region& region, float span_m, LeafShape& shape) {
  Sizes c;
  Vectors x;
  bound_derivatives(region, shape, x, c);
  Products uuuu{x, c}, uuuv{x, c}, uuvv{x, c}, uvvv{x, c}, vvvv{x, c};
  uuuu.add(4.0f, 1, 0, 3, 0), uuuu.add(3.0f, 2, 0, 2, 0);
  uuuv.add(1.0f, 0, 1, 3, 0), uuuv.add(3.0f, 1, 0, 2, 1), uuuv.add(3.0f, 2, 0, 1, 1);
  uuvv.add(2.0f, 1, 0, 1, 2), uuvv.add(2.0f, 0, 1, 2, 1);
  uuvv.add(1.0f, 2, 0, 0, 2), uuvv.add(2.0f, 1, 1, 1, 1);
  uvvv.add(1.0f, 1, 0, 0, 3), uvvv.add(3.0f, 0, 1, 1, 2), uvvv.add(3.0f, 0, 2, 1, 1);
  vvvv.add(4.0f, 0, 1, 0, 3), vvvv.add(3.0f, 0, 2, 0, 2);
  const float u = region.half_u, v = region.half_v;
  const float products[5] = {uuuu.depth(), uuuv.size(), uuvv.depth(), uvvv.size(), vvvv.depth()};
  for (uint32_t k = 0; k < 5; ++k) {
    // By the piece's s and t: the halves are powers of two.
    const float turning = c.of[4 - k][k] * kUp, halves = power(u, 4 - k) * power(v, k);
    const float fixed = products[k] + turning * span_m * kUp;
    shape.fixed[k] = fixed > 0.0f ? fixed * kUp / halves : 0.0f;
    shape.turning[k] = turning * kUp / halves;
  }
}

// Of the fourth derivative of D^2 / 2 the terms without the query, 4 x1 . x3 + 3 x2 . x2 of the
// derivatives x1 to x4: by how much they may be below 0. Their own derivative, 10 x2 . x3 + 4 x1 .
// x4, bounds how fast they leave their value in the middle.
float lowest_of(const Region& region, const LeafShape& shape, const Vectors& x, const Sizes& c) {
  const float one = c.of[1][0], two = c.of[2][0], three = c.of[3][0], four = c.of[4][0];
  const float u = region.half_u;
  // Of a middle derivative: what its coefficients may be off, by Leibniz' rule.
  const float off_m =
      16.0f * (shape.numerator_noise_m + shape.weight_noise * shape.reach_m) / shape.min_weight;
  const float sizes = 4.0f * one * three + 3.0f * two * two;
  const float in_middle =
      4.0f * dot(x.of[1][0], x.of[3][0]) + 3.0f * dot(x.of[2][0], x.of[2][0]) - 0x1p-18f * sizes -
      off_m * (4.0f * (u * three + 6.0f * u * u * u * one) + 12.0f * u * u * two);
  const float low = in_middle - (10.0f * two * three + 4.0f * one * four) * kUp;
  const float below = least(-low, 4.0f * one * three);
  return below + 0x1p-16f * size_of(below);
}

}  // namespace

// Beside what a point loses, its derivatives lose so many times more (search.hpp), and each product
// is rounded; what the query's difference from a point loses counts with the derivative that it
// meets.
CurveBend CurveBends::stored() const {
  const float sum_m2 = lowest + turning * span_m * kUp;
  CurveBend bend{};
  bend.fixed_m2 = sum_m2 > 0.0f ? sum_m2 * kUp : 0.0f;
  bend.turning_m = turning;
  const float third = 0.6666667f;
  bend.noise_m2 = (loss_m * (kBendNoise * speed + swing) + 8.0f * kUnit * speed * speed +
                   third * (loss_m * (3.0f * (kSlopeNoise * swing + kBendNoise * speed) + twist) +
                            72.0f * kUnit * speed * swing)) *
                  kUp;
  bend.noise_turning_m = (kBendNoise * loss_m + 14.0f * kUnit * swing +
                          third * (kTwistNoise * loss_m + 30.0f * kUnit * twist)) *
                         kUp;
  return bend;
}

bool add_bends(const Piece& piece, const float* coefficients, uint32_t fine_step,
               CurveBends& bends) {
  Region region{};
  region.half_u = 1.0f / static_cast<float>(kFineSteps);
  region.middle_u = region.half_u * static_cast<float>(2 * fine_step + 1) - 1.0f;
  region.half_v = 1.0f;
  LeafShape shape;
  derive(piece, coefficients, region, shape);
  if (!(shape.min_weight > 0.0f)) return false;
  Sizes c;
  Vectors x;
  bound_derivatives(region, shape, x, c);
  const float fourth = region.half_u * region.half_u * region.half_u * region.half_u;
  const float lowest = lowest_of(region, shape, x, c) / fourth, turning = c.of[4][0] * kUp / fourth;
  if (fine_step == 0 || !(lowest <= bends.lowest)) bends.lowest = lowest;  // NaN stays
  if (!(turning <= bends.turning)) bends.turning = turning;
  bends.span_m = (bends.span_m + 2.0f * shape.reach_m) * kUp;
  const float per_half = 1.0f / region.half_u;
  const auto keep = [](float& most, float size) {
    if (!(size <= most)) most = size;
  };
  keep(bends.speed, c.of[1][0] * per_half);
  keep(bends.swing, c.of[2][0] * per_half * per_half);
  keep(bends.twist, c.of[3][0] * per_half * per_half * per_half);
  keep(bends.loss_m, shape.loss_m);
  return true;
}

void bound_bends(const Region& region, LeafShape& shape) {
  bound_bends(region, 2.0f * shape.reach_m, shape);
}

bool begin_bends(const Piece& piece, const float* coefficients, const Region& cell,
                 CellBends& bends) {
  LeafShape whole;
  derive(piece, coefficients, cell, whole);
  bends = {};
  bends.span_m = 2.0f * whole.reach_m;
  return whole.min_weight > 0.0f;
}

bool add_bends(const Piece& piece, const float* coefficients, const Region& cell,
               uint32_t fine_step, CellBends& bends) {
  Region region;
  constexpr float kShare = 1.0f / kFineSide, kFirst = kFineSide - 1;
  region.half_u = kShare * cell.half_u;
  region.half_v = kShare * cell.half_v;
  const uint32_t column = fine_step % kFineSide, row = fine_step / kFineSide;
  region.middle_u = cell.middle_u + region.half_u * (2.0f * static_cast<float>(column) - kFirst);
  region.middle_v = cell.middle_v + region.half_v * (2.0f * static_cast<float>(row) - kFirst);
  LeafShape shape;
  derive(piece, coefficients, region, shape);
  if (!(shape.min_weight > 0.0f)) return false;
  bound_bends(region, bends.span_m, shape);
  for (uint32_t k = 0; k < 5; ++k) {  // NaN stays
    if (!(shape.fixed[k] <= bends.fixed[k])) bends.fixed[k] = shape.fixed[k];
    if (!(shape.turning[k] <= bends.turning[k])) bends.turning[k] = shape.turning[k];
  }
  return true;
}

}  // namespace firmtouch::spline
