#include "firmtouch/spline/proof/patch_radius.hpp"

#include <float.h>

#include "firmtouch/spline/numbers.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

float sized(float value) { return __builtin_fabsf(value); }
float size_of(const Quad& quad) {
  return math::length(quad.centre) + math::length(quad.a) + math::length(quad.b) +
         math::length(quad.twist);
}

struct OnQuad {
  float x, y;
};

// About the nearest points of a part of a quad, from where they are thought to be: as of the
// parallelogram with the tangents in one place.
struct Nearest {
  const RegionOfQuad& within;
  Vec3 a, b;
  float aa, ab, bb, per_aa, per_bb, per_both;  // the last 0 where they are next to parallel

  Nearest(const Quad& quad, OnQuad middle, const RegionOfQuad& region)
      : within(region), a(quad.a + quad.twist * middle.y), b(quad.b + quad.twist * middle.x) {
    aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
    const float both = aa * bb - ab * ab;
    per_aa = 1.0f / (aa + FLT_MIN);
    per_bb = 1.0f / (bb + FLT_MIN);
    per_both = both > 0x1p-12f * (aa * bb) ? 1.0f / both : 0.0f;
  }
  // off: from there to the point.
  OnQuad to(Vec3 off, OnQuad from) const {
    const float of_a = dot(a, off), of_b = dot(b, off);
    float x = held(0, from.x + (bb * of_a - ab * of_b) * per_both);
    const float y = held(1, from.y + (of_b - ab * (x - from.x)) * per_bb);
    x = held(0, from.x + (of_a - ab * (y - from.y)) * per_aa);
    return {x, y};
  }
  // The sign of a zero, which the two leave open, changes no distance.
  float held(uint32_t axis, float at) const {
    return math::smaller(math::larger(at, within.low[axis]), within.high[axis]);
  }
};

// The most that x and y differ between neighbours of a grid.
struct Strides {
  float x = 0.0f, y = 0.0f;
  void add(OnQuad a, OnQuad b) {
    x = math::larger(x, sized(a.x - b.x));
    y = math::larger(y, sized(a.y - b.y));
  }
};

// At most, the sum of the second derivatives by x and by y of a leaf: of the numerator by the
// weight.
float bent_of(const LeafShape& shape) {
  float first_m[2] = {}, second_m[2] = {}, first_w[2] = {}, second_w[2] = {};
  for (uint32_t j = 0; j <= shape.degree_v; ++j)
    for (uint32_t i = 0; i <= shape.degree_u; ++i) {
      const uint32_t k = j * (shape.degree_u + 1) + i, power[2] = {i, j};
      const float size_m = math::length(shape.c[k]), weight = sized(shape.w[k]);
      for (uint32_t axis = 0; axis < 2; ++axis) {
        const float once = static_cast<float>(power[axis]), twice = once * (once - 1.0f);
        first_m[axis] += once * size_m;
        second_m[axis] += twice * size_m;
        first_w[axis] += once * weight;
        second_w[axis] += twice * weight;
      }
    }
  const float per_least = 1.0f / shape.min_weight;
  float sum_m = 0.0f;
  for (uint32_t axis = 0; axis < 2; ++axis) {
    const float slope_m = (first_m[axis] + shape.reach_m * first_w[axis]) * per_least;
    sum_m += (second_m[axis] + 2.0f * slope_m * first_w[axis] + shape.reach_m * second_w[axis]) *
             per_least;
  }
  return sum_m;
}

template <class T>
T by_powers(const T* c, uint32_t stride, uint32_t degree, float x) {
  T sum = c[degree * stride];  // NOLINT(clang-analyzer-core*): there are degree + 1
  while (degree-- > 0) sum = sum * x + c[degree * stride];
  return sum;
}

// Of a grid's `k`th point x, or y.
float at_grid(uint32_t k) { return static_cast<float>(k) * (2.0f / 6.0f) - 1.0f; }

}  // namespace

LeafPoints::LeafPoints(const LeafShape& shape)
    : bent_m(bent_of(shape)), reach_m(shape.reach_m), noise_m(shape.noise_m) {
  const uint32_t columns = shape.degree_u + 1;
  for (uint32_t j = 0; j < kSide; ++j) {
    Vec3 along[kMaxDegree + 1];
    float weight[kMaxDegree + 1];
    for (uint32_t i = 0; i < columns; ++i) {
      along[i] = by_powers(shape.c + i, columns, shape.degree_v, at_grid(j));
      if (shape.is_rational)
        weight[i] = by_powers(shape.w + i, columns, shape.degree_v, at_grid(j));
    }
    for (uint32_t i = 0; i < kSide; ++i) {
      const Vec3 sum = by_powers(along, 1, shape.degree_u, at_grid(i));
      const float divisor =
          shape.is_rational ? by_powers(weight, 1, shape.degree_u, at_grid(i)) : 1.0f;
      at_m[j][i] = shape.local_m + sum * (1.0f / divisor);
    }
  }
}

Quad stored_quad(const Piece& piece, const Grid& grid, const Corner* corners, const Patch& patch) {
  return quad_of(piece, grid, corners, patch, halvings_of(piece, patch.depth));
}

RegionOfQuad own_of(const Piece& piece, const Patch& above, const Patch& leaf) {
  const Halvings made = halvings_of(piece, above.depth);
  const uint32_t left[2] = {piece.level_u - made.u, piece.level_v - made.v};
  const uint32_t at[2] = {leaf.u - (above.u << left[0]), leaf.v - (above.v << left[1])};
  RegionOfQuad own;
  for (uint32_t k = 0; k < 2; ++k) {
    const float wide = math::float_of((128u - left[k]) << 23);
    own.low[k] = static_cast<float>(at[k]) * wide - 1.0f;
    own.high[k] = own.low[k] + wide;
  }
  return own;
}

RegionOfQuad half_of(const Piece& piece, const Patch& above, const Patch& leaf, uint32_t overlap) {
  const Halvings made = halvings_of(piece, above.depth);
  const uint32_t axis = halves_u(piece, made) ? 0 : 1;
  const uint32_t left = (axis == 0 ? piece.level_u - made.u : piece.level_v - made.v) - 1;
  const bool is_low = (((axis == 0 ? leaf.u : leaf.v) >> left) & 1u) == 0;
  RegionOfQuad half;
  if (is_low)
    half.high[axis] = in_overlaps(overlap);
  else
    half.low[axis] = -in_overlaps(overlap);
  return half;
}

// Each point of a grid on the leaf is compared with one of the quad. Between four of them x and y
// are bilinear. There the leaf differs from what is bilinear by at most 1 / 8 of the step's square
// times its second derivatives, and the product of x and y by 1 / 4 of that of their strides.
// Rounding: at most 64 units of the sizes, and as much where a query measures.
float radius_for(const LeafPoints& leaf, const Quad& around, const RegionOfQuad& own,
                 const RegionOfQuad& within) {
  constexpr float kUp = 1.0f + 0x1p-16f;
  constexpr uint32_t kSide = LeafPoints::kSide;
  const float width = own.high[0] - own.low[0] + own.high[1] - own.low[1];
  const uint32_t each = width < 0.9f ? 3 : width < 2.5f ? 2 : 1;
  const float step = at_grid(each) + 1.0f;
  const auto on_own = [&](uint32_t axis, uint32_t k) {
    return own.low[axis] + (own.high[axis] - own.low[axis]) * 0.5f * (at_grid(k) + 1.0f);
  };
  const Nearest nearest(around, {on_own(0, kSide / 2), on_own(1, kSide / 2)}, within);
  OnQuad row[kSide];
  Strides along, across;
  float max_m2 = 0.0f;
  for (uint32_t j = 0; j < kSide; j += each) {
    const float y = on_own(1, j);
    const Vec3 first_m = around.centre + around.b * y, a = around.a + around.twist * y;
    for (uint32_t i = 0; i < kSide; i += each) {
      const float x = on_own(0, i);
      const Vec3 off_m = leaf.at_m[j][i] - first_m - a * x;
      const OnQuad at = nearest.to(off_m, {x, y});
      const Vec3 left_m = off_m - a * (at.x - x) - (around.b + around.twist * at.x) * (at.y - y);
      max_m2 = math::larger(max_m2, dot(left_m, left_m));
      if (i > 0) along.add(at, row[i - each]);
      if (j > 0) across.add(at, row[i]);
      row[i] = at;
    }
  }
  const float turned_m =
      0.25f * math::length(around.twist) * (along.x * along.y + across.x * across.y);
  const float off_m = math::square_root(max_m2) + leaf.bent_m * (step * step / 8.0f) + turned_m;
  return (off_m + leaf.noise_m) * kUp + 128.0f * kUnit * (leaf.reach_m + size_of(around));
}

}  // namespace firmtouch::spline
