#pragma once
// The triangles of one leaf, measured against a query. For the library's own translation units.

#include <float.h>
#include <stddef.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/math/isa_loads.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/compensated_distance.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/lined.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/prism.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/mesh/triangle_lanes.hpp"

namespace firmtouch::mesh {

/// The nearest so far.
struct Best {
  float distance2_m2 = FLT_MAX;
  math::Vec3 offset_m;
  uint32_t triangle = 0;
  uint32_t slot = query::kNowhere;  // of its leaf: node << 1 | slot
  Feature feature = Feature::kVertex0;
};

/// Puts into `best` the nearest of the lanes `of`, of two equally near ones the first. Lane 0 is triangle
/// `first`. Pre: one lane or more.
template <class Float>
[[gnu::always_inline]] static inline void put_least(const Feet<Float>& feet, uint32_t of,
                                                    uint32_t first, uint32_t slot, Best& best) {
  float min2_m2;
  const uint32_t lane = math::min_lane(feet.distance2_m2, of, min2_m2);
  best.distance2_m2 = min2_m2;
  best.offset_m = {feet.offset_m.x[lane], feet.offset_m.y[lane], feet.offset_m.z[lane]};
  best.triangle = first + lane;
  best.slot = slot;
  best.feature = static_cast<Feature>(feet.features()[lane]);
}

/// The same where one of the lanes `asked` is nearer than `min2_m2`.
/// Result: the least squared distance so far.
template <class Float>
[[gnu::always_inline]] static inline float take_nearest(const Feet<Float>& feet, uint32_t asked,
                                                        uint32_t first, uint32_t slot,
                                                        float min2_m2, Best& best) {
  const uint32_t nearer =
      math::lanes_of(math::less(feet.distance2_m2, lanes::all_of<Float>(min2_m2))) & asked;
  if (nearer == 0) return min2_m2;
  put_least(feet, nearer, first, slot, best);
  return best.distance2_m2;
}

/// measure_leaf() without care, side by side as many triangles as a Float holds.
/// Pre: the leaf holds no more, the mesh no fewer.
template <class Float, class Index>
[[gnu::always_inline]] static inline float measure_side_by_side(
    const Vertex* vertices, core::Span<const Triangle<Index>> triangles, math::Vec3 p_m,
    uint32_t child, uint32_t slot, float min2_m2, Best& best) {
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  // Neighbours of the leaf fill what lanes are left, and are not asked.
  uint32_t first = leaf_first(child), asked = (1u << leaf_count(child)) - 1u;
  const uint32_t last = triangles.size() - kLanes;
  if (first > last) {
    asked <<= first - last;
    first = last;
  }
  const Triangle<Index>* const t = triangles.data() + first;
  const auto corner = [&](uint32_t k) {
    const auto at = [&](uint32_t lane) { return &vertices[t[lane].corner[k]].x_m; };
    if constexpr (kLanes == 8)
      return math::gather(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
    else
      return math::gather(at(0), at(1), at(2), at(3));
  };
  const Feet<Float> feet = closest_on_triangles<Float>(p_m, corner(0), corner(1), corner(2));
  return take_nearest(feet, asked, first, slot, min2_m2, best);
}

// Where the members of a shape have their first row.
constexpr size_t kAbRow = offsetof(TriangleShape, ab_m) / sizeof(float);
constexpr size_t kHRow = offsetof(TriangleShape, h_m) / sizeof(float);
constexpr size_t kPerAb2Row = offsetof(TriangleShape, per_ab2_m2) / sizeof(float);
constexpr size_t kXcRow = offsetof(TriangleShape, xc) / sizeof(float);
constexpr size_t kH2Row = offsetof(TriangleShape, h2_m2) / sizeof(float);

/// The shapes of a leaf of them, which have rows of their own.
template <class Float>
struct LinedShapes {
  const float* row;
  size_t stride;

  explicit LinedShapes(const Lined& lined)
      : row(lined.ahead.shapes + size_t{kRowsOfShapes} * lined.first), stride(lined.count) {}
  Frames<Float> frames() const {
    const auto lanes = [this](size_t k) { return math::lanes_from<Float>(row + k * stride); };
    return {lanes_of_rows<Float>(row, 0, stride),
            lanes_of_rows<Float>(row, kAbRow, stride),
            lanes_of_rows<Float>(row, kHRow, stride),
            lanes(kPerAb2Row),
            lanes(kXcRow),
            lanes(kH2Row)};
  }
};

/// One triangle of them; its corners b and c are rarely needed.
template <class Float>
struct OfLane {
  math::Vec3 a_m;
  const float* row;  // of a.x
  size_t stride;
  const LinedCorners<Float>& corners;
  uint32_t lane;

  OfLane(const LinedShapes<Float>& shapes, const LinedCorners<Float>& of_corners, uint32_t at)
      : a_m(one_of_rows(shapes.row + at, 0, shapes.stride)),
        row(shapes.row + at),
        stride(shapes.stride),
        corners(of_corners),
        lane(at) {}
  float value(size_t k) const { return row[k * stride]; }
  math::Vec3 b() const { return corners.corner(1, lane); }
  math::Vec3 c() const { return corners.corner(2, lane); }
  math::Vec3 ab() const { return one_of_rows(row, kAbRow, stride); }
  math::Vec3 ac() const { return c() - a_m; }
  math::Vec3 across() const { return one_of_rows(row, kHRow, stride); }
  float per_ab2(math::Vec3) const { return value(kPerAb2Row); }
  float xc(math::Vec3, float) const { return value(kXcRow); }
  math::Vec3 h(math::Vec3, float) const { return across(); }
  float h2(math::Vec3) const { return value(kH2Row); }
};

/// measure_side_by_side() of such a leaf, or of a block.
template <class Float>
[[gnu::always_inline]] static inline Feet<Float> feet_on(const Lined& lined, math::Vec3 p_m) {
  const LinedCorners<Float> at(lined);
  return closest_on_triangles<Float>(p_m, at.corner(0), at.corner(1), at.corner(2));
}
template <class Float>
[[gnu::always_inline]] static inline float measure_lined(const Lined& leaf, math::Vec3 p_m,
                                                         uint32_t slot, float min2_m2, Best& best) {
  return take_nearest(feet_on<Float>(leaf, p_m), leaf.asked(), leaf.first, slot, min2_m2, best);
}

template <class Float>
[[gnu::always_inline]] static inline Feet<Float> feet_by_shapes(const Lined& leaf, math::Vec3 p_m) {
  const Frames<Float> f = LinedShapes<Float>(leaf).frames();
  const LinedCorners<Float> at(leaf);
  return closest_in_frames(f, plane_feet(f, p_m), p_m, at.corner(1), at.corner(2));
}

/// The same in less time where mostly none is nearer. `limit2_m2`: prism_limit2() of `min2_m2`.
template <class Float>
[[gnu::always_inline]] static inline float measure_lined_beside(const Lined& leaf, math::Vec3 p_m,
                                                                uint32_t slot, float min2_m2,
                                                                float limit2_m2, Best& best) {
  if (may_be_nearer<Float>(leaf, p_m, limit2_m2) == 0) return min2_m2;
  return take_nearest(feet_by_shapes<Float>(leaf, p_m), leaf.asked(), leaf.first, slot, min2_m2,
                      best);
}

/// The same from nothing known, in less time where the nearest is that of the triangle whose lowest 16
/// bits are `last`; which they are decides nothing else.
/// Result: where the leaf's block begins if none of its other leaves has a nearer one; else kNowhere.
template <class Float>
[[gnu::always_inline]] static inline uint32_t measure_lined_last(const Lined& leaf, math::Vec3 p_m,
                                                                 uint32_t slot, uint32_t last,
                                                                 float slack_m2, Best& best) {
  uint32_t clear = query::kNowhere;
  const uint32_t lane = (last - leaf.first) & 0xFFFFu;
  if (lane < leaf.count) {
    Foot foot;
    find_foot(p_m, OfLane<Float>(LinedShapes<Float>(leaf), LinedCorners<Float>(leaf), lane),
              Everything{}, foot);
    const Lined block(leaf.ahead, leaf.of);
    const uint32_t nearer =
        may_be_nearer<Float>(block, p_m, prism_limit2(foot.distance2_m2, slack_m2));
    const uint32_t first = leaf.first - block.first, own = leaf.asked() << first;
    if ((nearer & ~own) == 0) clear = block.first;
    if ((nearer & own & ~(1u << (first + lane))) == 0 && foot.distance2_m2 < FLT_MAX) {
      best.distance2_m2 = foot.distance2_m2;
      best.offset_m = foot.offset_m;
      best.triangle = leaf.first + lane;
      best.slot = slot;
      best.feature = foot.feature;
      return clear;
    }
  }
  take_nearest(feet_by_shapes<Float>(leaf, p_m), leaf.asked(), leaf.first, slot, FLT_MAX, best);
  return clear;
}

// Pre: `stride` is that of vertices.
template <int kBlock>
[[gnu::always_inline]] static inline void load_corner(const Vertex* vertices, uint32_t index,
                                                      uint32_t stride, math::Vec3& corner_m) {
  const uint8_t* const at = reinterpret_cast<const uint8_t*>(vertices) + index * stride;
  math::load_floats<kBlock>(reinterpret_cast<const float*>(at), corner_m.x, corner_m.y, corner_m.z);
}

/// What is looked for, and what came of it; its first five floats lie in a row.
struct Sought {
  math::Vec3 p_m;
  float slack_m2;          // of the mesh, for Nearer
  Best best;               // in: no farther than this; out: the nearest
  const Vertex* vertices;  // the mesh's; here, where a leaf finds them by one pointer
  const void* triangles;   // with indices of its width
  // For ShapesInTurn alone:
  const TriangleShape* shapes;
  bool is_narrow;  // the indices have 16 bits
};

/// A triangle whose shape is stored (mesh/layout.hpp, kShapesSection); the corners b and c are rarely
/// needed.
struct OfShape {
  math::Vec3 a_m, ab_m, h_m;
  float per_ab2_m2;
  const TriangleShape* shape;
  const Sought* sought;

  math::Vec3 corner(size_t k) const {
    const size_t at = static_cast<size_t>(shape - sought->shapes) * 3 + k;
    const Vertex& v =
        sought->vertices[sought->is_narrow ? static_cast<const uint16_t*>(sought->triangles)[at]
                                           : static_cast<const uint32_t*>(sought->triangles)[at]];
    return {v.x_m, v.y_m, v.z_m};
  }
  math::Vec3 b() const { return corner(1); }
  math::Vec3 c() const { return corner(2); }
  math::Vec3 ab() const { return ab_m; }
  math::Vec3 ac() const { return c() - a_m; }
  math::Vec3 across() const { return h_m; }
  float per_ab2(math::Vec3) const { return per_ab2_m2; }
  float xc(math::Vec3, float) const { return shape->xc; }
  math::Vec3 h(math::Vec3, float) const { return h_m; }
  float h2(math::Vec3) const { return shape->h2_m2; }
};

// The triangles of a leaf one after the other, by their corners.
template <class Index>
struct CornersInTurn {
  using Shape = OfCorners;
  const Vertex* vertices;
  const Index* corner;
  uint32_t stride;

  CornersInTurn(const Sought& sought, uint32_t first)
      : vertices(sought.vertices),
        corner((static_cast<const Triangle<Index>*>(sought.triangles) + first)->corner),
        stride(math::as_multiplier(sizeof(Vertex))) {}
  [[gnu::always_inline]] void next(OfCorners& shape) {
    load_corner<0>(vertices, math::next_of(corner), stride, shape.a_m);
    load_corner<1>(vertices, math::next_of(corner), stride, shape.b_m);
    load_corner<2>(vertices, math::next_of(corner), stride, shape.c_m);
  }
};

// The same by their shapes, whatever the width of their indices.
struct ShapesInTurn {
  using Shape = OfShape;
  const Sought* sought;
  const TriangleShape* at;

  ShapesInTurn(const Sought& from, uint32_t first) : sought(&from), at(from.shapes + first) {}
  [[gnu::always_inline]] void next(OfShape& shape) {
    math::load_floats<0>(&at->a_m.x_m, shape.a_m.x, shape.a_m.y, shape.a_m.z);
    math::load_floats<1>(&at->ab_m.x_m, shape.ab_m.x, shape.ab_m.y, shape.ab_m.z);
    math::load_floats<2>(&at->h_m.x_m, shape.h_m.x, shape.h_m.y, shape.h_m.z);
    shape.per_ab2_m2 = at->per_ab2_m2;
    shape.shape = at++;
    shape.sought = sought;
  }
};

/// Puts into sought.best what of the leaf `child`, which is at `place`, is nearer; of two equally
/// near triangles the first. InTurn: CornersInTurn or ShapesInTurn. Wanted: Nearer or Everything,
/// which tell the same; Everything in fewer instructions where nothing is known yet.
template <class InTurn, class Wanted>
[[gnu::always_inline]] static inline void measure_in_turn(uint32_t child, uint32_t slot,
                                                          Sought& sought) {
  using math::Vec3;
  static_assert(offsetof(Sought, slack_m2) == 12 && offsetof(Sought, best) == 16);
  static_assert(offsetof(Best, distance2_m2) == 0);
  float in[5];
  math::load_kept(&sought.p_m.x, in);
  const Vec3 p_m{in[0], in[1], in[2]};
  const float slack_m2 = in[3];
  float min2_m2 = in[4];
  Wanted wanted = Wanted::than(min2_m2, slack_m2);
  InTurn triangles(sought, leaf_first(child));
  for (uint32_t left = math::only_here(leaf_count(child)); left != 0; --left) {
    typename InTurn::Shape shape;
    triangles.next(shape);
    Foot foot;
    if (!find_foot(p_m, shape, wanted, foot)) continue;
    if (!(foot.distance2_m2 < min2_m2)) continue;
    min2_m2 = foot.distance2_m2;
    wanted = Wanted::than(min2_m2, slack_m2);
    Best& best = sought.best;
    best.distance2_m2 = min2_m2;  // one by one: an aggregate would be built aside first
    best.offset_m = foot.offset_m;
    const uint32_t word = math::only_here(child);
    best.triangle = leaf_first(word) + leaf_count(word) - left;
    best.slot = slot;
    best.feature = foot.feature;
  }
}

/// Puts into `best` what of the leaf `child`, which is at `place`, is nearer than `min2_m2`; of
/// two equally near triangles the first. With care, a triangle that may be the nearest is measured
/// again in pairs of floats.
/// `is_last`: the leaf is that of the last answer, whose branches the processor foresees: where it
/// is a small one, measured in turn there, a warm query costs a tenth less than side by side.
/// Result: the least squared distance so far.
template <bool kCompensated, class Index>
[[gnu::always_inline]] static inline float measure_leaf(const Vertex* vertices,
                                                        core::Span<const Triangle<Index>> triangles,
                                                        const Loss& loss, math::Vec3 p_m,
                                                        uint32_t child, uint32_t slot,
                                                        [[maybe_unused]] bool is_last,
                                                        float min2_m2, Best& best) {
  if constexpr (math::kHasLanes && !kCompensated) {
    using math::Float4;
    using math::FloatWide;
    const bool is_small = leaf_count(child) <= math::kLanesOf<Float4>;
    if (!is_small && triangles.size() >= math::kLanesOf<FloatWide>)
      return measure_side_by_side<FloatWide>(vertices, triangles, p_m, child, slot, min2_m2, best);
    if (is_small && !is_last && triangles.size() >= math::kLanesOf<Float4>)
      return measure_side_by_side<Float4>(vertices, triangles, p_m, child, slot, min2_m2, best);
  }
  using math::Vec3;
  const uint32_t stride = math::as_multiplier(sizeof(Vertex));
  const Triangle<Index>* triangle = triangles.data() + leaf_first(child);
  for (const Triangle<Index>* const end = triangle + leaf_count(child); triangle != end;
       ++triangle) {
    Vec3 a_m, b_m, c_m;
    load_corner<0>(vertices, triangle->corner[0], stride, a_m);
    load_corner<1>(vertices, triangle->corner[1], stride, b_m);
    load_corner<2>(vertices, triangle->corner[2], stride, c_m);
    Foot foot = closest_on_triangle(p_m, a_m, b_m, c_m);
    if constexpr (kCompensated) {
      if (!loss.may_be_less(foot.distance2_m2, min2_m2)) continue;
      foot.distance2_m2 = loss.is_clear(foot.distance2_m2)
                              ? compensated_distance2(p_m, a_m, b_m, c_m, foot.feature)
                              : compensated_distance2(p_m, a_m, b_m, c_m);
    }
    if (!(foot.distance2_m2 < min2_m2)) continue;
    min2_m2 = foot.distance2_m2;
    best.distance2_m2 = min2_m2;  // one by one: an aggregate would be built aside first
    best.offset_m = foot.offset_m;
    best.triangle = static_cast<uint32_t>(triangle - triangles.data());
    best.slot = slot;
    best.feature = foot.feature;
  }
  return min2_m2;
}

}  // namespace firmtouch::mesh
