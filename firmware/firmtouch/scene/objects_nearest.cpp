#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/objects.hpp"

// The objects as one shape: which of them to query, and what they answer together.
namespace firmtouch::scene {

using math::Vec3;

namespace {

constexpr float kAsNear = 1e-6f;  // of the size of the scene

// A direction from one frame to another. Inlined it takes 80 B more.
[[gnu::noinline]] void turn(const math::RigidTransform& from, const math::RigidTransform& to,
                            Vec3& way) {
  way = math::transposed_times(to.rotation, from.rotation * way);
}

}  // namespace

// A ball without end about an object without stiffness, so that it is never the nearest. One that
// gains or loses its stiffness does so without load.
void ObjectsTick::leave_out_air() {
  if (proxy_.is_loaded) return;
  for (uint32_t i = 0; i < set_.count; ++i) {
    ObjectPair& pair = set_.pair[i];
    const bool is_air = !(set_.object[i].stiffness_N_per_m > 0.0f);
    if (is_air == (pair.lower_m >= FLT_MAX)) continue;
    pair.lower_m = pair.left_m = is_air ? FLT_MAX : 0.0f;
    pair.sign = 1;  // also of a solid: without a bound it is queried
  }
}

// While the side of the hand is not known, every object matters whose side is not.
void ObjectsTick::begin_query(Vec3 x_m, query::Budget budget, float needed_m) {
  at_ = place_in(touch_.carrier, x_m);
  budget_ = budget;
  needed_m_ = needed_m;
  nearest_ = {};
  answered_ = exact_ = 0;
  is_short_ = false;
  if (proxy_.phase == Proxy::Phase::kFree) {
    const float moved_m = length_up_m(x_m - base_.place.m);
    for (uint32_t i = 0; i < set_.count; ++i) key_m_[i] = base_.m[i] - moved_m;
    return;
  }
  exact_ = UINT32_MAX;
  for (uint32_t i = 0; i < set_.count; ++i) {
    key_m_[i] = bound_m(i, at_);
    if (!(key_m_[i] > 0.0f) || set_.pair[i].sign <= 0) key_m_[i] = -1.0f;
  }
}

// Of the object with the least bound, until that is one that has answered.
bool ObjectsTick::next() {
  for (;;) {
    uint32_t i = 0;
    for (uint32_t k = 1; k < set_.count; ++k)
      if (key_m_[k] < key_m_[i]) i = k;
    if (set_.count == 0 || is_set(answered_, i) || key_m_[i] >= FLT_MAX) return false;
    if (!is_set(exact_, i)) {
      exact_ |= 1u << i;
      key_m_[i] = math::larger(key_m_[i], bound_m(i, at_));
      continue;
    }
    is_short_ = answered_ != 0 && !(nearest_.work < budget_.work);
    if (is_short_) return false;
    query_ = {i, in_object_m(i, at_), budget_, needed_m_};
    query_.budget.work = budget_.work - nearest_.work;
    const float loss = loss_m(i, at_);
    if (query_.budget.threshold_m > 0.0f) query_.budget.threshold_m += loss;
    query_.needed_m += loss;
    return true;
  }
}

bool ObjectsTick::has(const Feature& feature) const {
  return feature.kind == Feature::Kind::kNone ||
         index_of(feature, proxy_, size_m_) < proxy_.feature_count;
}

// Of two that are as near and let the proxy go there: the one whose feature is not in the working
// set. While another object holds the proxy, it would cross a joint of triangles with the plane of
// the one behind alone, which is tilted. Of a tool that is inside of several objects: the one that
// it is deepest in.
bool ObjectsTick::is_better(const Near& near) const {
  if (answered_ == 0) return true;
  if (proxy_.phase == Proxy::Phase::kFree) {
    const float more_m = near.lower_m - nearest_.lower_m;
    const float least_m = math::smaller(near.lower_m, nearest_.lower_m);
    if (least_m < needed_m_ || !(__builtin_fabsf(more_m) <= kAsNear * size_m_))
      return more_m < 0.0f;
    const bool is_known = has(near.feature), was_known = has(nearest_.feature);
    return is_known == was_known ? more_m < 0.0f : was_known;
  }
  const bool is_inside = near.sign < 0, was_inside = nearest_.sign < 0;
  if (is_inside || was_inside)
    return is_inside && (!was_inside || near.distance_m > nearest_.distance_m);
  const bool is_unknown = near.has_inside && near.sign == 0,
             was_unknown = nearest_.has_inside && nearest_.sign == 0;
  if (is_unknown != was_unknown) return is_unknown;
  return near.lower_m < nearest_.lower_m;
}

// From the frame of its object to that of the proxy.
Feature ObjectsTick::in_frame(const Feature& feature) const {
  if (feature.object == touch_.carrier) return feature;
  const math::RigidTransform &from = pose_of(feature.object), &to = pose_of(touch_.carrier);
  const auto moved_m = [&](Vec3 a_m) { return math::apply_inverse(to, math::apply(from, a_m)); };
  Feature answer = feature;
  answer.corner[0] = moved_m(feature.corner[0]);
  if (feature.kind == Feature::Kind::kHalfSpace) {
    turn(from, to, answer.corner[1]);
  } else if (feature.kind == Feature::Kind::kTriangle) {
    answer.corner[1] = moved_m(feature.corner[1]);
    answer.corner[2] = moved_m(feature.corner[2]);
  }
  return answer;
}

void ObjectsTick::take(const Near& near) {
  const uint32_t i = query_.object;
  keep(near.lower_m);
  set_.pair[i].sign = near.has_inside ? near.sign : int8_t{1};
  const uint32_t steps = nearest_.steps + near.steps, work = nearest_.work + near.work;
  Near answer = near;
  key_m_[i] = answer.lower_m = bound_m(i, at_);
  answer.feature.object = static_cast<uint8_t>(i);
  answer.feature = in_frame(answer.feature);
  if (is_better(answer)) {
    touch_.nearest = static_cast<uint8_t>(i);
    touch_.seen_at_m = query_.x_m;
    touch_.seen_m = near.distance_m;
    turn(set_.object[i].pose, pose_of(at_.frame), answer.outward);
    nearest_ = answer;
  }
  answered_ |= 1u << i;
  nearest_.steps = steps;
  nearest_.work = work;
}

// While the proxy moves, the objects stand where they are at the end of the tick: a straight way is
// straight in the frame of each. The axes may get longer than 1 by what two rotations are off, 4e-7
// each.
bool ObjectsTick::is_in_reach(uint32_t i, const Way& way, Way& own) const {
  const float along_m = length_up_m(way.along_m), reach_m = way.radius_m + along_m;
  if (base_.m[i] - length_up_m(way.from_m - base_.place.m) >= reach_m) return false;
  const Place from = place_in(touch_.carrier, way.from_m);
  if (bound_m(i, from) >= reach_m) return false;
  own = way;
  if (i == touch_.carrier) return true;
  own.from_m = in_object_m(i, from);
  own.radius_m += loss_m(i, from) + 0x1p-20f * reach_m;
  const math::RigidTransform &of_proxy = pose_of(touch_.carrier), &of_object = set_.object[i].pose;
  turn(of_proxy, of_object, own.along_m);
  for (uint32_t k = 0; k < way.axes; ++k) turn(of_proxy, of_object, own.axis[k]);
  return true;
}

Near ObjectsTick::nearest() const {
  Near near = nearest_;
  if (answered_ == 0) near.lower_m = near.distance_m = FLT_MAX;  // no object, or all are air
  for (uint32_t i = 0; i < set_.count; ++i)
    if (key_m_[i] < near.lower_m) near.lower_m = math::larger(key_m_[i], 0.0f);
  if (is_short_) {  // an object that may be nearer, or that the tool may be inside of
    near.is_exact = false;
    near.sign = 0;
    near.has_inside = true;
  }
  return near;
}

}  // namespace firmtouch::scene
