#include "firmtouch/scene/textured.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/texture_pull.hpp"

namespace firmtouch::scene {

using math::Vec3;

Vec3 place_in(const math::RigidTransform& pose, Vec3 position_m) {
  return math::apply_inverse(pose, position_m);
}

void begin_texture(ProxyContact& contact, const ProxyTouch& touch, const TexturedTouch& state) {
  const Proxy& proxy = touch.proxy;
  const float reach_m = state.is_held ? 0.0f : proxy.free_m - proxy.radius_m;
  if (!(math::length(contact.proxy_m - proxy.position_m) <= reach_m))
    contact.proxy_m = proxy.position_m;
}

void end_texture(const ProxyContact& contact, const Cut& cut, const math::RigidTransform& pose,
                 const ProxyTouch& touch, TexturedTouch& state, servo::LocalModel& model) {
  servo::ProxySpring& spring = model.spring;
  state.is_held = spring.is_used && touch.proxy.is_loaded && touch.penetration_m > 0.0f;
  const float slope2 = math::dot(cut.slope, cut.slope);
  if (!state.is_held || !(cut.depth_m >= 0.0f && cut.depth_m <= kMaxTextureHeight_m) ||
      !(slope2 <= kMaxTextureSlope * kMaxTextureSlope))
    return;
  const float stretch_m = touch.penetration_m - cut.depth_m;
  const Vec3 pull_m = touch.proxy.position_m - contact.position_m;
  const Vec3 push = pull_m * (1.0f / touch.penetration_m) + pose.rotation * cut.slope;
  pull_along(push, spring.stiffness_N_per_m * stretch_m, stretch_m, contact.position_m, spring);
}

}  // namespace firmtouch::scene
