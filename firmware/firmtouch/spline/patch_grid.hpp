#pragma once
// Where the parts of a surface's piece lie, for .cpp files of this room only.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/patch.hpp"

namespace firmtouch::spline {

static inline float in_units(float unit, uint32_t byte) {
  return math::float_of(math::bits_of(unit) + (byte << 20));
}

static inline Parallelogram parallelogram_of(const Piece& piece, const Grid& grid,
                                             const Corner* corners, const Patch& p,
                                             const Halvings& made) {
  const uint32_t columns = (1u << piece.level_u) + 1u;
  const uint32_t across = 1u << (piece.level_u - made.u), along = 1u << (piece.level_v - made.v);
  const Corner* const c = corners + grid.first_corner + p.v * along * columns + p.u * across;
  const Corner *const c00 = c, *const c10 = c + across, *const c01 = c + along * columns,
                      *const c11 = c01 + across;
  const float quarter = 0.25f * grid.step_m;
  Parallelogram made_of;
  const auto axis = [quarter](int32_t v00, int32_t v10, int32_t v01, int32_t v11, float& centre,
                              float& a, float& b) {
    const int32_t rising = v11 - v00, falling = v10 - v01;
    centre = static_cast<float>(v00 + v11 + v10 + v01) * quarter;
    a = static_cast<float>(rising + falling) * quarter;
    b = static_cast<float>(rising - falling) * quarter;
  };
  axis(c00->x, c10->x, c01->x, c11->x, made_of.centre.x, made_of.a.x, made_of.b.x);
  axis(c00->y, c10->y, c01->y, c11->y, made_of.centre.y, made_of.a.y, made_of.b.y);
  axis(c00->z, c10->z, c01->z, c11->z, made_of.centre.z, made_of.a.z, made_of.b.z);
  return made_of;
}

/// A lower bound of the distance to a parallelogram from q_m (from the piece's origin), and where on it,
/// x and y, the foot is thought to be. Any x and y would do: of a convex function the tangent there
/// tells what it may still fall by (twice `left`). Where that is most of it, nothing is told.
struct Foot {
  float x, y, distance_m;
};
static inline float held(float value) {
  return value > -1.0f ? value < 1.0f ? value : 1.0f : -1.0f;
}
static inline Foot foot_on(const Parallelogram& p, math::Vec3 q_m) {
  const math::Vec3 r_m = q_m - p.centre;
  const float aa = dot(p.a, p.a), ab = dot(p.a, p.b), bb = dot(p.b, p.b);
  const float of_a = dot(p.a, r_m), of_b = dot(p.b, r_m);
  const float determinant = aa * bb - ab * ab;
  float y = determinant > 0.0f ? held((aa * of_b - ab * of_a) / determinant) : 0.0f;
  const float x = aa > 0.0f ? held((of_a - ab * y) / aa) : 0.0f;
  y = bb > 0.0f ? held((of_b - ab * x) / bb) : 0.0f;
  const math::Vec3 off_m = r_m - p.a * x - p.b * y;
  const float slope_x = dot(p.a, off_m), slope_y = dot(p.b, off_m);
  const float left = (slope_x < 0.0f ? -slope_x : slope_x) - slope_x * x +
                     ((slope_y < 0.0f ? -slope_y : slope_y) - slope_y * y);
  const float off2_m2 = dot(off_m, off_m), least2_m2 = off2_m2 - 2.0f * left;
  const float distance_m = least2_m2 > 0.5f * off2_m2 ? math::square_root(least2_m2) : 0.0f;
  return {x, y, distance_m * (1.0f - 0x1p-20f)};
}

}  // namespace firmtouch::spline
