#pragma once
// Where the parts of a surface's piece lie, for .cpp files of this room only.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/patch.hpp"

namespace firmtouch::spline {

static inline float in_units(float unit, uint32_t byte) {
  return math::float_of(math::bits_of(unit) + (byte << 20));
}

/// Of a part, from a piece's corners; in units of a quarter of the grid's step: all are whole.
static inline Parallelogram quarters_of(const Corner* corners, uint32_t columns, uint32_t across,
                                        uint32_t along, uint32_t u, uint32_t v) {
  const Corner* const c00 = corners + v * along * columns + u * across;
  const Corner *const c10 = c00 + across, *const c01 = c00 + along * columns,
                      *const c11 = c01 + across;
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
  const Parallelogram quarters =
      quarters_of(corners + grid.first_corner, (1u << piece.level_u) + 1u,
                  1u << (piece.level_u - made.u), 1u << (piece.level_v - made.v), p.u, p.v);
  const float quarter = 0.25f * grid.step_m;
  return {quarters.centre * quarter, quarters.a * quarter, quarters.b * quarter};
}

/// A lower bound of the distance to a parallelogram from q (from where it is told from, in its units), and
/// where on it, x and y, the foot is thought to be. Any x and y would do: of a convex function the tangent
/// there tells what it may still fall by (twice `left`). Where that is most of it, nothing is told.
struct Foot {
  float x, y, distance;
};
static inline float held(float value) {
  return value > -1.0f ? value < 1.0f ? value : 1.0f : -1.0f;
}
static inline Foot foot_on(const Parallelogram& p, math::Vec3 q) {
  const math::Vec3 r = q - p.centre;
  const float aa = dot(p.a, p.a), ab = dot(p.a, p.b), bb = dot(p.b, p.b);
  const float of_a = dot(p.a, r), of_b = dot(p.b, r);
  const float per_aa = aa > 0.0f ? 1.0f / aa : 0.0f, per_bb = bb > 0.0f ? 1.0f / bb : 0.0f;
  float x = held(of_a * per_aa);
  const float y = held((of_b - ab * x) * per_bb);
  x = held((of_a - ab * y) * per_aa);
  const math::Vec3 off = r - p.a * x - p.b * y;
  const float slope_x = dot(p.a, off), slope_y = dot(p.b, off);
  const float left = (slope_x < 0.0f ? -slope_x : slope_x) - slope_x * x +
                     ((slope_y < 0.0f ? -slope_y : slope_y) - slope_y * y);
  const float off2 = dot(off, off), least2 = off2 - 2.0f * left;
  const float distance = least2 > 0.5f * off2 ? math::square_root(least2) : 0.0f;
  return {x, y, distance * (1.0f - 0x1p-20f)};
}

}  // namespace firmtouch::spline
