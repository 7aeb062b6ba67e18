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
    // By how much the pull has turned: a fall of the proxy, and the new lag, as far as the proxy
    // has gone. The rest is a turn of the hand, which takes as much of the lag: one that a hand
    // could lead round would give energy at each turn.
    Vec3 turned_m = last.pull_m - pull_m * (math::dot(last.pull_m, pull_m) / (depth_m * depth_m));
    Vec3 way_m = spring.anchor_m - last.proxy_m - carried_m;
    const float gone_m = math::length(way_m), turn_m = math::length(turned_m);
    const float by_hand_m = larger(turn_m - gone_m, 0.0f);
    if (by_hand_m > 0.0f) turned_m = turned_m * (gone_m / turn_m);
    way_m = way_m + turned_m;  // without the fall
    aside_m = last.aside_m * smaller(depth_m / last.depth_m, 1.0f) + turned_m;
    // The end stands where the proxy comes towards it, so that no lag pushes the hand on.
    const float size_m = math::length(aside_m), towards_m = math::dot(aside_m, way_m) / size_m;
    const float followed_m = math::length(way_m) * (depth_m / larger(round_m, kMinRound_m));
    left_m = size_m - by_hand_m - larger(towards_m, followed_m);
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
