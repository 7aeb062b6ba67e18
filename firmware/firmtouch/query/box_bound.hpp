#pragma once
// Lower bounds of the distance to boxes on a 15-bit grid. For the library's own translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/box_grid.hpp"

namespace firmtouch::query {

// A bound is an unsigned key that orders as the squared distance, so that one traversal serves both
// kinds: cells squared for a query inside the grid, the bits of a float in square metres outside.
constexpr uint32_t kFarthest = UINT32_MAX;

/// Factor that covers a relative loss of `units` times 2^-24. Each module derives its own.
constexpr float rounding_down(uint32_t units) {
  return 1.0f - static_cast<float>(units) * 0x1p-24f;
}

/// The query is inside the grid: integers, nine instructions a box with the DSP extension.
///
/// (p - low) / cell has an error of at most 2^-24 * 32768 = 2^-9 cells, one rounding of the
/// difference; the division is exact, the cell being a power of two. Boxes enclose their contents
/// except for the same rounding in the proof at opening. The query is widened by both, 2^-8 cells,
/// and then to whole cells. So the integer distance is never more than the true one.
template <uint32_t kUnits>
struct NearBoxBound {
  static constexpr float kRoundDown = rounding_down(kUnits);
  math::BoxPoint point;
  float cell_m;
  float prune_per_m2;  // square cells in a square metre, and the loss of a bound; exact

  /// Result: false where the query is not inside the grid, or NaN.
  bool begin(const float* grid_low_m, float cell, const math::Vec3& p_m) {
    cell_m = cell;
    const float per_part = 0x1p16f / cell;
    prune_per_m2 = per_part * 0x1p-16f * (per_part * 0x1p-16f) * (2.0f - kRoundDown);
    return math::grid_point(p_m.x, p_m.y, p_m.z, grid_low_m, per_part, point);
  }
  /// Pre: a word may be read behind the box.
  uint32_t key(const uint32_t* box) const { return math::box_distance2(box, point); }
  /// Smallest key whose boxes cannot be nearer than the square root of distance2_m2.
  uint32_t prune_key(float distance2_m2) const {
    const float cells2 = distance2_m2 * prune_per_m2;
    return cells2 < 4.2e9f ? static_cast<uint32_t>(cells2) + 1 : kFarthest;
  }
  float distance_m(uint32_t key) const {
    return math::square_root(static_cast<float>(key)) * cell_m * kRoundDown;
  }
};

/// The query is outside the grid, an eighth of the extent or more from every box: floats.
/// Each module derives what such a bound loses.
template <uint32_t kUnits>
struct FarBoxBound {
  static constexpr float kRoundDown = rounding_down(kUnits);
  math::Vec3 x_m;
  float cell_m;

  void begin(const float* grid_low_m, float cell, math::Vec3 p_m) {
    cell_m = cell;
    x_m = p_m - math::Vec3{grid_low_m[0], grid_low_m[1], grid_low_m[2]};
  }
  float outside_m(uint32_t axis, float x) const {
    const float below_m = static_cast<float>(low_of(axis)) * cell_m - x;
    const float above_m = x - static_cast<float>(high_of(axis)) * cell_m;
    const float outside = below_m > above_m ? below_m : above_m;
    return math::larger(outside, 0.0f);
  }
  /// Out of line: far away a search is rare and short.
  [[gnu::noinline, gnu::cold]] uint32_t key(const uint32_t* box) const {
    const math::Vec3 d{outside_m(box[0], x_m.x), outside_m(box[1], x_m.y),
                       outside_m(box[2], x_m.z)};
    return math::bits_of(dot(d, d) * kRoundDown);
  }
  uint32_t prune_key(float distance2_m2) const {
    return math::bits_of(distance2_m2 * (2.0f - kRoundDown));
  }
  float distance_m(uint32_t key) const {
    return math::square_root(math::float_of(key)) * kRoundDown;
  }
};

}  // namespace firmtouch::query
