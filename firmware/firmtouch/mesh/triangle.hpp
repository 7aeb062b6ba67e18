#pragma once
// Closest point of one triangle: the inner loop of the module. For the library's own translation
// units.

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::mesh {

struct Foot {
  math::Vec3 offset_m;  // from the closest point to the query
  float distance2_m2;
  Feature feature;
};

/// Skips no triangle.
struct Everything {
  static Everything than(float, float) { return {}; }
  constexpr bool is_line_beyond(float) const { return false; }
  constexpr bool is_corner_beyond(float, float) const { return false; }
  constexpr bool is_plane_beyond(float, float) const { return false; }
};

/// Skips triangles whose computed distance is certainly not below that of the nearest so far, L. A
/// skipped triangle takes two thirds of the work, or less.
///
/// Let e be the offset of p from the line a b, perpendicular to ab, and g be ac, or less a multiple
/// of ab. For each q of the triangle p - q is e - m g and some multiple of ab, 0 <= m <= 1. So e .
/// (p - q) = e^2 - m e . g, and the distance d is at least (e^2 - e . g) / |e|, or |e| where e . g
/// is below 0. And p - q is no shorter than e less its part along h, so that d^2 is at least e^2 -
/// (e . h)^2 / h^2, for any h that is ac less a multiple of ab: also for a sliver's, which may be
/// all rounding.
///
/// Suppose that d is below A = L (1 + 8 u) + 30 u E, beyond which no computed distance is below L
/// (mesh/loss.hpp; u = 2^-24, E the mesh's longest edge). Then |p - a| and |e| are at most P = A +
/// E. Roundings move e by 4 u P across ab and by 16 u P along it, so e^2 by 11 u P^2, and e . ac by
/// at most 24 u P E. What of h is rounding, at most 5 u E, is as if q moved by it. So s is off by
/// at most C = 12 u P^2 + 24 u P E, and e^2 - (e . h)^2 / h^2 by 30 u P^2 + 10 u P E. With S = A^2
/// + 2 C the triangle is not skipped: e^2 - (e . h)^2 / h^2 <= S; and where |e| > sqrt(S), s <= |e|
/// A + C gives s^2 <= e^2 S, because C <= (S - A^2) / 2 <= sqrt(S) (sqrt(S) - A). With 2 A E <= 2^6
/// A^2 + 2^-6 E^2, and the same for L E, S is at most L^2 (1 + 2^-11) + 83 u E^2.
struct Nearer {
  float beyond_m2;  // S, or more

  static float slack_m2(float longest_edge_m) { return longest_edge_m * longest_edge_m * 0x1p-17f; }
  static Nearer than(float distance2_m2, float slack_m2) {
    return {distance2_m2 * (1.0f + 0x1p-10f) + slack_m2};
  }
  static Nearer than_nothing() { return {FLT_MAX}; }
  bool is_line_beyond(float e2) const { return e2 > beyond_m2; }
  bool is_corner_beyond(float e2, float s) const { return s * __builtin_fabsf(s) > e2 * beyond_m2; }
  // If the square of h^2 underflows, h^2 may be denormal.
  bool is_plane_beyond(float plane2, float h2) const {
    return plane2 > beyond_m2 && h2 * h2 > 0.0f;
  }
};

/// The part of a measurement that depends on the triangle alone, computed when it is used.
struct OfCorners {
  math::Vec3 a_m, b_m, c_m;

  math::Vec3 b() const { return b_m; }
  math::Vec3 c() const { return c_m; }
  math::Vec3 ab() const { return b_m - a_m; }
  math::Vec3 ac() const { return c_m - a_m; }
  math::Vec3 across() const { return ac(); }
  static float per_ab2(math::Vec3 ab) { return 1.0f / math::dot(ab, ab); }
  float xc(math::Vec3 ab, float per_ab2) const { return math::dot(ab, ac()) * per_ab2; }
  math::Vec3 h(math::Vec3 ab, float xc) const { return ac() - ab * xc; }
  static float h2(math::Vec3 h) { return math::dot(h, h); }
};

// Member by member: a struct would be built on the stack and copied.
[[gnu::always_inline]] static inline bool put(Foot& foot, math::Vec3 offset_m, Feature feature) {
  foot.offset_m.x = offset_m.x;
  foot.offset_m.y = offset_m.y;
  foot.offset_m.z = offset_m.z;
  foot.distance2_m2 = math::dot(offset_m, offset_m);
  foot.feature = feature;
  return true;
}

/// Closest point of the triangle a b c, whose edge a b is the longest, to p. Shape: OfCorners, or a
/// type with the same values from memory (mesh/leaf.hpp), which may hold the height vector instead
/// of ac.
///
/// In the orthogonal frame of a b and the height vector h = ac - ab (ab . ac) / |ab|^2 the foot of
/// p in the plane is a + ab x + h w; its barycentric coordinates are v = x - w xc (of b) and w (of
/// c). Because a b is the longest edge, the angles at a and b are acute: a point beyond a b has its
/// closest point on a b, one beyond a c or b c on that edge, and only beyond the corner c must both
/// be tested.
///
/// Why not the book's form (Ericson 2005, 5.1.5): it takes v and w from differences of
/// fourth-degree products and loses them on slivers, by 2^-24 (length / height)^2. Here w is taken
/// from what ab x leaves of ap, e, so that h being skew to ab by a rounding, 2^-24 length, meets no
/// component along ab. With d the distance and u = 2^-24 the foot is off in the plane by at most
/// min(u d length / height, height) beside u length, which lengthens d by at most u length / 2.
/// Result: false, and no foot, if `wanted` skips the triangle.
template <class Shape, class Wanted>
[[gnu::always_inline]] static inline bool find_foot(math::Vec3 p, const Shape& shape,
                                                    const Wanted& wanted, Foot& foot) {
  using math::dot;
  using math::Vec3;
  const Vec3 ab = shape.ab(), ap = p - shape.a_m;
  const float per_ab2 = shape.per_ab2(ab);
  const float x = dot(ab, ap) * per_ab2;
  const Vec3 e = ap - ab * x;
  const float e2 = dot(e, e);
  if (wanted.is_line_beyond(e2) && wanted.is_corner_beyond(e2, e2 - dot(e, shape.across())))
    return false;
  const float xc = shape.xc(ab, per_ab2);
  const Vec3 h = shape.h(ab, xc);
  const float y = dot(e, h);
  if (y <= 0.0f) {
    if (x <= 0.0f) return put(foot, ap, Feature::kVertex0);
    if (x >= 1.0f) return put(foot, p - shape.b(), Feature::kVertex1);
    return put(foot, e, Feature::kEdge0);
  }
  const float h2 = shape.h2(h);
  const float w = y / h2;
  const float v = x - w * xc;
  // Includes the border, so that a query at a corner gets the corner, not a face that meets there.
  if (!(v <= 0.0f || v + w >= 1.0f)) return put(foot, e - h * w, Feature::kFace);
  if (wanted.is_plane_beyond(e2 - y * w, h2)) return false;
  if (v <= 0.0f) {
    const Vec3 ac = shape.ac();
    const float t = dot(ac, ap), ac2 = dot(ac, ac);
    if (t <= 0.0f) return put(foot, ap, Feature::kVertex0);
    if (t < ac2) return put(foot, ap - ac * (t / ac2), Feature::kEdge2);
  }
  if (v + w >= 1.0f) {
    const Vec3 b = shape.b(), bc = shape.c() - b, bp = p - b;
    const float t = dot(bc, bp), bc2 = dot(bc, bc);
    if (t <= 0.0f) return put(foot, bp, Feature::kVertex1);
    if (t < bc2) return put(foot, bp - bc * (t / bc2), Feature::kEdge1);
  }
  return put(foot, p - shape.c(), Feature::kVertex2);
}

[[gnu::always_inline]] static inline Foot closest_on_triangle(math::Vec3 p, math::Vec3 a,
                                                              math::Vec3 b, math::Vec3 c) {
  Foot foot;
  find_foot(p, OfCorners{a, b, c}, Everything{}, foot);
  return foot;
}

/// The same out of line, for where it is rare: find_foot() takes 0.4 kB. Result: false if it is
/// beyond `wanted`.
[[gnu::noinline, gnu::cold]] inline bool find_foot_apart(math::Vec3 p, const OfCorners& shape,
                                                         Nearer wanted, Foot& foot) {
  return find_foot(p, shape, wanted, foot);
}
/// The same in one place, for other translation units: GCC makes them copies of the above.
Foot foot_on(math::Vec3 p, const OfCorners& triangle);

}  // namespace firmtouch::mesh
