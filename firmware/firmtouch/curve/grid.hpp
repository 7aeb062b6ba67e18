#pragma once
// Lower bounds of the distance to boxes on the curve's 15-bit grid, for .cpp files of this module
// only. The twin of mesh/grid.hpp: neither module may know the other.

#include "firmtouch/curve/derived.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::curve {

// Both kinds of bound are told as an unsigned key that orders as the squared distance, so that one
// walk serves both: cells squared for a query inside the grid, the bits of a float in square metres
// for one outside.
constexpr float kRoundDown =
    1.0f - 0x1p-16f;  // 256 units of 2^-24: more than any bound below loses (derived there)
constexpr uint32_t kFarthest = UINT32_MAX;

/// The query is inside the grid: integers, nine instructions a box with the DSP extension.
///
/// (p - low) / cell has an error of at most 2^-24 * 32768 = 2^-9 cells, one rounding of the
/// difference; the division is exact, the cell being a power of two. Boxes enclose their samples
/// but for the same rounding in open()'s check. The query is widened by both, 2^-8 cells, and then
/// to whole cells. So the integer distance is never more than the true one.
struct NearBound {
  uint32_t point[3];
  float cell_m;
  float per_cell2;

  /// False: the query is not inside the grid (or not a number).
  bool begin(const Head& head, math::Vec3 p_m) {
    cell_m = head.cell_m;
    const float per_cell = 1.0f / cell_m;
    per_cell2 = per_cell * per_cell;
    return put((p_m.x - head.grid_low_m[0]) * per_cell, point[0]) &&
           put((p_m.y - head.grid_low_m[1]) * per_cell, point[1]) &&
           put((p_m.z - head.grid_low_m[2]) * per_cell, point[2]);
  }
  // The bits of floats that are not negative order as they do; all others, NaN too, lie beyond.
  static bool put(float cells, uint32_t& word) {
    constexpr uint32_t kOne = 0x3F800000u, kMax = 0x46FFFA00u;  // 1 and 32765
    if (math::bits_of(cells) - kOne > kMax - kOne) return false;
    const uint32_t floor_cell = static_cast<uint32_t>(static_cast<int32_t>(cells - 0x1p-8f));
    const uint32_t ceil_cell =
        static_cast<uint32_t>(static_cast<int32_t>(cells + (1.0f + 0x1p-8f)));
    word = ceil_cell | ((kGridMax - floor_cell) << 16);
    return true;
  }
  /// Outside the box of all by a 32nd of the diagonal distances may exceed the diagonal, and the
  /// promise of 4e-7 of the distance asks for more care than within.
  bool needs_care(const View& curve) const {
    const float margin_m = curve.head().diagonal_m * 0x1p-5f;
    return key(curve.boxes()[0]) >= prune_key(margin_m * margin_m);
  }
  uint32_t key(const Box& box) const { return math::box_distance2(box.side, point); }
  /// Smallest key whose boxes cannot be nearer than the square root of distance2_m2.
  uint32_t prune_key(float distance2_m2) const {
    const float cells2 = distance2_m2 * per_cell2 * (2.0f - kRoundDown);
    return cells2 < 4.2e9f ? static_cast<uint32_t>(cells2) + 1 : kFarthest;
  }
  float distance_m(uint32_t key) const {
    return math::square_root(static_cast<float>(key)) * cell_m * kRoundDown;
  }
};

/// The query is outside the grid, an eighth of the extent or more from every box: floats.
///
/// Each axis has an error of at most u (|x| + d) with u = 2^-24, x = p - grid_low and |x| <= d + 2
/// extents <= 17.2 d (open() lets the grid begin at most an extent below the box), so 18.2 u d an
/// axis, 32 u d for the three, 64 u in the square and 4 for its sum. The boxes' slack of 2^-10 cells
/// an axis is, with a grid of at most four extents, 2^-10 * 4 / 32768 * 8.1 d = 17 u d, 29 u d for
/// the three, 58 u in the square: 126 of the 256 units that kRoundDown takes.
struct FarBound {
  math::Vec3 x_m;
  float cell_m;

  void begin(const Head& head, math::Vec3 p_m) {
    cell_m = head.cell_m;
    x_m = p_m - math::Vec3{head.grid_low_m[0], head.grid_low_m[1], head.grid_low_m[2]};
  }
  float outside_m(uint32_t side, float x) const {
    const float low_m = static_cast<float>(low_of(side)) * cell_m;
    const float high_m = static_cast<float>(high_of(side)) * cell_m;
    const float below_m = low_m - x, above_m = x - high_m;
    const float outside = below_m > above_m ? below_m : above_m;
    return outside > 0.0f ? outside : 0.0f;
  }
  uint32_t key(const Box& box) const {
    const math::Vec3 d{outside_m(box.side[0], x_m.x), outside_m(box.side[1], x_m.y),
                       outside_m(box.side[2], x_m.z)};
    return math::bits_of(dot(d, d) * kRoundDown);
  }
  uint32_t prune_key(float distance2_m2) const {
    return math::bits_of(distance2_m2 * (2.0f - kRoundDown));
  }
  float distance_m(uint32_t key) const {
    return math::square_root(math::float_of(key)) * kRoundDown;
  }
};

}  // namespace firmtouch::curve
