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

}  // namespace firmtouch::test
