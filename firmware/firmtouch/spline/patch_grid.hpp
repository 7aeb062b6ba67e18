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
    const int32_t rising = v11 - v00, falling = v10 - v01;
    centre = static_cast<float>(v00 + v11 + v10 + v01);
    a = static_cast<float>(rising + falling);
    b = static_cast<float>(rising - falling);
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

/// A parallelogram as seen from a point; both in one unit.
struct Seen {
  math::Vec3 r;  // from its centre to the point
  float aa, ab, bb, of_a, of_b, per_aa, per_bb;
};
static inline void see(const Parallelogram& p, math::Vec3 q, Seen& seen) {
  seen.r = q - p.centre;
  seen.aa = dot(p.a, p.a), seen.ab = dot(p.a, p.b), seen.bb = dot(p.b, p.b);
  seen.of_a = dot(p.a, seen.r), seen.of_b = dot(p.b, seen.r);
  seen.per_aa = seen.aa > 0.0f ? 1.0f / seen.aa : 0.0f;
  seen.per_bb = seen.bb > 0.0f ? 1.0f / seen.bb : 0.0f;
}

static inline float held(float value) {
  const float above = value > -1.0f ? value : -1.0f;  // without branches
  return above < 1.0f ? above : 1.0f;
}
/// Of a convex function's square that is off . off at a point the root of what it is at least, where it
/// may fall by twice `left` from there. Where that is most of it, nothing is told.
static inline float least_of(math::Vec3 off, float left) {
  const float off2 = dot(off, off), least2 = off2 - 2.0f * left;
  const float distance = least2 > 0.5f * off2 ? math::square_root(least2) : 0.0f;
  return distance * (1.0f - 0x1p-20f);
}

/// A lower bound of the distance to a parallelogram, and where on it, x and y, the foot is thought to be.
/// Any x and y would do: the tangent there tells what the square may still fall by.
struct Foot {
  float x, y, distance;
};
static inline Foot foot_on(const Parallelogram& p, const Seen& seen) {
  float x = held(seen.of_a * seen.per_aa);
  const float y = held((seen.of_b - seen.ab * x) * seen.per_bb);
  x = held((seen.of_a - seen.ab * y) * seen.per_aa);
  const math::Vec3 off = seen.r - p.a * x - p.b * y;
  const float slope_x = dot(p.a, off), slope_y = dot(p.b, off);
  const float left =
      __builtin_fabsf(slope_x) - slope_x * x + (__builtin_fabsf(slope_y) - slope_y * y);
  return {x, y, least_of(off, left)};
}
static inline Foot foot_on(const Parallelogram& p, math::Vec3 q) {
  Seen seen;
  see(p, q, seen);
  return foot_on(p, seen);
}

/// A part's halves overlap by as much of its parallelogram to each side of the middle.
static inline float in_overlaps(uint32_t byte) { return static_cast<float>(byte) * 0x1p-7f; }

/// The same of a half: along one axis, `across`, the lower one up to `overlap` beyond the middle, or the
/// upper one from as much before it on. The foot lies outside it.
static inline float half_bound(const Seen& seen, math::Vec3 across, math::Vec3 along,
                               float of_along, float per_along, float overlap, bool is_low) {
  const float x = is_low ? overlap : -overlap;  // the nearest line of it
  const float y = held((of_along - seen.ab * x) * per_along);
  const math::Vec3 off = seen.r - across * x - along * y;
  const float slope_x = dot(across, off), slope_y = dot(along, off);
  const float inward = (is_low ? -slope_x : slope_x) * (1.0f + overlap);
  return least_of(off, (inward > 0.0f ? inward : 0.0f) + (__builtin_fabsf(slope_y) - slope_y * y));
}

}  // namespace firmtouch::spline
