#pragma once
// Where the parts of a surface's piece lie, for .cpp files of this module only.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/surface/patch.hpp"

namespace firmtouch::spline {

static inline float in_units(float unit, uint32_t byte) {
  return math::float_of(math::bits_of(unit) + (byte << 20));
}

/// Of a part, from its first corner and by how many the next along u and along v follow; in units
/// of a quarter of the grid's step: all are whole.
static inline Quad quarters_between(const Corner* c00, uint32_t across, uint32_t along) {
  const Corner *const c10 = c00 + across, *const c01 = c00 + along, *const c11 = c01 + across;
  Quad made_of;
  const auto axis = [](int32_t v00, int32_t v10, int32_t v01, int32_t v11, float& centre, float& a,
                       float& b, float& twist) {
    const int32_t low = v00 + v01, high = v10 + v11, across_u = high - low;
    centre = static_cast<float>(low + high);
    a = static_cast<float>(across_u);
    b = static_cast<float>(across_u - 2 * (v10 - v01));
    twist = static_cast<float>(v00 - v10 - (v01 - v11));
  };
  axis(c00->x, c10->x, c01->x, c11->x, made_of.centre.x, made_of.a.x, made_of.b.x, made_of.twist.x);
  axis(c00->y, c10->y, c01->y, c11->y, made_of.centre.y, made_of.a.y, made_of.b.y, made_of.twist.y);
  axis(c00->z, c10->z, c01->z, c11->z, made_of.centre.z, made_of.a.z, made_of.b.z, made_of.twist.z);
  return made_of;
}

static inline Quad quad_of(const Piece& piece, const Grid& grid, const Corner* corners,
                           const Patch& p, const Halvings& made) {
  const uint32_t columns = (1u << piece.level_u) + 1u;
  const uint32_t across = 1u << (piece.level_u - made.u);
  const uint32_t along = columns << (piece.level_v - made.v);
  const Quad quarters =
      quarters_between(corners + grid.first_corner + p.v * along + p.u * across, across, along);
  const float quarter = 0.25f * grid.step_m;
  return {quarters.centre * quarter, quarters.a * quarter, quarters.b * quarter,
          quarters.twist * quarter};
}

/// Next to the square of any side, in whole units; of a side of 0 all products are 0.
constexpr float kNothing = 0x1p-60f;

/// A quad's parallelogram, it without its twist, as seen from a point; both in one unit.
struct Seen {
  math::Vec3 r;  // from its centre to the point
  float aa, ab, bb, of_a, of_b, per_aa, per_bb;
};
static inline void see(const Quad& p, math::Vec3 q, Seen& seen) {
  seen.r = q - p.centre;
  seen.aa = dot(p.a, p.a), seen.ab = dot(p.a, p.b), seen.bb = dot(p.b, p.b);
  seen.of_a = dot(p.a, seen.r), seen.of_b = dot(p.b, seen.r);
  seen.per_aa = 1.0f / (seen.aa + kNothing);
  seen.per_bb = 1.0f / (seen.bb + kNothing);
}

static inline float held(float value) { return math::smaller(math::larger(value, -1.0f), 1.0f); }
/// Of what along a vector of square off2, times its length, is at least off2 - left away: the root
/// of off2 - 2 left. Its square is at most (off2 - left)^2 / off2, which is that distance's along
/// the vector. What rounding does to it is less than 2^-20 of off2, and to the root than 2^-22 of
/// itself.
static inline float least_of(float off2, float left) {
  return math::square_root(math::larger(off2 * (1.0f - 0x1p-20f) - (left + left), 0.0f));
}

/// A lower bound of the distance to a quad, except for the rounding of its root, and where on it, x
/// and y, the foot is thought to be: that of its parallelogram. Along any vector, here the one from
/// there to the query, no point of the quad is farther than its farthest corner.
struct Foot {
  float x, y, distance;
  math::Vec3 off;
};
static inline void foot_on(const Quad& p, const Seen& seen, Foot& foot) {
  float x = held(seen.of_a * seen.per_aa);
  const float y = held((seen.of_b - seen.ab * x) * seen.per_bb);
  x = held((seen.of_a - seen.ab * y) * seen.per_aa);
  foot.x = x, foot.y = y;
  foot.off = seen.r - p.a * x - p.b * y;
  const float of_a = dot(p.a, foot.off), of_b = dot(p.b, foot.off);
  const float of_twist = dot(p.twist, foot.off);
  const float most = math::larger(__builtin_fabsf(of_a + of_b) + of_twist,
                                  __builtin_fabsf(of_a - of_b) - of_twist);
  foot.distance = least_of(dot(foot.off, foot.off), most - of_a * x - of_b * y);
}

/// A part's halves overlap by as much of its quad to each side of the middle.
static inline float in_overlaps(uint32_t byte) { return static_cast<float>(byte) * 0x1p-7f; }

/// The same of the half without the foot, whose nearest line is `excess` from it: from there on to
/// the end, of all that is along it. An axis: what it is of the quad, and where on it the foot is.
struct Axis {
  math::Vec3 way;
  float at;
};
static inline float half_bound(const Foot& foot, const Axis& across, const Axis& along,
                               math::Vec3 twist, float ab, float per_along2, float excess) {
  const uint32_t inward = (math::bits_of(across.at) & 0x80000000u) ^ 0x80000000u;  // a sign
  const float dx = math::float_of(math::bits_of(excess) | inward), x = across.at + dx;
  const float wanted = (dot(along.way, foot.off) - ab * dx) * per_along2;
  const float y = held(along.at + wanted);
  const math::Vec3 off = foot.off - across.way * dx - along.way * (y - along.at);
  const float of_across = dot(across.way, off), of_along = dot(along.way, off);
  const float of_twist = dot(twist, off), end = math::float_of(0x3F800000u | inward);
  const float here = __builtin_fabsf(of_along + of_twist * x);
  const float there = __builtin_fabsf(of_along + of_twist * end) + of_across * (end - x);
  return least_of(dot(off, off), math::larger(here, there) - of_along * y);
}

}  // namespace firmtouch::spline
