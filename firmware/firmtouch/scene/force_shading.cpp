#include "firmtouch/scene/force_shading.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {

using math::larger;
using math::smaller;
using math::Vec3;

void shade(float round_m, const Vec3& hand_m, const Vec3& carried_m, ForceShading& last,
           servo::ProxySpring& spring) {
  constexpr float kMinRound_m = 1e-4f;
  const Vec3 pull_m = spring.anchor_m - hand_m;
  const float depth_m = math::length(pull_m);
  Vec3 aside_m;
  float left_m = 0;
  if (last.depth_m > 0.0f && depth_m > 0.0f) {
    // What the pull was across the present one is the new lag; the rest of the proxy's way is no
    // fall.
    Vec3 turned_m = last.pull_m - pull_m * (math::dot(last.pull_m, pull_m) / (depth_m * depth_m));
    Vec3 way_m = spring.anchor_m - last.proxy_m - carried_m;
    // Beyond the proxy's own way the hand has turned the pull. That is no fall, and takes as much
    // of the lag: a lag that a hand could lead round would give energy at each turn.
    const float most_m = math::length(way_m), all_m = math::length(turned_m);
    const float beyond_m = all_m - most_m;
    if (beyond_m > 0.0f) turned_m = turned_m * (most_m / all_m);
    way_m = way_m + turned_m;
    aside_m = last.aside_m * smaller(depth_m / last.depth_m, 1.0f) + turned_m;
    // The end stands where that comes towards it: so nothing stays that does not hold the hand
    // back.
    const float size_m = math::length(aside_m), towards_m = math::dot(aside_m, way_m) / size_m;
    const float by = depth_m / larger(round_m, kMinRound_m);
    left_m = size_m - larger(beyond_m, 0.0f) - larger(towards_m, math::length(way_m) * by);
    if (left_m > depth_m) left_m = depth_m;
    aside_m = left_m > 0.0f ? aside_m * (left_m / size_m) : Vec3{};
  }
  last.proxy_m = spring.anchor_m;
  last.pull_m = pull_m;
  last.aside_m = aside_m;
  last.depth_m = spring.is_held && (round_m > 0.0f || left_m > 0.0f) ? depth_m : 0.0f;
  spring.anchor_m = spring.anchor_m + aside_m;
}

}  // namespace firmtouch::scene
