#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::target {

/// The same numbers in every run (xorshift).
class Random {
 public:
  explicit Random(uint32_t seed) : state_(seed * 2654435761u | 1u) {}
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  uint32_t below(uint32_t end) { return (next() >> 8) % end; }
  /// Uniform in [-1, 1].
  float sign() {
    return static_cast<float>(static_cast<int32_t>(next() >> 8) - (1 << 23)) * 0x1p-23f;
  }
  math::Vec3 cube() {
    const float x = sign(), y = sign();
    return {x, y, sign()};
  }
  /// A power of two times `least`, up to 2^octaves of it.
  float scale(float least, uint32_t octaves) {
    for (uint32_t i = below(octaves + 1); i != 0; --i) least *= 2.0f;
    return least;
  }

 private:
  uint32_t state_;
};

}  // namespace firmtouch::target
