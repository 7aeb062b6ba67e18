#pragma once
// A segment against a triangle in doubles, where their error bound decides: on a host they are
// cheaper than the integers of mesh::exact_crossing(). Compiled once per level.

#include "firmtouch/mesh/exact_crossing.hpp"

namespace firmtouch::simd {

/// A sum of products of three differences of floats, and the sum of their magnitudes. With u =
/// 2^-53, three differences, four operations on products and at most four sums more are off by 11 u
/// of the magnitudes. Nothing under- or overflows: a difference of floats is 0 or 2^-149 at least,
/// and 2^129 at most.
struct DoubleSum {
  double value, size;

  double error() const { return size * 0x1p-49; }
  /// 0: not certain.
  int32_t sign() const { return value > error() ? 1 : value < -error() ? -1 : 0; }
  DoubleSum operator+(const DoubleSum& o) const { return {value + o.value, size + o.size}; }
  DoubleSum operator-(const DoubleSum& o) const { return {value - o.value, size + o.size}; }
};

struct Difference {
  double x, y, z;

  Difference(math::Vec3 to, math::Vec3 from)
      : x(double{to.x} - double{from.x}),
        y(double{to.y} - double{from.y}),
        z(double{to.z} - double{from.z}) {}
};

[[gnu::always_inline]] static inline DoubleSum determinant(const Difference& u, const Difference& v,
                                                           const Difference& w) {
  const double x1 = v.y * w.z, x2 = v.z * w.y, y1 = v.z * w.x, y2 = v.x * w.z, z1 = v.x * w.y,
               z2 = v.y * w.x;
  const auto size = [](double part, double one, double other) {
    return __builtin_fabs(part) * (__builtin_fabs(one) + __builtin_fabs(other));
  };
  return {u.x * (x1 - x2) + u.y * (y1 - y2) + u.z * (z1 - z2),
          size(u.x, x1, x2) + size(u.y, y1, y2) + size(u.z, z1, z2)};
}

/// Of a magnitude: the power of two above it, and mesh::Sum::fraction() of it.
struct Fraction {
  int32_t exponent;
  float fraction;

  explicit Fraction(double size) {
    uint64_t bits;
    __builtin_memcpy(&bits, &size, sizeof bits);
    exponent = static_cast<int32_t>(bits >> 52) - 1022;
    const uint32_t leading = 0x80000000u | static_cast<uint32_t>(bits >> 21 & 0x7FFFFFFFu);
    fraction = static_cast<float>(leading) * 0x1p-32f;
  }
  /// Of a sum whose sign is certain: whether its error leaves the fraction as it is.
  static bool is_certain(const DoubleSum& sum, Fraction& of) {
    const double size = __builtin_fabs(sum.value);
    of = Fraction(size - sum.error());
    const Fraction high(size + sum.error());
    return of.exponent == high.exponent &&
           math::bits_of(of.fraction) == math::bits_of(high.fraction);
  }
};

/// Whether doubles decide: then `crossing` is mesh::exact_crossing(), to the bit.
[[gnu::noinline, maybe_unused]] static bool decides_in_double(math::Vec3 a, math::Vec3 b,
                                                              math::Vec3 p, math::Vec3 q,
                                                              math::Vec3 r,
                                                              mesh::Crossing& crossing) {
  crossing = {};
  const Difference along(b, a), to_p(p, a), to_q(q, a), to_r(r, a);
  const DoubleSum side[3] = {determinant(along, to_p, to_q), determinant(along, to_q, to_r),
                             determinant(along, to_r, to_p)};
  const int32_t way[3] = {side[0].sign(), side[1].sign(), side[2].sign()};
  // Two sides of which one is certainly left and one certainly right: the line misses.
  if (way[0] * way[1] < 0 || way[1] * way[2] < 0 || way[2] * way[0] < 0) return true;
  if (way[0] * way[1] * way[2] == 0) return false;
  const DoubleSum along_normal = side[0] + side[1] + side[2];
  const DoubleSum depth = determinant(to_p, to_q, to_r), rest = along_normal - depth;
  const int32_t before = depth.sign(), after = rest.sign();
  if (before == -way[0] || after == -way[0]) return true;
  if (before == 0 || after == 0) return false;
  Fraction part(1.0), whole(1.0);
  if (!Fraction::is_certain(depth, part) || !Fraction::is_certain(along_normal, whole))
    return false;
  crossing.t =
      mesh::ratio_of_fractions(part.fraction, part.exponent, whole.fraction, whole.exponent);
  crossing.direction = static_cast<int8_t>(way[0]);
  return true;
}

}  // namespace firmtouch::simd
