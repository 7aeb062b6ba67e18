#include "firmtouch/scene/objects.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/pose_loss.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

constexpr math::RigidTransform kUnmoved;

// Rounding of a transform to or from a frame: of what is turned, and of the sum with the
// translation. Inlined it takes 60 B more.
[[gnu::noinline]] float loss_of_m(const math::RigidTransform& pose, Vec3 x_m) {
  return pose_loss_m(pose, x_m) + 0x1p-24f * math::length(x_m);
}

}  // namespace

float ObjectsTick::length_up_m(Vec3 way_m) { return math::length(way_m) * kLengthUp; }

ObjectsTick::ObjectsTick(const ProxyContact& contact, const ObjectSet& set, float size_m,
                         ObjectsTouch& touch)
    : set_{set.object, set.pair, set.count < kMaxObjects ? set.count : kMaxObjects},
      touch_(touch),
      proxy_(touch.touch.proxy),
      tool_(contact.material),
      contact_(contact),
      size_m_(size_m),
      hand_m_(contact.position_m) {
  for (uint32_t i = 0; i < set_.count; ++i)
    if (!is_same(set_.object[i].pose, set_.pair[i].pose)) moved_ |= 1u << i;
  if (!(touch_.carrier < set_.count)) enter(place_in(kNoObject, touch_.anchor_m));
  const uint8_t frame = touch_.carrier;
  const math::RigidTransform& pose = frame == kNoObject ? kUnmoved : set_.pair[frame].pose;
  contact_.proxy_m = is_same(contact.proxy_m, touch_.anchor_m)
                         ? proxy_.position_m
                         : math::apply_inverse(pose, contact.proxy_m);
  const uint32_t touched = frame == kNoObject ? touch_.nearest : frame;
  if (touched < set_.count) {
    contact_.material = material_of(touched);
    const Object& object = set_.object[touched];
    float &at_rest = contact_.settings.friction_static,
          &sliding = contact_.settings.friction_dynamic;
    if (object.friction_static > at_rest) at_rest = object.friction_static;
    if (object.friction_dynamic > sliding) sliding = object.friction_dynamic;
  }
  was_loaded_ = proxy_.is_loaded;
  settings_ = begin_proxy_contact(contact_, touch_.touch);
  leave_out_air();
  was_ = {frame, proxy_.position_m, math::apply(pose, proxy_.position_m), 0.0f};
  if (proxy_.phase == Proxy::Phase::kFree) {
    make_bounds(place_in(frame, proxy_.position_m), base_);
  } else {
    is_carried_ = true;
    enter(place_in(kNoObject, was_.device_m));
    touch_.full_radius_m = 0;
    // The balls in which a side is searched hold for objects that stand still.
    if (moved_ != 0) proxy_.searched_free_m = 0;
    for (uint32_t i = 0; i < set_.count; ++i) set_.pair[i].left_m = 0;
  }
}

// Two springs in series give way to the same force. The tool's alone where the object is rigid.
Material ObjectsTick::material_of(uint32_t i) const {
  const float tool_N_per_m = tool_.stiffness_N_per_m,
              own_N_per_m = set_.object[i].stiffness_N_per_m;
  if (!(own_N_per_m > 0.0f)) return {0.0f, tool_.damping_N_s_per_m};
  return {tool_N_per_m / (1.0f + tool_N_per_m / own_N_per_m), tool_.damping_N_s_per_m};
}

const math::RigidTransform& ObjectsTick::pose_of(uint8_t frame) const {
  return frame == kNoObject ? kUnmoved : set_.object[frame].pose;
}

ObjectsTick::Place ObjectsTick::place_in(uint8_t frame, Vec3 m) const {
  const Vec3 device_m = math::apply(pose_of(frame), m);
  return {frame, m, device_m, loss_of_m(pose_of(frame), device_m)};
}

Vec3 ObjectsTick::in_object_m(uint32_t i, const Place& place) const {
  return i == place.frame ? place.m : math::apply_inverse(set_.object[i].pose, place.device_m);
}

float ObjectsTick::loss_m(uint32_t i, const Place& place) const {
  if (i == place.frame) return 0.0f;
  return place.loss_m + loss_of_m(set_.object[i].pose, place.device_m);
}

// Certified distance of an object, by the ball about where it was last queried.
float ObjectsTick::bound_m(uint32_t i, const Place& place) const {
  const ObjectPair& pair = set_.pair[i];
  const float moved_m = length_up_m(in_object_m(i, place) - pair.at_m);
  const float bound_m = pair.lower_m - moved_m - loss_m(i, place);
  return bound_m > 0.0f ? bound_m : 0.0f;
}

// Of one that is far and stands still only what the proxy has moved is taken off.
void ObjectsTick::make_bounds(const Place& place, Bounds& bounds) const {
  const float moved_m =
      length_up_m(place.device_m - touch_.bounds_at_m) + place.loss_m + touch_.bounds_loss_m;
  constexpr float kFar = 2.0f;  // radii of the tool
  const float far_m = kFar * proxy_.radius_m + moved_m;
  bounds.place = place;
  bounds.least = 0;
  bounds.least_m = FLT_MAX;
  for (uint32_t i = 0; i < set_.count; ++i) {
    const float left_m = set_.pair[i].left_m;
    bounds.m[i] = left_m > far_m && !has_moved(i) ? left_m - moved_m : bound_m(i, place);
    if (bounds.m[i] < bounds.least_m) bounds.least_m = bounds.m[i], bounds.least = i;
  }
}

// Where the proxy is if an object has carried it along.
ObjectsTick::Place ObjectsTick::carried_by(uint32_t i) const {
  const Vec3 m = i == was_.frame ? was_.m : math::apply_inverse(set_.pair[i].pose, was_.device_m);
  return place_in(static_cast<uint8_t>(i), m);
}

// Result: whether the bound of the nearest object may get better: by a query where the proxy was.
bool ObjectsTick::renew(const Bounds& bounds) {
  const uint32_t i = bounds.least;
  if (is_set(renewed_, i) || settings_.budget.work <= renewals_.work) return false;
  const Vec3 x_m = carried_by(i).m;
  const float moved_m = math::length(in_object_m(i, bounds.place) - x_m);
  renewed_ |= 1u << i;  // NOLINT(clang-analyzer-core*): i is below set_.count
  query_ = {i, x_m, {settings_.budget.work - renewals_.work}, proxy_.radius_m + moved_m};
  constexpr float kBand = 0.02f;  // beyond what is needed, of the size of the scene
  query_.budget.band_m = query_.needed_m + moved_m + kBand * size_m_;
  return true;
}

// The ball of a query, unless the one that is known reaches farther there.
void ObjectsTick::keep(float lower_m) {
  ObjectPair& pair = set_.pair[query_.object];
  const float left_m = pair.lower_m - length_up_m(query_.x_m - pair.at_m);
  if (left_m >= lower_m) return;
  pair.at_m = query_.x_m;
  pair.lower_m = lower_m;
}

void ObjectsTick::take_bound(const Near& near) {
  renewals_.steps += near.steps;
  renewals_.work += near.work;
  keep(near.lower_m);
  met_[0] = met_[1];
  met_[1] = near.feature;
  met_[1].object = static_cast<uint8_t>(query_.object);
  make_bounds(base_.place, base_);
}

// The proxy stays where it is in its frame, or goes along with the object that would meet it there.
// Relative to each object it moves within the ball that is certified about where it was.
bool ObjectsTick::carry() {
  if (is_carried_) return false;
  const float full_m = touch_.full_radius_m > 0.0f ? touch_.full_radius_m : proxy_.radius_m;
  const float needed_m = full_m - kClearance * size_m_;
  if (base_.least_m >= needed_m) return end_carry(base_);
  if (renew(base_)) return true;
  Bounds along;
  make_bounds(carried_by(base_.least), along);
  if (!(along.least_m >= needed_m) && renew(along)) return true;
  is_pushed_ = !(along.least_m >= needed_m);
  return end_carry(along.least_m > base_.least_m ? along : base_);
}

bool ObjectsTick::end_carry(const Bounds& bounds) {
  is_carried_ = true;
  if (&bounds != &base_) base_ = bounds;
  enter(base_.place);
  drop_moved_features();
  const uint32_t used = renewals_.work;
  settings_.budget.work = used < settings_.budget.work ? settings_.budget.work - used : 1;
  proxy_.free_m = base_.least_m;
  touch_.bounds_at_m = base_.place.device_m;
  touch_.bounds_loss_m = base_.place.loss_m;
  for (uint32_t i = 0; i < set_.count; ++i) set_.pair[i].left_m = base_.m[i];
  if (is_pushed_) shrink(base_.least_m);
  if (touch_.full_radius_m > 0.0f) {
    proxy_.is_growing = true;
    settings_.growth_m = touch_.full_radius_m - proxy_.radius_m;
  }
  contact_.position_m = math::apply_inverse(pose_of(touch_.carrier), hand_m_);
  if (touch_.carrier != kNoObject) carried_m_ = way_of_carrier();
  return false;
}

// Between two objects that move: the proxy gets as small as the room that is certified, and grows
// to its size again by moving aside, in the same tick.
void ObjectsTick::shrink(float room_m) {
  if (!(room_m > kMinRadius * size_m_)) {
    is_lost_ = true;
    proxy_.phase = Proxy::Phase::kUnknown;
    proxy_.is_loaded = false;
    proxy_.searched_free_m = 0;
    touch_.full_radius_m = 0;
    return enter(place_in(kNoObject, was_.device_m));
  }
  if (!(touch_.full_radius_m > 0.0f)) {
    touch_.full_radius_m = proxy_.radius_m;
    touch_.was_growing = proxy_.is_growing;
  }
  if (room_m < proxy_.radius_m) proxy_.radius_m = room_m;
  for (const Feature& met : met_) {
    const Feature feature = in_frame(met);
    if (has(feature)) continue;  // twice it would leave no place for others
    const uint32_t at = proxy_.feature_count < kMaxFeatures ? proxy_.feature_count++ : 0;
    proxy_.feature[at] = feature;
    proxy_.plane[at] = {};  // a proxy that grows takes all anew
  }
}

// Half of where the carrier takes the proxy from where it was, and of where it took it from: along
// a turn, as its motion there is. The chord alone also leads inward: that would count as work.
Vec3 ObjectsTick::way_of_carrier() const {
  const Vec3 back_m = math::apply(set_.pair[touch_.carrier].pose,
                                  math::apply_inverse(pose_of(touch_.carrier), was_.device_m));
  return (base_.place.device_m - back_m) * 0.5f;
}

void ObjectsTick::enter(const Place& place) {
  if (touch_.carrier == place.frame) return;
  touch_.carrier = place.frame;
  proxy_.position_m = place.m;
  proxy_.feature_count = 0;
  proxy_.active.count = 0;
}

// Features of objects that moved relative to the proxy's frame. Its queries find them again.
void ObjectsTick::drop_moved_features() {
  const uint8_t frame = touch_.carrier;
  const bool has_frame_moved = frame != kNoObject && has_moved(frame);
  if (proxy_.feature_count > kMaxFeatures) proxy_.feature_count = 0;
  for (uint32_t i = 0; i < proxy_.feature_count;) {
    const uint32_t owner = proxy_.feature[i].object;
    if (owner == frame || (owner < set_.count && !has_frame_moved && !has_moved(owner))) {
      ++i;
    } else {
      const uint32_t last = --proxy_.feature_count;
      proxy_.feature[i] = proxy_.feature[last];
      proxy_.plane[i] = proxy_.plane[last];
    }
  }
}

void ObjectsTick::restore_radius() {
  float& full_m = touch_.full_radius_m;
  if (proxy_.phase != Proxy::Phase::kFree) full_m = 0;
  if (!(full_m > 0.0f)) return;
  touch_.is_squeezed = proxy_.radius_m < kSqueezed * full_m;
  if (proxy_.free_m >= full_m - kClearance * size_m_) {
    proxy_.radius_m = full_m;
    proxy_.is_growing = touch_.was_growing;
    full_m = 0;
  }
}

// The object whose frame the proxy is in next: one that holds it.
uint8_t ObjectsTick::touched() const {
  if (proxy_.phase != Proxy::Phase::kFree || !proxy_.is_loaded) return kNoObject;
  uint8_t first = kNoObject;
  for (uint32_t n = 0; n < proxy_.active.count && n < 3; ++n) {
    const uint32_t at = proxy_.active.plane[n];
    if (at >= proxy_.feature_count) continue;
    const uint8_t owner = proxy_.feature[at].object;
    if (owner == touch_.carrier) return owner;
    if (first == kNoObject && owner < set_.count) first = owner;
  }
  return first == kNoObject ? touch_.carrier : first;
}

void ObjectsTick::finish(const ProxyMoved& moved, servo::LocalModel& model) {
  ProxyMoved all = moved;
  all.steps += renewals_.steps;
  all.work += renewals_.work;
  touch_.is_squeezed = is_lost_;
  restore_radius();
  const uint8_t next = touched();
  // A proxy without load takes the material of what it meets.
  if (!was_loaded_ && next != kNoObject) touch_.touch.material = material_of(next);
  const Place place = place_in(touch_.carrier, proxy_.position_m);
  touch_.upper_m = touch_.seen_m;
  if (touch_.nearest < set_.count)
    touch_.upper_m += math::length(in_object_m(touch_.nearest, place) - touch_.seen_at_m);
  if (is_pushed_ && !is_lost_) carried_m_ = carried_m_ + (place.device_m - base_.place.device_m);
  end_proxy_contact(contact_, all, touch_.touch, model);
  touch_.anchor_m = place.device_m;
  model.spring.anchor_m = place.device_m;
  // An object that leaps does not move.
  const Vec3 velocity_mps = carried_m_ * (1.0f / contact_.passed_s);
  if (math::is_within(velocity_mps, servo::kMaxVelocity_mps))
    model.spring.velocity_mps = velocity_mps;
  model.is_squeezed = touch_.is_squeezed;
  if (next != touch_.carrier)
    enter(place_in(next, math::apply_inverse(pose_of(next), place.device_m)));
  for (uint32_t i = 0; i < set_.count; ++i)
    if (has_moved(i)) set_.pair[i].pose = set_.object[i].pose;
}

}  // namespace firmtouch::scene
