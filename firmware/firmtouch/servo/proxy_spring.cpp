#include "firmtouch/servo/proxy_spring.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::servo {

using math::Vec3;

Vec3 proxy_at(const ProxySpring& spring, Vec3 position_m) {
  if (!spring.is_used) return position_m;
  const Vec3 off_m = position_m - spring.anchor_m;
  const float size_m = math::length(off_m);
  if (spring.is_held || !math::is_finite(size_m)) return spring.anchor_m;
  if (size_m <= spring.reach_m) return position_m;
  return spring.anchor_m + off_m * (spring.reach_m / size_m);
}

Vec3 spring_N(const ProxySpring& spring, Vec3 proxy_m, float stretch_m, Vec3 position_m,
              Vec3 velocity_mps) {
  if (!spring.is_used) return {};
  const Vec3 off_m = proxy_m - position_m;
  const float size_m = math::length(off_m);
  if (!(size_m > 0.0f)) return {};
  const Vec3 direction = off_m * (1.0f / size_m);
  const float pull_N = spring.stiffness_N_per_m * (stretch_m < size_m ? stretch_m : size_m) -
                       spring.damping_N_s_per_m * math::dot(direction, velocity_mps);
  return pull_N > 0.0f ? direction * pull_N : Vec3{};
}

}  // namespace firmtouch::servo
