#pragma once
// The triangles of a leaf or a block against a query, eight at once. Compiled once per level.

#include "firmtouch/mesh/leaf.hpp"
#include "simd/search/block_triangles.hpp"
#include "simd/search/prism_bound.hpp"
#include "simd/search/triangle_lanes.hpp"
#include "simd/triangle_shape.hpp"

namespace firmtouch::simd {

using mesh::Best;

/// Puts into `best` the first nearest of the lanes `of`. Lane 0 is triangle `first`. Pre: one lane
/// or more.
[[gnu::always_inline]] static inline void put_nearest(const Feet& feet, uint32_t of, uint32_t first,
                                                      uint32_t slot, Best& best) {
  float min2_m2;
  const uint32_t lane = minimum_lane(feet.distance2_m2, of, min2_m2);
  best.distance2_m2 = min2_m2;
  best.offset_m = {lane_of(feet.offset_m.x, lane), lane_of(feet.offset_m.y, lane),
                   lane_of(feet.offset_m.z, lane)};
  best.triangle = first + lane;
  best.slot = slot;
  best.feature = static_cast<Feature>(lane_of(feet.features(), lane));
}

/// The same if one of the lanes `of` is nearer than `min2_m2`. Result: the least squared distance
/// so far.
[[gnu::always_inline]] static inline float take_nearest(const Feet& feet, uint32_t of,
                                                        uint32_t first, uint32_t slot,
                                                        float min2_m2, Best& best) {
  const uint32_t nearer = bits_of(less(feet.distance2_m2, all_of(min2_m2))) & of;
  if (nearer == 0) return min2_m2;
  put_nearest(feet, nearer, first, slot, best);
  return best.distance2_m2;
}

// The first array of each member of a shape.
constexpr size_t kAbArray = offsetof(TriangleShape, ab_m) / sizeof(float);
constexpr size_t kHArray = offsetof(TriangleShape, h_m) / sizeof(float);
constexpr size_t kPerAb2Array = offsetof(TriangleShape, per_ab2_m2) / sizeof(float);
constexpr size_t kXcArray = offsetof(TriangleShape, xc) / sizeof(float);
constexpr size_t kH2Array = offsetof(TriangleShape, h2_m2) / sizeof(float);

/// The stored shapes of a leaf or a block.
struct ShapeArrays {
  const float* arrays;
  size_t stride;

  explicit ShapeArrays(const BlockTriangles& triangles)
      : arrays(triangles.begin(triangles.tree.shapes, kShapeArrays)), stride(triangles.of.count) {}
  Frames frames() const {
    const auto lanes = [this](size_t k) { return lanes_from(arrays + k * stride); };
    return {vectors_of(arrays, 0, stride),
            vectors_of(arrays, kAbArray, stride),
            vectors_of(arrays, kHArray, stride),
            lanes(kPerAb2Array),
            lanes(kXcArray),
            lanes(kH2Array)};
  }
};

/// The shape of one triangle for mesh::find_foot(). Its corners b and c are rarely needed.
struct ShapeInLane {
  math::Vec3 a_m;
  const float* arrays;  // of a.x
  size_t stride;
  const CornerArrays& corners;
  uint32_t lane;

  ShapeInLane(const ShapeArrays& shapes, const CornerArrays& of_corners, uint32_t at)
      : a_m(vector_of(shapes.arrays + at, 0, shapes.stride)),
        arrays(shapes.arrays + at),
        stride(shapes.stride),
        corners(of_corners),
        lane(at) {}
  float value(size_t k) const { return arrays[k * stride]; }
  math::Vec3 b() const { return corners.corner(1, lane); }
  math::Vec3 c() const { return corners.corner(2, lane); }
  math::Vec3 ab() const { return vector_of(arrays, kAbArray, stride); }
  math::Vec3 ac() const { return c() - a_m; }
  math::Vec3 across() const { return vector_of(arrays, kHArray, stride); }
  float per_ab2(math::Vec3) const { return value(kPerAb2Array); }
  float xc(math::Vec3, float) const { return value(kXcArray); }
  math::Vec3 h(math::Vec3, float) const { return across(); }
  float h2(math::Vec3) const { return value(kH2Array); }
};

/// Feet on the triangles of a leaf or a block.
[[gnu::always_inline]] static inline Feet feet_on(const BlockTriangles& triangles, math::Vec3 p_m) {
  const CornerArrays at(triangles);
  return closest_on_triangles(ShapeArrays(triangles).frames(), p_m, at.corner(1), at.corner(2));
}
/// Puts into `best` the first nearest triangle of a leaf if it is nearer than `min2_m2`.
/// Result: the least squared distance so far.
[[gnu::always_inline]] static inline float measure_wide_leaf(const BlockTriangles& leaf,
                                                             math::Vec3 p_m, uint32_t slot,
                                                             float min2_m2, Best& best) {
  return take_nearest(feet_on(leaf, p_m), leaf.lanes(), leaf.first, slot, min2_m2, best);
}

/// The same, faster if usually none is nearer. `limit2_m2`: prism_limit2() of `min2_m2`.
[[gnu::always_inline]] static inline float measure_near_leaf(const BlockTriangles& leaf,
                                                             math::Vec3 p_m, uint32_t slot,
                                                             float min2_m2, float limit2_m2,
                                                             Best& best) {
  if (may_be_nearer(leaf, p_m, limit2_m2) == 0) return min2_m2;
  return take_nearest(feet_on(leaf, p_m), leaf.lanes(), leaf.first, slot, min2_m2, best);
}

/// Of a search that begins with a leaf.
struct Begun {
  bool is_taken;   // else the leaf is still to be measured
  uint32_t clear;  // first triangle of the leaf's block, if no other leaf of it has one of
                   // interest, else kNowhere
};

/// Takes the triangle whose low 16 bits are `last` as the nearest of a leaf, with no bound yet, if
/// the leaf has it and prisms exclude all others there. `limit2_of`: beyond which squared distance
/// a triangle is of no interest, if the nearest is so far away.
template <class Limit>
[[gnu::always_inline]] static inline Begun begin_at(const BlockTriangles& leaf, math::Vec3 p_m,
                                                    uint32_t slot, uint32_t last, float slack_m2,
                                                    const Limit& limit2_of, Best& best) {
  Begun begun{false, query::kNowhere};
  const uint32_t lane = (last - leaf.first) & 0xFFFFu;
  if (lane >= leaf.count) return begun;
  mesh::Foot foot;
  mesh::find_foot(p_m, ShapeInLane(ShapeArrays(leaf), CornerArrays(leaf), lane), mesh::Everything{},
                  foot);
  const BlockTriangles block(leaf.tree, leaf.of);
  const uint32_t nearer =
      may_be_nearer(block, p_m, prism_limit2(limit2_of(foot.distance2_m2), slack_m2));
  const uint32_t first = leaf.first - block.first, own = leaf.lanes() << first;
  if ((nearer & ~own) == 0) begun.clear = block.first;
  if ((nearer & own & ~(1u << (first + lane))) != 0 || !(foot.distance2_m2 < FLT_MAX)) return begun;
  begun.is_taken = true;
  best.distance2_m2 = foot.distance2_m2;
  best.offset_m = foot.offset_m;
  best.triangle = leaf.first + lane;
  best.slot = slot;
  best.feature = foot.feature;
  return begun;
}

/// mesh::measure_rivals() of the lanes `of`, one leaf. Lane 0 is triangle `first`.
/// Result: whether one is the nearest.
static inline bool take_rivals(const Feet& feet, const CornerArrays& corners, uint32_t of,
                               uint32_t first, uint32_t slot, Best& best, mesh::Rivals& rivals) {
  bool is_nearer = false;
  const Mask8 features = feet.features();
  for (uint32_t left = of; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(left));
    const float distance2_m2 = lane_of(feet.distance2_m2, lane);
    if (!(distance2_m2 < rivals.limit2_m2(best.distance2_m2))) continue;
    const mesh::Foot foot{{lane_of(feet.offset_m.x, lane), lane_of(feet.offset_m.y, lane),
                           lane_of(feet.offset_m.z, lane)},
                          distance2_m2,
                          static_cast<Feature>(lane_of(features, lane))};
    is_nearer |= mesh::put_foot(foot, corners.corner(1, lane) - corners.corner(0, lane),
                                first + lane, slot, best, rivals);
    rivals.let_go();
  }
  return is_nearer;
}

}  // namespace firmtouch::simd
