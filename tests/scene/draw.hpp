#pragma once
#include <cstdint>
#include <random>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::scene_test {

// Numbers from a seed: the same everywhere.
class Draw {
 public:
  explicit Draw(uint32_t seed) : random_(seed) {}
  float between(double low, double high) {
    return static_cast<float>(low +
                              (high - low) * static_cast<double>(random_() >> 5) / 134217728.0);
  }
  math::Vec3 within(double most) {
    const float x = between(-most, most), y = between(-most, most);
    return {x, y, between(-most, most)};
  }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_()) % n; }

 private:
  std::mt19937 random_;
};

}  // namespace firmtouch::scene_test
