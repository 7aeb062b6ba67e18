#include "firmtouch/mesh/compensated_distance.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

/// The sum of two floats, the second less than half a unit in the last place of the first.
struct Wide {
  float high = 0;
  float low = 0;
};

Wide sum(float a, float b) {
  const float s = a + b, of_b = s - a;
  return {s, (a - (s - of_b)) + (b - of_b)};
}
Wide ordered_sum(float a, float b) {  // |a| >= |b|
  const float s = a + b;
  return {s, b - (s - a)};
}
struct Wide3 {
  Wide x, y, z;
};

Wide3 difference(Vec3 a, Vec3 b) {  // exact
  return {sum(a.x, -b.x), sum(a.y, -b.y), sum(a.z, -b.z)};
}
// a - b * times within 2^-45 of the sizes, without the care for what cancels.
inline Wide less(Wide a, Wide b, float times) {
  const float p = b.high * times;
  const Wide s = sum(a.high, -p);
  return {s.high, s.low + (a.low - (math::product_error(b.high, times, p) + b.low * times))};
}
inline Wide3 less(const Wide3& a, const Wide3& b, float times) {
  return {less(a.x, b.x, times), less(a.y, b.y, times), less(a.z, b.z, times)};
}
inline Wide3 ordered(const Wide3& a) {
  return {ordered_sum(a.x.high, a.x.low), ordered_sum(a.y.high, a.y.low),
          ordered_sum(a.z.high, a.z.low)};
}
// a - b * times, for a small second part.
inline Wide3 corrected(const Wide3& a, Vec3 b, float times) {
  const auto add = [times](Wide v, float of_b) {
    const Wide s = sum(v.high, -(of_b * times));
    return ordered_sum(s.high, s.low + v.low);
  };
  return {add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}
Vec3 rounded(const Wide3& a) { return {a.x.high, a.y.high, a.z.high}; }
// a . a, rounded once.
float square(const Wide3& a) {
  const Wide axes[3] = {a.x, a.y, a.z};
  float high = 0, low = 0;
  for (const Wide& v : axes) {
    const float p = v.high * v.high;
    const Wide s = sum(high, p);
    high = s.high;
    low += s.low + (math::product_error(v.high, v.high, p) + 2.0f * (v.high * v.low));
  }
  return high + low;
}

[[gnu::noinline, gnu::cold]] float corner_distance2(Vec3 p, Vec3 a) {
  return square(difference(p, a));
}

float share(float t) { return t > 0.0f ? t < 1.0f ? t : 1.0f : 0.0f; }

// By the offset from where floats put the foot, and what that leaves along the edge.
[[gnu::noinline, gnu::cold]] float edge_distance2(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const float per_ab2 = 1.0f / math::dot(ab, ab);
  const float t = share(math::dot(ab, p - a) * per_ab2);
  const Wide3 offset = ordered(less(difference(p, a), difference(b, a), t));
  const float further = share(t + math::dot(ab, rounded(offset)) * per_ab2) - t;
  return square(corrected(offset, ab, further));
}

// The same on the plane, with the names of mesh/triangle.hpp. `is_clear`: the foot is within the
// triangle. Result: below 0 if it is not.
//
// Of a needle, lower than 2^-13 of its length, h as floats have it is little more than rounding.
// Its foot is sought from the edge a b, and h computed in pairs: floats lose nothing on so short a
// way.
[[gnu::noinline]] float face_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c, bool is_clear) {
  const OfCorners shape{a, b, c};
  const Vec3 ab = shape.ab(), ap = p - a;
  const float per_ab2 = OfCorners::per_ab2(ab), xc = shape.xc(ab, per_ab2);
  Vec3 h = shape.h(ab, xc);
  float h2 = OfCorners::h2(h), x = math::dot(ab, ap) * per_ab2;
  float w = math::dot(ap - ab * x, h) / h2, v = x - w * xc;
  const Wide3 wide_ab = difference(b, a), wide_ac = difference(c, a);
  if (!is_clear && !(h2 * per_ab2 > 0x1p-26f)) {
    h = rounded(ordered(less(wide_ac, wide_ab, xc)));
    h2 = OfCorners::h2(h);
    v = share(x);
    w = 0.0f;
  }
  Wide3 offset = ordered(less(less(difference(p, a), wide_ab, v), wide_ac, w));
  if (is_clear) return square(offset);
  const float dx = math::dot(ab, rounded(offset)) * per_ab2;
  offset = corrected(offset, ab, dx);
  const float dw = math::dot(h, rounded(offset)) / h2;
  offset = corrected(offset, h, dw);
  const float again = math::dot(ab, rounded(offset)) * per_ab2;
  const float dv = (dx + again) - dw * xc;
  if (!(w + dw >= 0.0f && v + dv >= 0.0f && ((1.0f - w) - v) - (dw + dv) >= 0.0f)) return -1.0f;
  return square(corrected(offset, ab, again));
}

[[gnu::noinline, gnu::cold]] float least_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const float face2 = face_distance2(p, a, b, c, false);
  if (face2 >= 0.0f) return face2;
  const float least = math::smaller(edge_distance2(p, a, b), edge_distance2(p, b, c));
  return math::smaller(edge_distance2(p, c, a), least);
}

// Of an edge or a corner. Only calls that return what they return: no stack of its own.
[[gnu::noinline, gnu::cold]] float border_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c,
                                                    Feature feature) {
  switch (feature) {
    case Feature::kEdge0:
      return edge_distance2(p, a, b);
    case Feature::kEdge1:
      return edge_distance2(p, b, c);
    case Feature::kEdge2:
      return edge_distance2(p, c, a);
    case Feature::kVertex0:
      return corner_distance2(p, a);
    case Feature::kVertex1:
      return corner_distance2(p, b);
    case Feature::kVertex2:
    case Feature::kFace:
      break;
  }
  return corner_distance2(p, c);
}

}  // namespace

float nearest_compensated2(Vec3 p, Vec3 a, Vec3 b, Vec3 c, Feature feature, float distance2_m2) {
  if (!is_feature_clear(distance2_m2, b - a)) return least_distance2(p, a, b, c);
  return feature == Feature::kFace ? face_distance2(p, a, b, c, true)
                                   : border_distance2(p, a, b, c, feature);
}

float compensated_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Foot foot = closest_on_triangle(p, a, b, c);
  return nearest_compensated2(p, a, b, c, foot.feature, foot.distance2_m2);
}

}  // namespace firmtouch::mesh
