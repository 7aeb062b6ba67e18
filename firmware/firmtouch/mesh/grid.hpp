#pragma once
// Lower bounds of the distance to boxes on the mesh's 15-bit grid. For the library's own
// translation units.

#include "firmtouch/math/isa_oriented.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {

// Both kinds of bound are told as an unsigned key that orders as the squared distance, so that one
// traversal serves both: cells squared for a query inside the grid, the bits of a float in square
// metres for one outside.
constexpr float kRoundDown =
    1.0f - 0x1p-17f;  // 128 units of 2^-24: more than any bound below loses (derived there)
constexpr uint32_t kFarthest = UINT32_MAX;

/// The query is inside the grid: integers, nine instructions a box with the DSP extension.
///
/// (p - low) / cell has an error of at most 2^-24 * 32768 = 2^-9 cells, one rounding of the
/// difference; the division is exact, the cell being a power of two. Boxes enclose their triangles
/// but for the same rounding in open()'s check. The query is widened by both, 2^-8 cells, and then
/// to whole cells. So the integer distance is never more than the true one.
struct NearBound {
  math::BoxPoint point;
  float cell_m;
  float prune_per_m2;  // square cells in a square metre and what a bound may lose; exact

  /// False: the query is not inside the grid (or not a number).
  bool begin(const Head& head, const math::Vec3& p_m) {
    cell_m = head.cell_m;
    const float per_part = 0x1p16f / cell_m;
    prune_per_m2 = per_part * 0x1p-16f * (per_part * 0x1p-16f) * (2.0f - kRoundDown);
    static_assert(kGridMax == 0x7FFF && offsetof(Head, cell_m) == offsetof(Head, grid_low_m) + 12);
    return math::grid_point(p_m.x, p_m.y, p_m.z, head.grid_low_m, per_part, point);
  }
  uint32_t key(const uint32_t* box) const { return math::box_distance2(box, point); }
  /// Of both sides of a node, and where their children are. Into words: a struct of them cost the
  /// Cortex-M7 2 % of a query.
  void keys(const Side* sides, uint32_t& key0, uint32_t& key1, uint32_t& child0,
            uint32_t& child1) const {
    math::side_distances2(sides[0].box, point, key0, key1, child0, child1);
  }
  /// Smallest key whose boxes cannot be nearer than the square root of distance2_m2.
  uint32_t prune_key(float distance2_m2) const {
    const float cells2 = distance2_m2 * prune_per_m2;
    return cells2 < 4.2e9f ? static_cast<uint32_t>(cells2) + 1 : kFarthest;
  }
  float distance_m(uint32_t key) const {
    return math::square_root(static_cast<float>(key)) * cell_m * kRoundDown;
  }
  /// For keys of oriented boxes, which open() has proven against the same roundings.
  math::HalfCellPoint half_cells() const { return math::half_cell_point(point); }
  static constexpr bool kCompensated = false;  // near: plain float32 is enough, or is tried first
  /// Whether the query is certainly outside, whatever is nearest.
  constexpr bool is_outside() const { return false; }
  math::Vec3 foot_m(const View&, math::Vec3 p_m, math::Vec3 offset_m, uint32_t) const {
    return p_m - offset_m;
  }
};

/// The query is outside the grid, an eighth of the extent or more from every box: floats.
///
/// Each axis has an error of at most 2^-24 (|x| + d) with x = p - grid_low and |x| <= d + 1.3
/// extents <= 11.4 d, so 13 d units an axis, 23 d units in all, 46 in the square and 4 more for its
/// sum. The boxes' slack, 2^-10 cells an axis (half a unit in the last place below 2^15), less than
/// 6.3e-7 d, is 37 more in the square of the three: 87 of the 128 units that kRoundDown takes.
struct FarBound {
  math::Vec3 x_m;
  float cell_m;

  void begin(const Head& head, math::Vec3 p_m) {
    cell_m = head.cell_m;
    x_m = p_m - math::Vec3{head.grid_low_m[0], head.grid_low_m[1], head.grid_low_m[2]};
  }
  float outside_m(uint32_t box, float x) const {
    const float low_m = static_cast<float>(box & 0xFFFFu) * cell_m;
    const float high_m = static_cast<float>(kGridMax - (box >> 16)) * cell_m;
    const float below_m = low_m - x, above_m = x - high_m;
    const float outside = below_m > above_m ? below_m : above_m;
    return outside > 0.0f ? outside : 0.0f;
  }
  uint32_t key(const uint32_t* box) const {
    const math::Vec3 d{outside_m(box[0], x_m.x), outside_m(box[1], x_m.y),
                       outside_m(box[2], x_m.z)};
    return math::bits_of(math::dot(d, d) * kRoundDown);
  }
  void keys(const Side* sides, uint32_t& key0, uint32_t& key1, uint32_t& child0,
            uint32_t& child1) const {
    key0 = key(sides[0].box);
    key1 = key(sides[1].box);
    child0 = sides[0].child;
    child1 = sides[1].child;
  }
  uint32_t prune_key(float distance2_m2) const {
    return math::bits_of(distance2_m2 * (2.0f - kRoundDown));
  }
  float distance_m(uint32_t key) const {
    return math::square_root(math::float_of(key)) * kRoundDown;
  }
  static constexpr bool kCompensated = true;
  constexpr bool is_outside() const { return true; }
  /// p - offset has lost the low bits of a far p: put back on its triangle.
  math::Vec3 foot_m(const View& mesh, math::Vec3 p_m, math::Vec3 offset_m,
                    uint32_t triangle) const {
    const Triangle<uint32_t> t = mesh.triangle(triangle);
    const math::Vec3 near_m = p_m - offset_m;
    const Foot foot = closest_on_triangle(near_m, mesh.vertex(t.corner[0]),
                                          mesh.vertex(t.corner[1]), mesh.vertex(t.corner[2]));
    return near_m - foot.offset_m;
  }
};

}  // namespace firmtouch::mesh
