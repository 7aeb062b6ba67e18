#pragma once
#include "firmtouch/math/vec3_ops.hpp"
#include "target/random.hpp"

namespace firmtouch::target {

/// A hand near a surface: it creeps, or leaps.
class Hand {
 public:
  Hand(const float* low_m, const float* high_m, uint32_t seed) : random_(seed) {
    low_m_ = {low_m[0], low_m[1], low_m[2]};
    size_m_ = math::Vec3{high_m[0], high_m[1], high_m[2]} - low_m_;
    extent_m_ = math::length(size_m_);
    leap();
  }
  float extent_m() const { return extent_m_; }
  Random& random() { return random_; }
  /// `surface_m`: where the surface is near, of the last query.
  math::Vec3 next(math::Vec3 surface_m) {
    if (random_.below(50) == 0)
      leap();
    else if (random_.below(50) == 0)
      at_m_ = surface_m;
    else
      at_m_ = at_m_ + random_.cube() * random_.scale(1e-4f * extent_m_, 5);
    return at_m_;
  }

 private:
  void leap() {
    const math::Vec3 part = random_.cube() * 0.6f;
    at_m_ = low_m_ + size_m_ * 0.5f +
            math::Vec3{part.x * size_m_.x, part.y * size_m_.y, part.z * size_m_.z};
  }
  Random random_;
  math::Vec3 low_m_, size_m_, at_m_;
  float extent_m_;
};

}  // namespace firmtouch::target
