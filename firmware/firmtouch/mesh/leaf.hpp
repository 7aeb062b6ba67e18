#pragma once
// The triangles of one leaf, measured against a query. For the library's own translation units.

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/careful_distance.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::mesh {

/// The nearest so far.
struct Best {
  float distance2_m2 = FLT_MAX;
  math::Vec3 offset_m;
  uint32_t triangle = 0;
  uint32_t place = query::kNowhere;  // of its leaf: node << 1 | slot
  Feature feature = Feature::kVertex0;
};

/// Puts into `best` what of the leaf `child`, which is at `place`, is nearer than `least2_m2`; of two
/// equally near triangles the first. With care, a triangle that may be the nearest is measured again
/// in pairs of floats.
/// Result: the least squared distance so far.
template <bool kCareful, class Index>
[[gnu::always_inline]] static inline float measure_leaf(const Vertex* vertices,
                                                        const Triangle<Index>* triangle,
                                                        const Loss& loss, math::Vec3 p_m,
                                                        uint32_t child, uint32_t place,
                                                        float least2_m2, Best& best) {
  using math::Vec3;
  uint32_t i = leaf_first(child);
  for (const uint32_t end = i + leaf_count(child); i < end; ++i) {
    const Vertex &a = vertices[triangle[i].corner[0]], &b = vertices[triangle[i].corner[1]],
                 &c = vertices[triangle[i].corner[2]];
    const Vec3 a_m{a.x_m, a.y_m, a.z_m}, b_m{b.x_m, b.y_m, b.z_m}, c_m{c.x_m, c.y_m, c.z_m};
    Foot foot = closest_on_triangle(p_m, a_m, b_m, c_m);
    if constexpr (kCareful) {
      if (!loss.may_be_less(foot.distance2_m2, least2_m2)) continue;
      foot.distance2_m2 = loss.is_clear(foot.distance2_m2)
                              ? careful_distance2(p_m, a_m, b_m, c_m, foot.feature)
                              : careful_distance2(p_m, a_m, b_m, c_m);
    }
    if (!(foot.distance2_m2 < least2_m2)) continue;
    least2_m2 = foot.distance2_m2;
    best.distance2_m2 = least2_m2;  // one by one: an aggregate would be built aside first
    best.offset_m = foot.offset_m;
    best.triangle = i;
    best.place = place;
    best.feature = foot.feature;
  }
  return least2_m2;
}

}  // namespace firmtouch::mesh
