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
Wide product(float a, float b) {
  const float p = a * b;
  return {p, math::product_error(a, b, p)};
}
Wide operator+(Wide a, Wide b) {
  const Wide high = sum(a.high, b.high), low = sum(a.low, b.low);
  const Wide once = ordered_sum(high.high, high.low + low.high);
  return ordered_sum(once.high, once.low + low.low);
}
Wide operator-(Wide a) { return {-a.high, -a.low}; }
Wide operator-(Wide a, Wide b) { return a + -b; }
Wide operator*(Wide a, Wide b) {
  const Wide p = product(a.high, b.high);
  return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
Wide operator/(Wide a, Wide b) {
  const float first = a.high / b.high;
  const Wide rest = a - b * Wide{first, 0};
  return ordered_sum(first, rest.high / b.high);
}
bool operator<(Wide a, Wide b) { return a.high < b.high || (a.high <= b.high && a.low < b.low); }

struct Wide3 {
  Wide x, y, z;
};

Wide3 difference(Vec3 a, Vec3 b) {  // exact
  return {sum(a.x, -b.x), sum(a.y, -b.y), sum(a.z, -b.z)};
}
Wide3 less(Wide3 a, Wide3 b, Wide times) {
  return {a.x - b.x * times, a.y - b.y * times, a.z - b.z * times};
}
Wide dot(Wide3 a, Wide3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr Wide kZero{0, 0}, kOne{1, 0};

[[gnu::noinline]] Wide segment_distance2(Vec3 p, Vec3 a, Vec3 b) {
  const Wide3 ap = difference(p, a), ab = difference(b, a);
  Wide t = dot(ap, ab) / dot(ab, ab);
  if (t < kZero) t = kZero;
  if (kOne < t) t = kOne;
  const Wide3 offset = less(ap, ab, t);
  return dot(offset, offset);
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

float corner_distance2(Vec3 p, Vec3 a) { return square(difference(p, a)); }

float share(float t) { return t > 0.0f ? t < 1.0f ? t : 1.0f : 0.0f; }

// By the offset from where floats put the foot, and what that leaves along the edge.
[[gnu::noinline]] float edge_distance2(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const float per_ab2 = 1.0f / math::dot(ab, ab);
  const float t = share(math::dot(ab, p - a) * per_ab2);
  const Wide3 offset = ordered(less(difference(p, a), difference(b, a), t));
  const float further = share(t + math::dot(ab, rounded(offset)) * per_ab2) - t;
  return square(corrected(offset, ab, further));
}

// The same on the plane, with the names of mesh/triangle.hpp. `is_clear`: the foot is within the
// triangle.
constexpr float kOutside = -1.0f, kNeedle = -2.0f;
[[gnu::noinline]] float face_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c, bool is_clear) {
  const OfCorners shape{a, b, c};
  const Vec3 ab = shape.ab(), ap = p - a;
  const float per_ab2 = OfCorners::per_ab2(ab), xc = shape.xc(ab, per_ab2);
  const Vec3 h = shape.h(ab, xc);
  const float h2 = OfCorners::h2(h), x = math::dot(ab, ap) * per_ab2;
  const float w = math::dot(ap - ab * x, h) / h2, v = x - w * xc;
  const Wide3 offset =
      ordered(less(less(difference(p, a), difference(b, a), v), difference(c, a), w));
  if (is_clear) return square(offset);
  if (!(h2 * per_ab2 > 0x1p-26f)) return kNeedle;  // h is little more than rounding
  const float dx = math::dot(ab, rounded(offset)) * per_ab2;
  const float dw = math::dot(h, rounded(offset)) / h2, dv = dx - dw * xc;
  if (!(w + dw >= 0.0f && v + dv >= 0.0f && ((1.0f - w) - v) - (dw + dv) >= 0.0f)) return kOutside;
  return square(corrected(corrected(offset, ab, dx), h, dw));
}

float feature_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c, Feature feature) {
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
      return corner_distance2(p, c);
    case Feature::kFace:
      break;
  }
  return face_distance2(p, a, b, c, true);
}

}  // namespace

float compensated_distance2(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  Wide least = segment_distance2(p, a, b);
  const Wide bc = segment_distance2(p, b, c), ca = segment_distance2(p, c, a);
  if (bc < least) least = bc;
  if (ca < least) least = ca;

  // Where the foot in the plane lies inside, as in mesh/triangle.hpp.
  const Wide3 ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
  const Wide ab2 = dot(ab, ab), x = dot(ab, ap) / ab2, xc = dot(ab, ac) / ab2;
  const Wide3 e = less(ap, ab, x), h = less(ac, ab, xc);
  const Wide h2 = dot(h, h);
  if (kZero < h2) {
    const Wide w = dot(e, h) / h2, v = x - w * xc;
    if (!(w < kZero || v < kZero || kOne < v + w)) {
      const Wide3 offset = less(e, h, w);
      const Wide inside = dot(offset, offset);
      if (inside < least) least = inside;
    }
  }
  return least.high;
}

float nearest_compensated2(Vec3 p, Vec3 a, Vec3 b, Vec3 c, Feature feature, float distance2_m2) {
  if (is_feature_clear(distance2_m2, b - a)) return feature_distance2(p, a, b, c, feature);
  const float face2 = face_distance2(p, a, b, c, false);
  if (face2 >= 0.0f) return face2;
  if (face2 <= kNeedle) return compensated_distance2(p, a, b, c);
  const float least = math::smaller(edge_distance2(p, a, b), edge_distance2(p, b, c));
  return math::smaller(edge_distance2(p, c, a), least);
}

}  // namespace firmtouch::mesh
