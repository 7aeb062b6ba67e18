#pragma once
// Closest point of one triangle: the inner loop of the room. For the library's own translation
// units.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::mesh {

struct Foot {
  math::Vec3 offset_m;  // from the closest point to the query
  float distance2_m2;
  Feature feature;
};

[[gnu::always_inline]] static inline Foot foot_at(math::Vec3 offset_m, Feature feature) {
  return {offset_m, math::dot(offset_m, offset_m), feature};
}

/// Closest point of the triangle a b c, whose edge a b is the longest, to p.
///
/// In the orthogonal frame of a b and the height vector h = ac - ab (ab . ac) / |ab|^2 the foot of
/// p in the plane is a + ab x + h w; its barycentric coordinates are v = x - w xc (of b) and w (of
/// c). Because a b is the longest edge, the angles at a and b are acute: a point beyond a b has its
/// closest point on a b, one beyond a c or b c on that edge, and only beyond the corner c must both
/// be asked.
///
/// Why not the book's form (Ericson 2005, 5.1.5): it takes v and w from differences of
/// fourth-degree products and loses them on slivers, by 2^-24 (length / height)^2. Here w is taken
/// from what ab x leaves of ap, e, so that h being skew to ab by a rounding, 2^-24 length, meets no
/// component along ab. With d the distance and u = 2^-24 the foot is off in the plane by at most
/// min(u d length / height, height) beside u length, which lengthens d by at most u length / 2.
[[gnu::always_inline]] static inline Foot closest_on_triangle(math::Vec3 p, math::Vec3 a,
                                                              math::Vec3 b, math::Vec3 c) {
  using math::dot;
  using math::Vec3;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const float per_ab2 = 1.0f / dot(ab, ab);
  const float x = dot(ab, ap) * per_ab2;
  const float xc = dot(ab, ac) * per_ab2;
  const Vec3 e = ap - ab * x, h = ac - ab * xc;
  const float y = dot(e, h);
  if (y <= 0.0f) {
    if (x <= 0.0f) return foot_at(ap, Feature::kVertex0);
    if (x >= 1.0f) return foot_at(p - b, Feature::kVertex1);
    return foot_at(e, Feature::kEdge0);
  }
  const float w = y / dot(h, h);
  const float v = x - w * xc;
  // On a border too, so that a query at a corner is told the corner, not a face that meets there.
  if (!(v <= 0.0f || v + w >= 1.0f)) return foot_at(e - h * w, Feature::kFace);
  if (v <= 0.0f) {
    const float t = dot(ac, ap), ac2 = dot(ac, ac);
    if (t <= 0.0f) return foot_at(ap, Feature::kVertex0);
    if (t < ac2) return foot_at(ap - ac * (t / ac2), Feature::kEdge2);
  }
  if (v + w >= 1.0f) {
    const Vec3 bc = c - b, bp = p - b;
    const float t = dot(bc, bp), bc2 = dot(bc, bc);
    if (t <= 0.0f) return foot_at(bp, Feature::kVertex1);
    if (t < bc2) return foot_at(bp - bc * (t / bc2), Feature::kEdge1);
  }
  return foot_at(p - c, Feature::kVertex2);
}

}  // namespace firmtouch::mesh
