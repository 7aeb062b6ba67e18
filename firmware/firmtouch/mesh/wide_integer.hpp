#pragma once
// Integers wide enough for products of three differences of floats. For the library's own
// translation units.

#include "firmtouch/math/isa.hpp"

namespace firmtouch::mesh {

// Floats reach from 2^-149 to below 2^128: a difference of two has 278 bits, a product of three and
// the sum of eighteen such 839.
constexpr uint32_t kDifferenceLimbs = 9;
constexpr uint32_t kSumLimbs = 3 * kDifferenceLimbs + 1;

/// Sign and magnitude.
struct Difference {
  uint32_t limb[kDifferenceLimbs];
  int32_t sign;
};

/// Floats as multiples of their lowest set bit.
class Scale {
 public:
  void cover(float value) {
    const uint32_t bits = math::bits_of(value) & 0x7FFFFFFFu;
    if (bits == 0) return;
    const int32_t at = slot(bits);
    const int32_t low = at + __builtin_ctz(mantissa(bits));
    const int32_t high = at + 32 - __builtin_clz(mantissa(bits));
    low_ = low < low_ ? low : low_;
    high_ = high > high_ ? high : high_;
  }
  /// Limbs of a difference of two covered values.
  uint32_t limbs() const {
    return high_ < low_ ? 1 : (static_cast<uint32_t>(high_ - low_) + 32) / 32;
  }
  Difference difference(float x, float y) const {
    const uint32_t x_bits = math::bits_of(x), y_bits = math::bits_of(y), n = limbs();
    Difference a, b;
    put(x_bits & 0x7FFFFFFFu, a.limb, n);
    put(y_bits & 0x7FFFFFFFu, b.limb, n);
    const int32_t x_sign = x_bits >> 31 ? -1 : 1, y_sign = y_bits >> 31 ? -1 : 1;
    if (x_sign != y_sign) {
      add(a.limb, b.limb, n, x_sign, a);
    } else if (less(a.limb, b.limb, n)) {
      subtract(b.limb, a.limb, n, -x_sign, a);
    } else {
      subtract(a.limb, b.limb, n, x_sign, a);
    }
    return a;
  }

 private:
  static uint32_t mantissa(uint32_t bits) {
    return bits < 0x800000u ? bits : (bits & 0x7FFFFFu) | 0x800000u;
  }
  static int32_t slot(uint32_t bits) {  // of the mantissa's last bit, from 2^-149
    return bits < 0x800000u ? 0 : static_cast<int32_t>(bits >> 23) - 1;
  }
  void put(uint32_t bits, uint32_t* limb, uint32_t n) const {
    for (uint32_t i = 0; i < n; ++i) limb[i] = 0;
    if (bits == 0) return;
    // Zeros below the lowest bit of all: shifted out where the mantissa's place is below it.
    const int32_t up = slot(bits) - low_;
    const uint64_t value = up < 0 ? uint64_t{mantissa(bits)} >> -up : mantissa(bits);
    const uint32_t shift = up < 0 ? 0 : static_cast<uint32_t>(up);
    const uint64_t moved = value << (shift % 32);
    limb[shift / 32] = static_cast<uint32_t>(moved);
    if (shift / 32 + 1 < n) limb[shift / 32 + 1] = static_cast<uint32_t>(moved >> 32);
  }
  static bool less(const uint32_t* a, const uint32_t* b, uint32_t n) {
    for (uint32_t i = n; i-- > 0;)
      if (a[i] != b[i]) return a[i] < b[i];
    return false;
  }
  static void add(const uint32_t* a, const uint32_t* b, uint32_t n, int32_t sign, Difference& to) {
    uint64_t carry = 0;
    uint32_t any = 0;
    for (uint32_t i = 0; i < n; ++i) {
      carry += uint64_t{a[i]} + b[i];
      to.limb[i] = static_cast<uint32_t>(carry);
      any |= to.limb[i];
      carry >>= 32;
    }
    to.sign = any == 0 ? 0 : sign;
  }
  static void subtract(const uint32_t* a, const uint32_t* b, uint32_t n, int32_t sign,
                       Difference& to) {
    uint32_t borrow = 0, any = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const uint64_t rest = uint64_t{a[i]} - b[i] - borrow;
      to.limb[i] = static_cast<uint32_t>(rest);
      borrow = static_cast<uint32_t>(rest >> 63);
      any |= to.limb[i];
    }
    to.sign = any == 0 ? 0 : sign;
  }

  int32_t low_ = 1000, high_ = -1000;
};

/// A sum of products, in two's complement of `n` limbs.
class Sum {
 public:
  explicit Sum(uint32_t difference_limbs) : n_(3 * difference_limbs + 1) {
    for (uint32_t i = 0; i < n_; ++i) limb_[i] = 0;
  }

  void add_product(const Difference& x, const Difference& y, const Difference& z, int32_t sign) {
    const int32_t whole = x.sign * y.sign * z.sign * sign;
    if (whole == 0) return;
    const uint32_t n = (n_ - 1) / 3;
    uint32_t two[2 * kDifferenceLimbs], three[kSumLimbs];
    multiply(x.limb, n, y.limb, n, two);
    multiply(two, 2 * n, z.limb, n, three);
    three[3 * n] = 0;
    accumulate(three, whole);
  }
  void add_product(const Difference& x, const Difference& y, int32_t sign) {
    const int32_t whole = x.sign * y.sign * sign;
    if (whole == 0) return;
    const uint32_t n = (n_ - 1) / 3;
    uint32_t two[kSumLimbs];
    multiply(x.limb, n, y.limb, n, two);
    for (uint32_t i = 2 * n; i < n_; ++i) two[i] = 0;
    accumulate(two, whole);
  }
  void add(const Sum& other, int32_t sign) { accumulate(other.limb_, sign); }

  int32_t sign() const {
    if (limb_[n_ - 1] >> 31 != 0) return -1;
    uint32_t any = 0;
    for (uint32_t i = 0; i < n_; ++i) any |= limb_[i];
    return any != 0 ? 1 : 0;
  }

  /// Magnitude as fraction * 2^exponent, fraction in [0.5, 1] and rounded once; zero: 0.
  float fraction(int32_t& exponent) const {
    Sum size(*this);
    if (sign() < 0) {
      for (uint32_t i = 0; i < n_; ++i) size.limb_[i] = 0;
      size.accumulate(limb_, -1);
    }
    uint32_t top = n_ - 1;
    while (top > 0 && size.limb_[top] == 0) --top;
    exponent = 0;
    if (size.limb_[top] == 0) return 0.0f;
    const uint32_t shift = static_cast<uint32_t>(__builtin_clz(size.limb_[top]));
    const uint32_t below = top > 0 ? size.limb_[top - 1] : 0;
    const uint64_t leading = ((uint64_t{size.limb_[top]} << 32) | below) << shift;
    exponent = static_cast<int32_t>(32 * (top + 1) - shift);
    return static_cast<float>(static_cast<uint32_t>(leading >> 32)) * 0x1p-32f;
  }

 private:
  static void multiply(const uint32_t* a, uint32_t na, const uint32_t* b, uint32_t nb,
                       uint32_t* to) {
    for (uint32_t i = 0; i < na + nb; ++i) to[i] = 0;
    for (uint32_t i = 0; i < na; ++i) {
      uint64_t carry = 0;
      for (uint32_t k = 0; k < nb; ++k) {
        carry += uint64_t{a[i]} * b[k] + to[i + k];
        to[i + k] = static_cast<uint32_t>(carry);
        carry >>= 32;
      }
      to[i + nb] = static_cast<uint32_t>(carry);
    }
  }
  void accumulate(const uint32_t* other, int32_t sign) {
    const uint32_t flip = sign < 0 ? 0xFFFFFFFFu : 0u;
    uint64_t carry = flip & 1u;
    for (uint32_t i = 0; i < n_; ++i) {
      carry += uint64_t{limb_[i]} + (other[i] ^ flip);
      limb_[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
  }

  uint32_t n_;
  uint32_t limb_[kSumLimbs];
};

}  // namespace firmtouch::mesh
