#pragma once
// The triangles of one leaf, measured against a query. For the library's own translation units.

#include <float.h>
#include <stddef.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/compensated_distance.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {

/// The nearest so far.
struct Best {
  float distance2_m2 = FLT_MAX;
  math::Vec3 offset_m;
  uint32_t triangle = 0;
  uint32_t slot = query::kNowhere;  // of its leaf: node << 1 | slot
  Feature feature = Feature::kVertex0;
};

// A search counts in thirds of a work unit: a visit takes one (outside of the grid two), a triangle
// two, one that is taken as the nearest or as a rival another, in double-float 24. To begin takes
// 10 units.
constexpr uint32_t kPartsOfUnit = 3;
constexpr uint32_t kBeginUnits = 10;
constexpr uint32_t kTriangleParts = 2;
constexpr uint32_t kCompensatedParts = 24;

/// Triangles that lost to the nearest by so little that the loss of float32 may have decided. Kept
/// only of a mesh whose loss float32 cannot promise away (View::has_rivals()).
///
/// A triangle that is not kept is farther than the nearest, as computed: its box is, or the line or
/// plane that skipped it, or its own computed distance, less the loss. Which are kept depends on
/// nothing but the leaves that are read and their order.
struct Rivals {
  static constexpr uint32_t kMax = 8;
  uint32_t count;
  uint32_t foot[kMax + 1];       // feature << 24 | triangle; one more than is kept
  float distance2_m2[kMax + 1];  // as computed
  float rest_m;                  // none of those that were let go is nearer
  uint32_t owed;                 // thirds of work units taken, not yet charged
  float slack_m2;
  const View* mesh;

  // With l = 28 u L the loss of a near triangle and d the distance of the nearest so far: (d + l +
  // 6 u d)^2 <= d^2 (1 + 2^-12) + l^2 (2^12 + 2), and l^2 2^12 < 2^-26.3 L^2.
  static float slack_of(float longest_edge_m) { return longest_edge_m * longest_edge_m * 0x1p-26f; }
  float limit2_m2(float min2_m2) const { return min2_m2 * (1.0f + 0x1p-12f) + slack_m2; }
  void clear() {
    count = 0;
    rest_m = FLT_MAX;
  }
  // Pre: count <= kMax. The caller then calls let_go().
  void add(uint32_t triangle, Feature feature, float distance2) {
    foot[count] = static_cast<uint32_t>(feature) << 24 | triangle;
    distance2_m2[count++] = distance2;
  }
  void let_go() {
    if (count > kMax) let_last_go();
  }
  // Of the ninth only a bound is kept, by its own longest edge.
  [[gnu::noinline, gnu::cold]] void let_last_go() {
    count = kMax;
    const Triangle<uint32_t> last = mesh->triangle(triangle(kMax));
    const math::Vec3 ab_m = mesh->vertex(last.corner[1]) - mesh->vertex(last.corner[0]);
    const float ab2_m2 = math::dot(ab_m, ab_m);
    const float distance_m = math::square_root(distance2_m2[kMax]);
    const float loss_m =
        Loss::own_m(distance_m, ab2_m2, math::square_root(ab2_m2), feature(kMax) == Feature::kFace);
    rest_m = math::smaller(rest_m, distance_m - (loss_m + mesh->head().rounding_m));
    owed += kTriangleParts;
  }
  uint32_t triangle(uint32_t i) const { return foot[i] & 0xFFFFFFu; }
  Feature feature(uint32_t i) const { return static_cast<Feature>(foot[i] >> 24); }
};

// Pre: `stride` is that of vertices.
template <int kBlock>
[[gnu::always_inline]] static inline void load_corner(const Vertex* vertices, uint32_t index,
                                                      uint32_t stride, math::Vec3& corner_m) {
  const void* const at = reinterpret_cast<const uint8_t*>(vertices) + index * stride;
  math::load_floats<kBlock>(static_cast<const float*>(at), corner_m.x, corner_m.y, corner_m.z);
}

/// Input and result of measuring leaves. Its first five floats are consecutive.
struct Sought {
  math::Vec3 p_m;
  float slack_m2;          // of the mesh, for Nearer
  Best best;               // in: no farther than this; out: the nearest
  const Vertex* vertices;  // the mesh's; here, where a leaf finds them by one pointer
  const void* triangles;   // with indices of its width
  bool is_narrow;          // the indices have 16 bits; for LeafTriangles alone
  Rivals rivals;
};

// The triangles of a leaf by their corners.
template <class Index>
struct LeafCorners {
  using Shape = OfCorners;
  const Vertex* vertices;
  const Index* corner;
  uint32_t stride;

  LeafCorners(const Sought& sought, uint32_t first)
      : vertices(sought.vertices),
        corner((static_cast<const Triangle<Index>*>(sought.triangles) + first)->corner),
        stride(math::as_multiplier(sizeof(Vertex))) {}
  [[gnu::always_inline]] void next(OfCorners& shape) {
    load_corner<0>(vertices, math::next_of(corner), stride, shape.a_m);
    load_corner<1>(vertices, math::next_of(corner), stride, shape.b_m);
    load_corner<2>(vertices, math::next_of(corner), stride, shape.c_m);
  }
};

// The same with indices of either width.
struct LeafTriangles {
  using Shape = OfCorners;
  const Sought* sought;
  size_t at;  // of the next corner

  LeafTriangles(const Sought& from, uint32_t first) : sought(&from), at(size_t{first} * 3) {}
  [[gnu::always_inline]] void next(OfCorners& shape) {
    uint32_t index[3];
    for (uint32_t& k : index)
      k = sought->is_narrow ? static_cast<const uint16_t*>(sought->triangles)[at++]
                            : static_cast<const uint32_t*>(sought->triangles)[at++];
    const uint32_t stride = math::as_multiplier(sizeof(Vertex));
    load_corner<0>(sought->vertices, index[0], stride, shape.a_m);
    load_corner<1>(sought->vertices, index[1], stride, shape.b_m);
    load_corner<2>(sought->vertices, index[2], stride, shape.c_m);
  }
};

// Of two feet at a corner: whether both triangles have it.
static inline bool is_same(const math::Vec3& a, const math::Vec3& b) {
  return math::bits_of(a.x) == math::bits_of(b.x) && math::bits_of(a.y) == math::bits_of(b.y) &&
         math::bits_of(a.z) == math::bits_of(b.z);
}

/// Takes a foot below rivals.limit2_m2() as the nearest, or as a rival. `ab_m`: the longest edge.
/// Result: whether it is the nearest. The caller then calls rivals.let_go().
[[gnu::always_inline]] static inline bool put_foot(const Foot& foot, math::Vec3 ab_m,
                                                   uint32_t triangle, uint32_t slot, Best& best,
                                                   Rivals& rivals) {
  ++rivals.owed;
  if (!(foot.distance2_m2 < best.distance2_m2)) {
    // The nearest feature of both is no rival.
    const bool is_shared = is_vertex(foot.feature) && is_vertex(best.feature) &&
                           is_same(foot.offset_m, best.offset_m) &&
                           is_feature_clear(foot.distance2_m2, ab_m);
    if (!is_shared) rivals.add(triangle, foot.feature, foot.distance2_m2);
    return false;
  }
  // Rivals of the last nearest are farther than it.
  if (!(best.distance2_m2 < rivals.limit2_m2(foot.distance2_m2)))
    rivals.clear();
  else
    rivals.add(best.triangle, best.feature, best.distance2_m2);
  best.distance2_m2 = foot.distance2_m2;
  best.offset_m = foot.offset_m;
  best.triangle = triangle;
  best.slot = slot;
  best.feature = foot.feature;
  return true;
}
// The same for size. On a host a Vec3 that a call takes would wait for its stores.
[[gnu::noinline]] inline bool take_foot(const Foot& foot, math::Vec3 ab_m, uint32_t triangle,
                                        uint32_t slot, Best& best, Rivals& rivals) {
  return put_foot(foot, ab_m, triangle, slot, best, rivals);
}

/// Puts into sought.best the first nearest triangle of the leaf `child`, in slot `slot`, if it is
/// nearer.
/// Wanted: Nearer or Everything, with the same result; Everything is faster without a bound.
template <class Source, class Wanted>
[[gnu::always_inline]] static inline void measure_triangles(uint32_t child, uint32_t slot,
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
  Source triangles(sought, leaf_first(child));
  for (uint32_t left = math::only_here(leaf_count(child)); left != 0; --left) {
    typename Source::Shape shape;
    triangles.next(shape);
    Foot foot;
    if (!find_foot(p_m, shape, wanted, foot)) continue;
    if (!(foot.distance2_m2 < min2_m2)) continue;
    min2_m2 = foot.distance2_m2;
    wanted = Wanted::than(min2_m2, slack_m2);
    Best& best = sought.best;
    best.distance2_m2 = min2_m2;  // one by one: an aggregate is built on the stack first
    best.offset_m = foot.offset_m;
    const uint32_t word = math::only_here(child);
    best.triangle = leaf_first(word) + leaf_count(word) - left;
    best.slot = slot;
    best.feature = foot.feature;
  }
}

/// The same, and keeps the rivals. kApart: by find_foot_apart().
template <class Source, bool kApart>
[[gnu::always_inline]] static inline void measure_rivals(uint32_t child, uint32_t slot,
                                                         Sought& sought) {
  float in[5];
  math::load_kept(&sought.p_m.x, in);
  const math::Vec3 p_m{in[0], in[1], in[2]};
  const float slack_m2 = in[3];
  Best& best = sought.best;
  Rivals& rivals = sought.rivals;
  float limit2_m2 = rivals.limit2_m2(in[4]);
  Nearer wanted = Nearer::than(limit2_m2, slack_m2);
  const uint32_t first = leaf_first(child), end = first + leaf_count(child);
  Source triangles(sought, first);
  for (uint32_t i = first; i != end; ++i) {
    typename Source::Shape shape;
    triangles.next(shape);
    Foot foot;
    if constexpr (kApart) {
      if (!find_foot_apart(p_m, shape, wanted, foot)) continue;
    } else {
      if (!find_foot(p_m, shape, wanted, foot)) continue;
    }
    if (!(foot.distance2_m2 < limit2_m2)) continue;
    const Foot taken = foot;  // most are not taken, and stay in registers
    const bool is_nearer = take_foot(taken, shape.ab(), i, slot, best, rivals);
    rivals.let_go();
    if (is_nearer) {
      limit2_m2 = rivals.limit2_m2(best.distance2_m2);
      wanted = Nearer::than(limit2_m2, slack_m2);
    }
  }
}

}  // namespace firmtouch::mesh
