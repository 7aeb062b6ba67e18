#include "surface/exact_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// A float32 is a whole number times a power of two, 2^-149 at the least; so a product of three is a
// whole number of at most 72 bits times 2^-447 at the least. Below 2^24 it stays below 2^72, and 24
// of them below 2^77: with the sign 525 bits.
class Sum {
 public:
  void add(float x, float y, float z, bool is_negative) {
    const Whole a = whole_of(x), b = whole_of(y), c = whole_of(z);
    const uint64_t ab = a.size * b.size;  // 48 bits
    const uint64_t low = (ab & 0xFFFFFFFFu) * c.size, high = (ab >> 32) * c.size;
    const bool minus = is_negative != (a.is_negative != (b.is_negative != c.is_negative));
    put(low, a.shift + b.shift + c.shift, minus);
    put(high, a.shift + b.shift + c.shift + 32, minus);
  }
  int sign() const {
    if ((limb_[kLimbs - 1] & kTopBit) != 0) return -1;
    for (const uint64_t limb : limb_) {
      if (limb != 0) return 1;
    }
    return 0;
  }

 private:
  static constexpr unsigned kLimbs = 9;
  static constexpr uint64_t kTopBit = uint64_t{1} << 63;
  struct Whole {
    uint64_t size;   // 24 bits
    unsigned shift;  // the number is size * 2^(shift - 149)
    bool is_negative;
  };
  static Whole whole_of(float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const uint32_t exponent = (bits >> 23) & 0xFFu, fraction = bits & 0x7FFFFFu;
    return {exponent == 0 ? fraction : fraction | 0x800000u, exponent == 0 ? 0 : exponent - 1,
            (bits >> 31) != 0};
  }

  // Two's complement: plus or minus value * 2^shift.
  void put(uint64_t value, unsigned shift, bool minus) {
    const unsigned first = shift / 64, by = shift % 64;
    uint64_t carry = 0;
    for (unsigned k = first; k < kLimbs; ++k) {
      uint64_t part = 0;
      if (k == first) part = value << by;
      if (k == first + 1 && by != 0) part = value >> (64 - by);
      if (k > first + 1 && carry == 0) break;
      const uint64_t before = limb_[k];
      if (minus) {
        const uint64_t once = before - part;
        limb_[k] = once - carry;
        carry = (once > before || limb_[k] > once) ? 1 : 0;
      } else {
        const uint64_t once = before + part;
        limb_[k] = once + carry;
        carry = (once < before || limb_[k] < once) ? 1 : 0;
      }
    }
  }

  uint64_t limb_[kLimbs] = {};
};

void add_determinant(Sum& sum, math::Vec3 u, math::Vec3 v, math::Vec3 w, bool is_negative) {
  sum.add(u.x, v.y, w.z, is_negative);
  sum.add(u.y, v.z, w.x, is_negative);
  sum.add(u.z, v.x, w.y, is_negative);
  sum.add(u.x, v.z, w.y, !is_negative);
  sum.add(u.y, v.x, w.z, !is_negative);
  sum.add(u.z, v.y, w.x, !is_negative);
}

bool is_same(math::Vec3 a, math::Vec3 b) {
  return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y || a.z < b.z || a.z > b.z);
}

// Coordinates as whole numbers of one unit where all are below 2^39 of it: their differences are
// below 2^40, a product of three below 2^120, and the sum of six below 2^123.
class Lattice {
 public:
  Lattice(math::Vec3 a, math::Vec3 b, math::Vec3 c, math::Vec3 p) {
    const float most = std::max({size(a), size(b), size(c), size(p)});
    int exponent = 0;
    std::frexp(most, &exponent);
    per_unit_ = std::ldexp(1.0, 39 - exponent);
    holds_ = put(a, a_) && put(b, b_) && put(c, c_) && put(p, p_);
  }
  bool holds() const { return holds_; }
  int side() const {
    __extension__ using Wide = __int128;
    int64_t u[3], v[3], w[3];
    for (int k = 0; k < 3; ++k) u[k] = b_[k] - a_[k], v[k] = c_[k] - a_[k], w[k] = p_[k] - a_[k];
    const Wide x = Wide{u[1]} * v[2] - Wide{u[2]} * v[1], y = Wide{u[2]} * v[0] - Wide{u[0]} * v[2],
               z = Wide{u[0]} * v[1] - Wide{u[1]} * v[0];
    const Wide sum = x * w[0] + y * w[1] + z * w[2];
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
  }

 private:
  static float size(math::Vec3 v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  }
  bool put(math::Vec3 from, int64_t to[3]) const {
    const double scaled[3] = {static_cast<double>(from.x) * per_unit_,
                              static_cast<double>(from.y) * per_unit_,
                              static_cast<double>(from.z) * per_unit_};
    bool is_whole = true;
    for (int k = 0; k < 3; ++k) {
      to[k] = static_cast<int64_t>(scaled[k]);
      const double back = static_cast<double>(to[k]);
      is_whole = is_whole && back >= scaled[k] && back <= scaled[k];
    }
    return is_whole;
  }

  double per_unit_;
  bool holds_;
  int64_t a_[3], b_[3], c_[3], p_[3];
};

}  // namespace

int exact_side(math::Vec3 a, math::Vec3 b, math::Vec3 c, math::Vec3 p) {
  if (is_same(p, a) || is_same(p, b) || is_same(p, c)) return 0;
  const Point u = to_point(b) - to_point(a), v = to_point(c) - to_point(a),
              w = to_point(p) - to_point(a);
  const Point n = cross(u, v);
  const double side = dot(n, w);
  const Point most{std::fabs(u.y * v.z) + std::fabs(u.z * v.y),
                   std::fabs(u.z * v.x) + std::fabs(u.x * v.z),
                   std::fabs(u.x * v.y) + std::fabs(u.y * v.x)};
  // Seven roundings of 2^-53 a product (Shewchuk 1997, section 4.3), rounded up.
  const double error =
      1e-15 * (most.x * std::fabs(w.x) + most.y * std::fabs(w.y) + most.z * std::fabs(w.z));
  if (side > error) return 1;
  if (side < -error) return -1;
  const Lattice lattice(a, b, c, p);
  if (lattice.holds()) return lattice.side();
  Sum sum;
  add_determinant(sum, b, c, p, false);
  add_determinant(sum, a, c, p, true);
  add_determinant(sum, a, b, p, false);
  add_determinant(sum, a, b, c, true);
  return sum.sign();
}

}  // namespace firmtouch::tools
