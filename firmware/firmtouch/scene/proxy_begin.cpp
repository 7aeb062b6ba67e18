// How a contact begins: the side of the hand, and what is certified until it is known.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/proxy.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// Parts of a free radius by which the search for the side goes on: together within it.
constexpr float kTowards = 0.7f;
// Of the size, from a hand on the surface: free by kMinRadius from where it is not as near.
constexpr float kBeside = 2.6f * kMinRadius;
constexpr Vec3 kAside{0.07f, 0.14f, -0.11f};

// The way round a crease, beside which exact answers give no side: to the normal of a face that
// meets there and a part of the distance beyond, so that it ends above that face; no farther than a
// part of what is free.
constexpr float kBeyond = 0.1f, kFree = 0.9f;
Vec3 round_crease(const Near& near, Vec3 off_m) {
  const float high_m = math::dot(off_m, near.outward), most_m = kFree * near.lower_m;
  const float up_m = __builtin_copysignf(near.lower_m, high_m) + kBeyond * high_m;
  const Vec3 way_m = near.outward * up_m - off_m * (1.0f + kBeyond);
  const float size_m = math::length(way_m);
  return size_m <= most_m ? way_m : way_m * (most_m / size_m);
}

}  // namespace

Bounds bounds_of(const Proxy& proxy, Vec3 hand_m) {
  float free_m = proxy.near.lower_m;
  if (proxy.phase == Proxy::Phase::kFree)
    free_m = proxy.free_m;
  else if (proxy.searched_free_m > 0.0f)  // while the side is looked for the hand goes on
    free_m = math::larger(free_m - math::length(hand_m - proxy.searched_m) * kLengthUp, 0.0f);
  // Since the last query it has moved by what the free radius has lost.
  return {free_m, proxy.near.distance_m + (proxy.near.lower_m - free_m)};
}

// Where the side of the hand is not known, the search goes on from ball to ball towards the
// surface, where it needs fewer visits, in the next tick if it must: in free balls that overlap all
// has one side. It goes aside, too: on the axis of a turned part the triangles of a whole ring are
// equally near, all the way. A hand on the surface has no side: the proxy begins beside it.
void ProxyMove::begin_contact(const Near& near) {
  is_over_ = true;
  if (!is_searching_) {
    proxy_.near = near;
    proxy_.searched_m = trial_m_;
    proxy_.searched_free_m = near.lower_m;
    if (!is_beside_ && near.is_exact && near.lower_m < kMinRadius * size_m_ &&
        math::is_about_unit(near.outward)) {
      is_beside_ = true;
      const Vec3 off = tangent_at(near.feature, goal_m_, {}).normal;  // 0: it is on the surface
      const bool is_behind = !near.has_inside && math::dot(off, near.outward) < 0.0f;
      trial_m_ = goal_m_ + near.outward * (is_behind ? -kBeside * size_m_ : kBeside * size_m_);
      is_over_ = work_left_ == 0;
      moved_.is_starved = is_over_;
      return;
    }
  }
  if (!near.has_inside || near.sign != 0) {
    begin_at(is_searching_ ? goal_m_ : trial_m_, near.sign);
    proxy_.feature_count = 0;
    if (!is_searching_) keep(near.feature);
    return;
  }
  moved_.is_starved = true;
  proxy_.phase = Proxy::Phase::kUnknown;
  Vec3 step_m;
  if (near.is_exact) {
    step_m = round_crease(near, trial_m_ - near.feature.corner[0]);
  } else {
    const Tangent tangent = tangent_at(near.feature, trial_m_, {});
    const Vec3 step = tangent.normal * __builtin_copysignf(kTowards, tangent.distance_m) + kAside;
    step_m = step * -near.lower_m;
  }
  proxy_.position_m = trial_m_ = trial_m_ + step_m;
  is_searching_ = near.lower_m > kClearance * size_m_ && work_left_ > 0;
  is_over_ = !is_searching_;
}

void ProxyMove::begin_at(Vec3 place_m, int8_t sign) {
  const float moved_m = math::length(place_m - proxy_.searched_m);
  proxy_.position_m = begin_m_ = place_m;
  proxy_.free_m = proxy_.searched_free_m - moved_m * kLengthUp;
  proxy_.near.lower_m = proxy_.free_m;
  proxy_.near.distance_m = proxy_.near.distance_m + moved_m;
  proxy_.near.sign = sign;
  proxy_.searched_free_m = 0;
  proxy_.slid_m = 0;
  const float least_m = kMinRadius * size_m_;
  const float radius_m = settings_.radius_m > least_m ? settings_.radius_m : least_m;
  moved_.is_starved = false;
  moved_.is_optimal = true;
  if (sign < 0) {
    proxy_.phase = Proxy::Phase::kInside;
  } else if (proxy_.free_m >= least_m) {
    proxy_.phase = Proxy::Phase::kFree;
    proxy_.is_growing = proxy_.free_m < radius_m;
    proxy_.radius_m = proxy_.is_growing ? proxy_.free_m : radius_m;
  } else {  // on the surface
    proxy_.phase = Proxy::Phase::kUnknown;
    moved_.is_optimal = false;
    moved_.is_starved = true;
  }
}

}  // namespace firmtouch::scene
