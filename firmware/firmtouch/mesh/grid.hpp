#pragma once
// Lower bounds of the distance to the boxes of a mesh. For the library's own translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/box_bound.hpp"

namespace firmtouch::mesh {

using query::kFarthest;
constexpr uint32_t kBoundUnits = 128;  // of 2^-24: more than any bound below loses (derived there)
constexpr float kRoundDown = query::rounding_down(kBoundUnits);

/// The query is inside the grid.
struct NearBound : query::NearBoxBound<kBoundUnits> {
  /// Result: false where the query is not inside the grid, or NaN.
  bool begin(const Head& head, const math::Vec3& p_m) {
    static_assert(kGridMax == 0x7FFF && offsetof(Head, cell_m) == offsetof(Head, grid_low_m) + 12);
    return NearBoxBound::begin(head.grid_low_m, head.cell_m, p_m);
  }
  /// Of both sides of a node, and where their children are. Into words: a struct of them cost the
  /// Cortex-M7 2 % of a query.
  void keys(const Side* sides, uint32_t& key0, uint32_t& key1, uint32_t& child0,
            uint32_t& child1) const {
    math::side_distances2(sides[0].box, point, key0, key1, child0, child1);
  }
  /// For keys of oriented boxes, which open() has proven against the same roundings.
  math::HalfCellPoint half_cells() const { return math::half_cell_point(point); }
  static constexpr uint32_t kVisitParts = 1;
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
struct FarBound : query::FarBoxBound<kBoundUnits> {
  void begin(const Head& head, math::Vec3 p_m) {
    FarBoxBound::begin(head.grid_low_m, head.cell_m, p_m);
  }
  void keys(const Side* sides, uint32_t& key0, uint32_t& key1, uint32_t& child0,
            uint32_t& child1) const {
    key0 = key(sides[0].box);
    key1 = key(sides[1].box);
    child0 = sides[0].child;
    child1 = sides[1].child;
  }
  static constexpr uint32_t kVisitParts = 2;  // of a work unit that a visit takes
  static constexpr bool kCompensated = true;
  constexpr bool is_outside() const { return true; }
  /// p - offset has lost the low bits of a far p: put back on its triangle.
  math::Vec3 foot_m(const View& mesh, math::Vec3 p_m, math::Vec3 offset_m,
                    uint32_t triangle) const {
    const Triangle<uint32_t> t = mesh.triangle(triangle);
    const math::Vec3 near_m = p_m - offset_m;
    Foot foot;
    find_foot_apart(near_m,
                    {mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]), mesh.vertex(t.corner[2])},
                    Nearer::than_nothing(), foot);
    return near_m - foot.offset_m;
  }
};

}  // namespace firmtouch::mesh
