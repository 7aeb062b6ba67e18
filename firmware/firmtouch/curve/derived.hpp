#pragma once
// What the baker derives from the samples and open() derives again, to the bit. For .cpp files of
// the library and the baker only: both are compiled with the library's own floating-point flags.

#include "firmtouch/curve/cubic.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::curve {

using query::high_of;
using query::low_of;

static inline math::Vec3 vec(const Sample& s) { return {s.x_m, s.y_m, s.z_m}; }

/// Half of a segment, rounded up by more than length() loses (5 operations).
static inline float half_segment_m(const Sample& a, const Sample& b) {
  return math::length(vec(b) - vec(a)) * (0.5f + 0x1p-20f);
}

/// Diagonal of the head's box, rounded down.
static inline float diagonal_m(const Head& head) {
  const math::Vec3 sides{head.high_m[0] - head.low_m[0], head.high_m[1] - head.low_m[1],
                         head.high_m[2] - head.low_m[2]};
  return math::length(sides) * (1.0f - 0x1p-21f);
}

/// True where sample a comes before sample b on `axis`: the total order of the k-d tree.
static inline bool comes_before(const Sample* samples, uint32_t axis, uint32_t a, uint32_t b) {
  const float at_a = (&samples[a].x_m)[axis], at_b = (&samples[b].x_m)[axis];
  if (at_a < at_b) return true;
  if (at_b < at_a) return false;
  return a < b;
}

/// The upper half of a float that is not negative, rounded up.
static inline uint16_t rounded_radius(float radius_m) {
  return static_cast<uint16_t>((math::bits_of(radius_m) + 0xFFFFu) >> 16);
}
static inline float radius_m_of(uint16_t stored) {
  return math::float_of(static_cast<uint32_t>(stored) << 16);
}

/// The stored radius of a part `along` whose farthest point has this squared distance from the
/// straight line between its ends. What line_distance2() loses is at most 20 u of the line's length
/// and 6 u of the distance, here and again in the search (u = 2^-24; derived as in answer.hpp,
/// which computes from the nearer end); the latter's share of the distance is in the search's own
/// radius.
static inline uint16_t radius_of(float max2_m2, math::Vec3 along) {
  const float lost_m = math::length(along) * 0x1p-18f;
  return rounded_radius(math::square_root(max2_m2) * (1.0f + 0x1p-20f) + lost_m + 0x1p-58f);
}

/// How far the samples from `first` to `last` lie from the straight line between these two; of a
/// smooth curve also the Bezier points of the pieces between them. A piece lies within its points'
/// hull, and distance to a line is convex.
static inline uint16_t part_radius(const Track& track, bool is_smooth, uint32_t first,
                                   uint32_t last) {
  if (last <= first) return 0;
  const math::Vec3 a = vec(track.samples[first]), along = vec(track.samples[last]) - a;
  float max2_m2 = 0;
  for (uint32_t i = first; i < last; ++i) {
    const math::Vec3 from = vec(track.samples[i]) - a;
    const Cubic c = is_smooth ? cubic_of(track, i) : Cubic{};
    const float at_m2[] = {line_distance2(from, along), line_distance2(from + c.c1, along),
                           line_distance2(from + c.c2, along)};
    for (uint32_t k = 0; k < (is_smooth ? 3u : 1u); ++k)
      if (at_m2[k] > max2_m2) max2_m2 = at_m2[k];
  }
  return radius_of(max2_m2, along);
}

/// Part `k` of run `run`: from sample `first` to sample `last`; the same sample twice where the run
/// ends before.
struct Part {
  uint32_t first, last;
};
static inline Part part_of(uint32_t levels, uint32_t run, uint32_t k, uint32_t segment_count) {
  uint32_t level = 0;
  while (k + 1 >= (2u << level)) ++level;
  const uint32_t whole = run_segments_of(levels), size = whole >> level;
  const uint32_t begin = run * whole + (k + 1 - (1u << level)) * size;
  const uint32_t end = begin + size;
  return {begin < segment_count ? begin : segment_count, end < segment_count ? end : segment_count};
}

/// The bounds of grid.hpp stand on these: a cell that is a power of two, a grid that is not much
/// larger than the box and leaves an eighth of the extent free about it (one rounding less).
/// Result: 0 where all hold, else 1 for the cell, 2 for the size, 3 to 5 for an axis.
static inline uint32_t wrong_of_grid(const Head& head) {
  const uint32_t cell = math::bits_of(head.cell_m), exponent = cell >> 23;
  if ((cell & 0x7FFFFFu) != 0 || exponent < 127 - 60 || exponent > 127 + 60) return 1;
  float extent_m = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const float side_m = head.high_m[k] - head.low_m[k];
    if (side_m > extent_m) extent_m = side_m;
  }
  const float grid_m = static_cast<float>(kGridMax) * head.cell_m, free_m = 0.124f * extent_m;
  if (!(grid_m <= 4.0f * extent_m)) return 2;
  for (uint32_t k = 0; k < 3; ++k) {
    const float below_m = head.low_m[k] - head.grid_low_m[k];
    const float above_m = grid_m - (head.high_m[k] - head.grid_low_m[k]);
    if (!(below_m >= free_m && below_m <= extent_m && above_m >= free_m)) return 3 + k;
  }
  return 0;
}

/// The bounds need as much room about the boxes of a smooth curve, which may lie beyond its
/// samples. Result: 0 where there is, else 1 to 3 for an axis.
static inline uint32_t wrong_of_root(const Head& head, const Box& root) {
  float extent_m = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const float side_m = head.high_m[k] - head.low_m[k];
    if (side_m > extent_m) extent_m = side_m;
  }
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t below = root.side[k] & 0xFFFFu, above = root.side[k] >> 16;
    const float min_m = static_cast<float>(below < above ? below : above) * head.cell_m;
    if (!(min_m >= 0.12f * extent_m)) return 1 + k;
  }
  return 0;
}

/// A coordinate in cells of the grid: one rounding of the difference, the rest exact.
static inline float cells_of(const Head& head, float at_m, uint32_t axis) {
  return (at_m - head.grid_low_m[axis]) * (1.0f / head.cell_m);
}

/// The cells that a run's box must hold about a Bezier point: two roundings, and to be sure.
constexpr float kPointSlack_cells = 0x1p-7f;
static inline float cells_of(const Head& head, float at_m, float off_m, uint32_t axis) {
  return ((at_m - head.grid_low_m[axis]) + off_m) * (1.0f / head.cell_m);
}

}  // namespace firmtouch::curve
