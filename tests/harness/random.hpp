#pragma once
#include <stdint.h>

namespace firmtouch::test {

/// Random words for tests that run on controllers too: xorshift of 32 bits, the same everywhere.
/// Source: Marsaglia 2003, "Xorshift RNGs".
class Xorshift {
 public:
  explicit constexpr Xorshift(uint32_t seed) : state_(seed) {}
  uint32_t operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }

 private:
  uint32_t state_;
};

/// A linear congruential generator: numbers from low to high, the same everywhere.
class Lcg {
 public:
  explicit constexpr Lcg(uint32_t seed) : state_(seed) {}
  uint32_t bits() { return state_ = state_ * 1664525u + 1013904223u; }
  float between(float low, float high) {
    return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f);
  }

 private:
  uint32_t state_;
};

}  // namespace firmtouch::test
