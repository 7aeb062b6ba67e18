#pragma once
// Where the parts of a surface's piece lie, for .cpp files of this room only.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/patch.hpp"

namespace firmtouch::spline {

static inline float in_units(float unit, uint32_t byte) {
  return math::float_of(math::bits_of(unit) + (byte << 20));
}

/// Of a part, from its first corner and by how many the next along u and along v follow; in units of a quarter of the grid's step: all are whole.
static inline Parallelogram quarters_between(const Corner* c00, uint32_t across, uint32_t along) {
  const Corner *const c10 = c00 + across, *const c01 = c00 + along, *const c11 = c01 + across;
  Parallelogram made_of;
  const auto axis = [](int32_t v00, int32_t v10, int32_t v01, int32_t v11, float& centre, float& a,
                       float& b) {
    const int32_t low = v00 + v01, high = v10 + v11, across_u = high - low;
    centre = static_cast<float>(low + high);
    a = static_cast<float>(across_u);
    b = static_cast<float>(across_u - 2 * (v10 - v01));
  };
  axis(c00->x, c10->x, c01->x, c11->x, made_of.centre.x, made_of.a.x, made_of.b.x);
  axis(c00->y, c10->y, c01->y, c11->y, made_of.centre.y, made_of.a.y, made_of.b.y);
  axis(c00->z, c10->z, c01->z, c11->z, made_of.centre.z, made_of.a.z, made_of.b.z);
  return made_of;
}

static inline Parallelogram parallelogram_of(const Piece& piece, const Grid& grid,
                                             const Corner* corners, const Patch& p,
                                             const Halvings& made) {
  const uint32_t columns = (1u << piece.level_u) + 1u;
  const uint32_t across = 1u << (piece.level_u - made.u);
  const uint32_t along = columns << (piece.level_v - made.v);
  const Parallelogram quarters =
      quarters_between(corners + grid.first_corner + p.v * along + p.u * across, across, along);
  const float quarter = 0.25f * grid.step_m;
  return {quarters.centre * quarter, quarters.a * quarter, quarters.b * quarter};
}

/// Next to the square of any side, in whole units; of a side of 0 all products are 0.
constexpr float kNothing = 0x1p-60f;

/// A parallelogram as seen from a point; both in one unit.
struct Seen {
  math::Vec3 r;  // from its centre to the point
  float aa, ab, bb, of_a, of_b, per_aa, per_bb;
};
static inline void see(const Parallelogram& p, math::Vec3 q, Seen& seen) {
  seen.r = q - p.centre;
  seen.aa = dot(p.a, p.a), seen.ab = dot(p.a, p.b), seen.bb = dot(p.b, p.b);
  seen.of_a = dot(p.a, seen.r), seen.of_b = dot(p.b, seen.r);
  seen.per_aa = 1.0f / (seen.aa + kNothing);
  seen.per_bb = 1.0f / (seen.bb + kNothing);
}

static inline float held(float value) { return math::smaller(math::larger(value, -1.0f), 1.0f); }
/// Of a convex function's square that is off2 at a point the root of what it is at least, where it may
/// fall by twice `left` from there. What rounding does to it is less than 2^-20 of off2, and to the root
/// than 2^-22 of itself.
static inline float least_of(float off2, float left) {
  return math::square_root(math::larger(off2 * (1.0f - 0x1p-20f) - (left + left), 0.0f));
}

/// A lower bound of the distance to a parallelogram, but for the rounding of its root, and where on it, x
/// and y, the foot is thought to be. Any x and y would do: the tangent there tells what the square may
/// still fall by.
struct Foot {
  float x, y, distance;
  float off2, slope_x, slope_y;
};
static inline void foot_on(const Parallelogram& p, const Seen& seen, Foot& foot) {
  float x = held(seen.of_a * seen.per_aa);
  const float y = held((seen.of_b - seen.ab * x) * seen.per_bb);
  x = held((seen.of_a - seen.ab * y) * seen.per_aa);
  const math::Vec3 off = seen.r - p.a * x - p.b * y;
  foot.x = x, foot.y = y;
  foot.off2 = dot(off, off);
  foot.slope_x = dot(p.a, off), foot.slope_y = dot(p.b, off);
  const float left = __builtin_fabsf(foot.slope_x) - foot.slope_x * x +
                     (__builtin_fabsf(foot.slope_y) - foot.slope_y * y);
  foot.distance = least_of(foot.off2, left);
}

/// A part's halves overlap by as much of its parallelogram to each side of the middle.
static inline float in_overlaps(uint32_t byte) { return static_cast<float>(byte) * 0x1p-7f; }

/// The same of the half without the foot, whose nearest line is `excess` from it: along one axis, `across`, up to
/// `overlap` beyond the middle, or from as much before it on. What is known at the foot is moved there: that loses less
/// than 2^-19 of the squares of both sides.
struct Side {
  float at, slope, square, per_square;  // of the foot, along an axis
};
static inline float half_bound(float off2, const Side& across, const Side& along, float ab,
                               float excess, float overlap) {
  const uint32_t inward = (math::bits_of(across.at) & 0x80000000u) ^ 0x80000000u;  // a sign
  const float dx = math::float_of(math::bits_of(excess) | inward);
  const float turned = along.slope - ab * dx;
  const float y = held(along.at + turned * along.per_square), dy = y - along.at;
  const float slope_x = across.slope - across.square * dx - ab * dy;
  const float slope_y = turned - along.square * dy;
  const float moved2 = off2 - dx * (across.slope + slope_x) - dy * (along.slope + slope_y);
  const float rising = math::larger(math::float_of(math::bits_of(slope_x) ^ inward), 0.0f);
  const float left = rising * (1.0f + overlap) + (__builtin_fabsf(slope_y) - slope_y * y);
  return least_of(moved2 - (across.square + along.square) * 0x1p-19f, left);
}

}  // namespace firmtouch::spline
