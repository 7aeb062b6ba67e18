#pragma once
// For the library's own translation units.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::scene {

/// A spring that is stretched by `stretch_m` / |push|, of this force times `push`: without slack
/// its energy is the law's (scene/texture.hpp). In a trough there is none.
static inline void pull_along(math::Vec3 push, float force_N, float stretch_m,
                              math::Vec3 position_m, servo::ProxySpring& spring) {
  if (!(force_N > 0.0f)) {
    spring.stiffness_N_per_m = spring.damping_N_s_per_m = 0;
    return;
  }
  const float square = math::dot(push, push);
  spring.stiffness_N_per_m = force_N / stretch_m * square;
  spring.anchor_m = position_m + push * (stretch_m / square);
}

}  // namespace firmtouch::scene
