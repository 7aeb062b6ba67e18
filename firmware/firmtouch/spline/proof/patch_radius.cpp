#include "firmtouch/spline/proof/patch_radius.hpp"

#include <float.h>

#include "firmtouch/spline/numbers.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

float between(float value, float low, float high) {
  return value > low ? value < high ? value : high : low;
}
float sized(float value) { return __builtin_fabsf(value); }
float size_of(const Quad& quad) {
  return math::length(quad.centre) + math::length(quad.a) + math::length(quad.b) +
         math::length(quad.twist);
}

struct OnQuad {
  float x, y;
};
Vec3 tangent_x(const Quad& quad, float y) { return quad.a + quad.twist * y; }
Vec3 tangent_y(const Quad& quad, float x) { return quad.b + quad.twist * x; }
// By what of two tangents, together, a vector is met best. Result: false where they are next to
// parallel.
bool solve(Vec3 a, Vec3 b, Vec3 v, OnQuad& by) {
  const float aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), of = aa * bb - ab * ab;
  if (!(of > 0x1p-12f * (aa * bb))) return false;
  const float of_a = dot(a, v), of_b = dot(b, v);
  by = {(bb * of_a - ab * of_b) / of, (aa * of_b - ab * of_a) / of};
  return true;
}

// About the nearest to a point of a part of a quad, from where that is thought to be: by Newton's
// method, and where that leads beyond an edge along it.
OnQuad nearest_on(const Quad& quad, const RegionOfQuad& region, Vec3 p_m, OnQuad at) {
  constexpr uint32_t kTurns = 2;
  const Vec3 r = p_m - quad.centre;
  const auto off = [&](OnQuad to) { return r - quad.a * to.x - tangent_y(quad, to.x) * to.y; };
  OnQuad by;
  for (uint32_t turn = 0; turn < kTurns; ++turn) {
    if (!solve(tangent_x(quad, at.y), tangent_y(quad, at.x), off(at), by)) break;
    at = {between(at.x + by.x, -2.0f, 2.0f), between(at.y + by.y, -2.0f, 2.0f)};
  }
  const auto held_x = [&](float x) { return between(x, region.low[0], region.high[0]); };
  const auto held_y = [&](float y) { return between(y, region.low[1], region.high[1]); };
  const OnQuad held{held_x(at.x), held_y(at.y)};
  if (!(sized(held.x - at.x) > 0.0f || sized(held.y - at.y) > 0.0f)) return held;
  // Where that is beyond: along either edge.
  const auto y_beside = [&](float x) {
    const Vec3 b = tangent_y(quad, x);
    return held_y(dot(b, r - quad.a * x) / (dot(b, b) + FLT_MIN));
  };
  const auto x_beside = [&](float y) {
    const Vec3 a = tangent_x(quad, y);
    return held_x(dot(a, r - quad.b * y) / (dot(a, a) + FLT_MIN));
  };
  OnQuad along_y{held.x, y_beside(held.x)}, along_x{x_beside(held.y), held.y};
  along_y.x = x_beside(along_y.y);
  along_x.y = y_beside(along_x.x);
  const Vec3 off_y = off(along_y), off_x = off(along_x);
  return dot(off_x, off_x) < dot(off_y, off_y) ? along_x : along_y;
}

Vec3 corner_of(const LeafShape& shape, float x, float y) {
  Vec3 sum{};
  float weight = 0.0f, at_y = 1.0f;
  for (uint32_t j = 0; j <= shape.degree_v; ++j, at_y *= y) {
    float at = at_y;
    for (uint32_t i = 0; i <= shape.degree_u; ++i, at *= x) {
      const uint32_t k = j * (shape.degree_u + 1) + i;
      sum = sum + shape.c[k] * at;
      weight += shape.w[k] * at;
    }
  }
  return shape.local_m + sum * (1.0f / weight);
}

// Where on a quad the points of a leaf are thought to be, x and y by powers of the leaf's own s and
// t, [of t][of s]: never outside a part of the quad. No power is above the second in all.
struct Spread {
  float x[3][3] = {}, y[3][3] = {};
};
constexpr uint32_t kSpreadPowers[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {2, 0}};
// In proportion between where its corners are.
void spread_between(const float (&corner)[4], float (&of)[3][3]) {
  const float low = corner[0] + corner[1], high = corner[2] + corner[3];
  const float low_turn = corner[1] - corner[0], high_turn = corner[3] - corner[2];
  of[0][0] = 0.25f * (low + high);
  of[0][1] = 0.25f * (low_turn + high_turn);
  of[1][0] = 0.25f * (high - low);
  of[1][1] = 0.25f * (high_turn - low_turn);
}
// And by_s (1 - s^2) + by_t (1 - t^2) added, as much as leaves all between low and high: half of
// the change along s at most, with which all along s is still between its ends, or half of what
// slack there is.
void bend_spread(float (&of)[3][3], float by_s, float by_t, float low, float high) {
  const float sides = sized(of[0][1]) + sized(of[1][0]) + sized(of[1][1]);
  const float below = 0.5f * (of[0][0] - sides - low), above = 0.5f * (high - of[0][0] - sides);
  const auto held = [&](float by, float along) {
    const float unturned = math::larger(0.5f * (sized(along) - sized(of[1][1])), 0.0f);
    return between(by, -math::larger(unturned, below), math::larger(unturned, above));
  };
  by_s = held(by_s, of[0][1]);
  by_t = held(by_t, of[1][0]);
  of[0][2] = -by_s;
  of[2][0] = -by_t;
  of[0][0] += by_s + by_t;
}
// By its corners, and bent so that what is left of the leaf leads away from the quad.
void spread_on(const LeafShape& shape, const LeafCorners& corners, const Quad& quad,
               const RegionOfQuad& own, const RegionOfQuad& within, Spread& spread) {
  float x[4], y[4];
  for (uint32_t k = 0; k < 4; ++k) {
    const OnQuad thought{(k & 1u) != 0 ? own.high[0] : own.low[0],
                         (k & 2u) != 0 ? own.high[1] : own.low[1]};
    const OnQuad at = nearest_on(quad, within, corners.at_m[k], thought);
    x[k] = at.x, y[k] = at.y;
  }
  spread_between(x, spread.x);
  spread_between(y, spread.y);
  const Vec3 a = tangent_x(quad, spread.y[0][0]), b = tangent_y(quad, spread.x[0][0]);
  const uint32_t s2 = 2, t2 = 2 * (shape.degree_u + 1);
  const Vec3 bent_s =
      (shape.degree_u >= 2 ? shape.c[s2] : Vec3{}) - quad.twist * (spread.x[0][1] * spread.y[0][1]);
  const Vec3 bent_t =
      (shape.degree_v >= 2 ? shape.c[t2] : Vec3{}) - quad.twist * (spread.x[1][0] * spread.y[1][0]);
  OnQuad by_s, by_t;
  if (!solve(a, b, bent_s, by_s) || !solve(a, b, bent_t, by_t)) return;
  bend_spread(spread.x, -by_s.x, -by_t.x, within.low[0], within.high[0]);
  bend_spread(spread.y, -by_s.y, -by_t.y, within.low[1], within.high[1]);
}

// (point - where its spread says) * weight, as a polynomial of up to four degrees more on each
// axis.
struct Residual {
  static constexpr uint32_t kSide = kMaxDegree + 5;
  uint32_t rows, columns;     // powers there are
  Vec3 e[kSide][kSide] = {};  // [power of t][power of s]
};
void residual_of(const LeafShape& shape, const Quad& quad, const Spread& on, Residual& r) {
  constexpr uint32_t kPowers = 5;
  const auto powers = [&](uint32_t degree) {
    return shape.is_rational ? degree + kPowers : degree < kPowers ? kPowers : degree + 1;
  };
  r.columns = powers(shape.degree_u);
  r.rows = powers(shape.degree_v);
  for (uint32_t j = 0; j <= shape.degree_v; ++j)
    for (uint32_t i = 0; i <= shape.degree_u; ++i)
      r.e[j][i] = shape.c[j * (shape.degree_u + 1) + i];
  float product[kPowers][kPowers] = {};  // of x and y
  for (const uint32_t(&i)[2] : kSpreadPowers)
    for (const uint32_t(&k)[2] : kSpreadPowers)
      product[i[0] + k[0]][i[1] + k[1]] += on.x[i[0]][i[1]] * on.y[k[0]][k[1]];
  for (uint32_t row = 0; row < kPowers; ++row)
    for (uint32_t column = 0; column < kPowers - row; ++column) {
      Vec3 at = quad.twist * product[row][column];
      if (row < 3 && column < 3) at = at + quad.a * on.x[row][column] + quad.b * on.y[row][column];
      if (row + column == 0) at = at + (quad.centre - shape.local_m);
      r.e[row][column] = r.e[row][column] - at;
      if (!shape.is_rational) continue;
      const float* weight = shape.w;
      for (uint32_t j = 0; j <= shape.degree_v; ++j) {
        Vec3* const e = r.e[row + j] + column;
        for (uint32_t i = 0; i <= shape.degree_u; ++i, ++weight)
          if (i + j > 0) e[i] = e[i] - at * *weight;
      }
    }
}

// How long that is at most. Between the points of a grid it is off what is linear between them by 1
// / 8 of the step's square times its second derivatives, and what is linear is longest in a corner.
// steps: on a side of the grid. Of a small part of a quad those derivatives are next to nothing.
float most_of(const Residual& r, uint32_t steps) {
  const float step = 2.0f / static_cast<float>(steps);
  float max_m2 = 0.0f, bent_m = 0.0f;
  for (uint32_t k = 0; k <= steps; ++k) {
    const float t = static_cast<float>(k) * step - 1.0f;
    Vec3 along[Residual::kSide];
    for (uint32_t i = 0; i < r.columns; ++i) {
      along[i] = r.e[r.rows - 1][i];
      for (uint32_t j = r.rows - 1; j-- > 0;) along[i] = along[i] * t + r.e[j][i];
    }
    for (uint32_t n = 0; n <= steps; ++n) {
      const float s = static_cast<float>(n) * step - 1.0f;
      Vec3 at = along[r.columns - 1];
      for (uint32_t i = r.columns - 1; i-- > 0;) at = at * s + along[i];
      max_m2 = math::larger(max_m2, dot(at, at));
    }
  }
  const auto twice = [](uint32_t power) { return power < 2 ? 0u : power * (power - 1); };
  for (uint32_t j = 0; j < r.rows; ++j)
    for (uint32_t i = 0; i < r.columns; ++i)
      if (i > 1 || j > 1)
        bent_m += static_cast<float>(twice(i) + twice(j)) * math::length(r.e[j][i]);
  return math::square_root(max_m2) + bent_m * (step * step / 8.0f);
}

}  // namespace

Quad stored_quad(const Piece& piece, const Grid& grid, const Corner* corners, const Patch& patch) {
  return quad_of(piece, grid, corners, patch, halvings_of(piece, patch.depth));
}

LeafCorners::LeafCorners(const LeafShape& shape) {
  for (uint32_t k = 0; k < 4; ++k)
    at_m[k] = corner_of(shape, (k & 1u) != 0 ? 1.0f : -1.0f, (k & 2u) != 0 ? 1.0f : -1.0f);
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

// Rounded by at most 64 units of the sizes where residuals are added up, and as much where a query
// measures.
float radius_for(const LeafShape& shape, const LeafCorners& corners, const Quad& around,
                 const RegionOfQuad& own, const RegionOfQuad& within) {
  constexpr float kUp = 1.0f + 0x1p-16f;
  const bool is_small = own.high[0] - own.low[0] + own.high[1] - own.low[1] < 2.5f;
  Spread on;
  spread_on(shape, corners, around, own, within, on);
  Residual r;
  residual_of(shape, around, on, r);
  const float off_m = most_of(r, is_small ? 3 : 6) / shape.min_weight * kUp + shape.noise_m;
  const float rounding_m = 64.0f * kUnit * (shape.reach_m + 2.0f * size_of(around));
  return off_m * kUp + rounding_m;
}

}  // namespace firmtouch::spline
