#include "firmtouch/mesh/exact_crossing.hpp"

#include "firmtouch/mesh/wide_integer.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

struct Difference3 {
  Difference k[3];
};

// With d = b - a and the corners seen from a: the side on which the line passes the edge from p to
// q is the sign of d . (p x q), that of edge q to p the other one to the bit. The three sum to d .
// n, n = (q - p) x (r - p), and p . (q x r) = p . n is the distance of a from the plane.
class Exact {
 public:
  Exact(Vec3 a, Vec3 b, Vec3 p, Vec3 q, Vec3 r) {
    for (const Vec3* v = &a; v != nullptr; v = next(v, a, b, p, q, r)) {
      scale_.cover(v->x);
      scale_.cover(v->y);
      scale_.cover(v->z);
    }
  }
  Difference3 difference(Vec3 x, Vec3 y) const {
    return {
        {scale_.difference(x.x, y.x), scale_.difference(x.y, y.y), scale_.difference(x.z, y.z)}};
  }
  Sum determinant(const Difference3& u, const Difference3& v, const Difference3& w) const {
    Sum sum(scale_.limbs());
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t j = i == 2 ? 0 : i + 1, k = 3 - i - j;
      sum.add_product(v.k[j], w.k[k], u.k[i], 1);
      sum.add_product(v.k[k], w.k[j], u.k[i], -1);
    }
    return sum;
  }
  /// Sign of (u x v) . (e, e^2, e^3) for an infinitely small e > 0.
  int32_t moved_sign(const Difference3& u, const Difference3& v) const {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t j = i == 2 ? 0 : i + 1, k = 3 - i - j;
      Sum sum(scale_.limbs());
      sum.add_product(u.k[j], v.k[k], 1);
      sum.add_product(u.k[k], v.k[j], -1);
      const int32_t sign = sum.sign();
      if (sign != 0) return sign;
    }
    return 0;
  }

 private:
  static const Vec3* next(const Vec3* v, const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q,
                          const Vec3& r) {
    return v == &a ? &b : v == &b ? &p : v == &p ? &q : v == &q ? &r : nullptr;
  }
  Scale scale_;
};

// The quotient of two magnitudes, the first not larger.
float ratio(const Sum& part, const Sum& whole) {
  int32_t part_exponent, whole_exponent;
  const float part_fraction = part.fraction(part_exponent);
  const float whole_fraction = whole.fraction(whole_exponent);
  return ratio_of_fractions(part_fraction, part_exponent, whole_fraction, whole_exponent);
}

}  // namespace

Crossing exact_crossing(Vec3 a, Vec3 b, Vec3 p, Vec3 q, Vec3 r) {
  const Exact exact(a, b, p, q, r);
  const Difference3 along = exact.difference(b, a), to_p = exact.difference(p, a),
                    to_q = exact.difference(q, a), to_r = exact.difference(r, a);
  Sum along_normal = exact.determinant(along, to_p, to_q);
  const int32_t direction = along_normal.sign() != 0
                                ? along_normal.sign()
                                : exact.moved_sign(along, exact.difference(q, p));
  if (direction == 0) return {};
  for (uint32_t edge = 0; edge < 2; ++edge) {
    const Sum side = exact.determinant(along, edge == 0 ? to_q : to_r, edge == 0 ? to_r : to_p);
    const Vec3 from = edge == 0 ? q : r, to = edge == 0 ? r : p;
    const int32_t sign =
        side.sign() != 0 ? side.sign() : exact.moved_sign(along, exact.difference(to, from));
    if (sign != direction) return {};
    along_normal.add(side, 1);
  }
  // The line crosses. Of the ends, one must lie on either side of the plane.
  const Sum depth = exact.determinant(to_p, to_q, to_r);  // of a behind the plane
  Sum rest = along_normal;
  rest.add(depth, -1);
  int32_t before = depth.sign(), after = rest.sign();
  if (before == 0 || after == 0) {
    const int32_t moved = exact.moved_sign(exact.difference(q, p), exact.difference(r, p));
    before = before == 0 ? -moved : before;
    after = after == 0 ? moved : after;
  }
  if (before != direction || after != direction) return {};
  return {static_cast<int8_t>(direction), ratio(depth, along_normal)};
}

}  // namespace firmtouch::mesh
