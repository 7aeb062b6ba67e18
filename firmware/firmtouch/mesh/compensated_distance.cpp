#include "firmtouch/mesh/compensated_distance.hpp"

namespace firmtouch::mesh {
namespace {

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
Wide halves(float a) {
  const float c = 4097.0f * a, high = c - (c - a);
  return {high, a - high};
}
Wide product(float a, float b) {
  const float p = a * b;
  const Wide x = halves(a), y = halves(b);
  return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
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

Wide3 difference(math::Vec3 a, math::Vec3 b) {  // exact
  return {sum(a.x, -b.x), sum(a.y, -b.y), sum(a.z, -b.z)};
}
Wide3 less(Wide3 a, Wide3 b, Wide times) {
  return {a.x - b.x * times, a.y - b.y * times, a.z - b.z * times};
}
Wide dot(Wide3 a, Wide3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr Wide kZero{0, 0}, kOne{1, 0};

Wide segment_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b) {
  const Wide3 ap = difference(p, a), ab = difference(b, a);
  Wide t = dot(ap, ab) / dot(ab, ab);
  if (t < kZero) t = kZero;
  if (kOne < t) t = kOne;
  const Wide3 offset = less(ap, ab, t);
  return dot(offset, offset);
}

Wide corner_distance2(math::Vec3 p, math::Vec3 a) {
  const Wide3 ap = difference(p, a);
  return dot(ap, ap);
}

}  // namespace

float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c,
                            Feature feature) {
  switch (feature) {
    case Feature::kVertex0:
      return corner_distance2(p, a).high;
    case Feature::kVertex1:
      return corner_distance2(p, b).high;
    case Feature::kVertex2:
      return corner_distance2(p, c).high;
    case Feature::kEdge0:
      return segment_distance2(p, a, b).high;
    case Feature::kEdge1:
      return segment_distance2(p, b, c).high;
    case Feature::kEdge2:
      return segment_distance2(p, c, a).high;
    case Feature::kFace:
      break;
  }
  return compensated_distance2(p, a, b, c);
}

float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, math::Vec3 c) {
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

}  // namespace firmtouch::mesh
