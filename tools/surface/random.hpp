#pragma once
#include <cstdint>

namespace firmtouch::tools {

/// splitmix64: the same numbers on every machine (the standard library's distributions differ
/// between libraries).
/// Source: Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators", figure 16.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ull;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // [0, 1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(((next() >> 32) * count) >> 32); }
  /// Bell-shaped, mean 0, variance 1: four uniforms, which needs no logarithm.
  double bell() { return (uniform() + uniform() + uniform() + uniform() - 2) * 1.7320508075688772; }

 private:
  uint64_t state_;
};

}  // namespace firmtouch::tools
