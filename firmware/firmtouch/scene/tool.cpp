#include "firmtouch/scene/tool.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/object.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A sphere is far where so many of its radii are certified to be free.
constexpr float kFar = 2.0f;
// A spring is at most so many times as long as that of the sphere that is pressed most: spheres
// that nearly balance each other have energy and next to no force.
constexpr float kLongest = 8.0f;

Vec3 arm_m(const SphereLayout& sphere, const math::Mat3& rotation) {
  return rotation * Vec3{sphere.at_m[0], sphere.at_m[1], sphere.at_m[2]};
}

}  // namespace

bool ToolTurn::want(uint32_t axis, float angle_rad) {
  if (axis > 2 || !(__builtin_fabsf(angle_rad) <= kMaxToolTurn_rad)) return false;
  (axis == 0 ? wanted_rad.x : axis == 1 ? wanted_rad.y : wanted_rad.z) = angle_rad;
  return true;
}

void reset(ToolTouch& touch) {
  for (ProxyTouch& sphere : touch.sphere) sphere = {};
  touch.anchor_m = touch.torque_Nm = {};
  touch.penetration_m = 0;
  touch.nearest = touch.next = 0;
}

// A rotation turns at most as fast as its vector changes.
void ToolTurn::advance(float passed_s) {
  const Vec3 way_rad = wanted_rad - turn_rad;
  const float size_rad = math::length(way_rad), most_rad = kMaxToolTurn_rad_per_s * passed_s;
  if (!(size_rad > 0.0f)) return;
  turn_rad = size_rad <= most_rad ? wanted_rad : turn_rad + way_rad * (most_rad / size_rad);
  rotation = rotation_by(turn_rad);
}

ToolTick::ToolTick(const ProxyContact& contact, StoredTool spheres, const math::Mat3& rotation,
                   float size_m, ToolTouch& touch)
    : spheres_(spheres),
      touch_(touch),
      hand_m_(math::is_within(contact.position_m, servo::kMaxPosition_m) ? contact.position_m
                                                                         : touch.anchor_m),
      whole_(contact.material),
      size_m_(size_m),
      contact_(contact),
      work_left_(contact.settings.budget.work) {
  const float share = 1.0f / static_cast<float>(spheres.size());
  contact_.material = {whole_.stiffness_N_per_m * share, whole_.damping_N_s_per_m * share};
  made_.spring.reach_m = FLT_MAX;
  made_.made_at_m = hand_m_;
  touch_.steps = touch_.work = 0;
  for (uint32_t i = 0; i < spheres.size(); ++i) {
    touch_.place_m[i] = hand_m_ + arm_m(spheres[i], rotation);
    if (drift(touch_.sphere[i], touch_.place_m[i], spheres[i].radius_m))
      known_ |= 1u << i;
    else
      waiting_ |= 1u << i, ++allowed_;
  }
  choose();
}

// Of a sphere that is far: the proxy stays with the hand, within the ball of its last query.
// Result: whether that is so.
bool ToolTick::drift(ProxyTouch& touch, Vec3 to_m, float radius_m) const {
  Proxy& proxy = touch.proxy;
  if (proxy.phase != Proxy::Phase::kFree || proxy.is_loaded || proxy.is_growing) return false;
  if (!contact_.has_proxy) return false;
  const float moved_m = math::length(to_m - proxy.position_m) * kLengthUp;
  const float left_m = (proxy.free_m - moved_m) * (1.0f - 0x1p-22f);
  const float own_m = proxy.radius_m > radius_m ? proxy.radius_m : radius_m;
  if (!(left_m >= kFar * own_m)) return false;
  proxy.position_m = to_m;
  proxy.free_m = left_m;
  proxy.near.is_exact = false;
  touch.material = contact_.material;
  return true;
}

// The fixed work of the first near sphere is not of the budget.
void ToolTick::choose() {
  const uint32_t most = 1 + work_left_ / (kSphereWork + kMaxSpheres);
  if (allowed_ > most) allowed_ = most;
  if (allowed_ > 1) work_left_ -= (allowed_ - 1) * kSphereWork;
  sphere_ = touch_.next < spheres_.size() ? touch_.next : 0;
}

void ToolTick::begin(uint32_t sphere) {
  contact_.settings.radius_m = spheres_[sphere].radius_m;
  contact_.position_m = touch_.place_m[sphere];
  // Where servo has moved the spring meanwhile, the proxy goes in this tick.
  contact_.proxy_m = touch_.sphere[sphere].proxy.position_m;
  settings_ = begin_proxy_contact(contact_, touch_.sphere[sphere]);
}

// Those that the work does not allow keep their proxies, and are first in the next tick.
bool ToolTick::next() {
  for (; waiting_ != 0; sphere_ = sphere_ + 1 < spheres_.size() ? sphere_ + 1 : 0) {
    if ((waiting_ >> sphere_ & 1u) == 0) continue;
    waiting_ &= ~(1u << sphere_);
    begin(sphere_);
    if (allowed_ > 0) {
      known_ |= 1u << sphere_;
      settings_.budget.work = work_left_ / allowed_--;
      touch_.next = static_cast<uint8_t>(sphere_ + 1);
      return true;
    }
    ProxyMoved stayed = ProxyMove(settings_, size_m_, contact_.position_m, proxy()).finish();
    stayed.is_starved = true;
    end(stayed);
  }
  return false;
}

void ToolTick::end(const ProxyMoved& moved) {
  servo::LocalModel of_sphere;
  ProxyTouch& touch = touch_.sphere[sphere_];
  end_proxy_contact(contact_, moved, touch, of_sphere);
  is_uncertain_ |= of_sphere.is_uncertain;
  touch_.steps += moved.steps;
  touch_.work += moved.work;
  work_left_ -= moved.work < work_left_ ? moved.work : work_left_;
  // A sphere that is led out: its plane, for the handle. All together push by at most 1 N.
  const Vec3 arm_m = contact_.position_m - hand_m_;
  const float share = 1.0f / static_cast<float>(spheres_.size());
  for (uint32_t i = 0; i < of_sphere.plane_count; ++i) {
    servo::ContactPlane plane = of_sphere.plane[i];
    plane.offset_m -= math::dot(plane.normal, arm_m);
    plane.stiffness_N_per_m *= share;
    (void)add_plane(made_, plane);
  }
}

// What a sphere adds: its room, and where a surface holds it pull, energy and torque.
void ToolTick::add(uint32_t sphere) {
  const ProxyTouch& touch = touch_.sphere[sphere];
  const Proxy& proxy = touch.proxy;
  const bool is_free = proxy.phase == Proxy::Phase::kFree;
  float room_m = proxy.free_m - proxy.radius_m;
  if (!is_free) {
    touch_.penetration_m = math::larger(touch_.penetration_m, touch.penetration_m);
    // Of one that has no proxy and was not moved nothing is known.
    if ((known_ >> sphere & 1u) == 0) return;
    room_m = proxy.near.sign < 0 ? -proxy.near.distance_m : proxy.near.lower_m;
  }
  if (room_m < least_room_m_) least_room_m_ = room_m, touch_.nearest = static_cast<uint8_t>(sphere);
  if (!is_free) return;
  made_.spring.is_used = true;
  if (room_m < made_.spring.reach_m) made_.spring.reach_m = room_m;
  if (!proxy.is_loaded) return;
  made_.spring.is_held = true;
  const Vec3 off_m = proxy.position_m - touch_.place_m[sphere];
  const Vec3 force_N = off_m * touch.material.stiffness_N_per_m;
  pull_N_ = pull_N_ + force_N;
  twice_energy_J_ = twice_energy_J_ + math::dot(force_N, off_m);
  if (touch.penetration_m > longest_m_) longest_m_ = touch.penetration_m;
  const Vec3 arm_m = touch_.place_m[sphere] - hand_m_;
  touch_.torque_Nm = touch_.torque_Nm + math::cross(arm_m, force_N);
}

// One spring with the force F and the energy E of all: it is 2 E / F long and F^2 / 2 E stiff, at
// most as stiff as the sum (Cauchy and Schwarz). So servo counts the energy that is there, and
// neither force nor length steps where another sphere begins to touch.
void ToolTick::make_spring() {
  servo::ProxySpring& spring = made_.spring;
  const float pull_N = math::length(pull_N_);
  spring.anchor_m = hand_m_;
  spring.stiffness_N_per_m = whole_.stiffness_N_per_m;
  spring.damping_N_s_per_m = whole_.damping_N_s_per_m;
  if (!spring.is_held) return;
  const float most_m = kLongest * longest_m_;
  float length_m = twice_energy_J_ < most_m * pull_N ? twice_energy_J_ / pull_N : most_m;
  spring.stiffness_N_per_m = 0;
  if (!(length_m > 0.0f && pull_N > 0.0f)) length_m = 0;
  if (length_m > 0.0f) {
    spring.stiffness_N_per_m = pull_N / length_m;
    spring.anchor_m = hand_m_ + pull_N_ * (length_m / pull_N);
  }
  if (whole_.stiffness_N_per_m > 0.0f) {
    const float share = spring.stiffness_N_per_m / whole_.stiffness_N_per_m;
    spring.damping_N_s_per_m = whole_.damping_N_s_per_m * (share < 1.0f ? share : 1.0f);
  }
}

void ToolTick::finish(servo::LocalModel& model) {
  touch_.torque_Nm = {};
  touch_.penetration_m = 0;
  for (uint32_t i = 0; i < spheres_.size(); ++i) add(i);
  made_.spring.reach_m = math::larger(made_.spring.reach_m, 0.0f);
  make_spring();
  touch_.anchor_m = made_.spring.anchor_m;
  touch_.penetration_m =
      math::larger(touch_.penetration_m, math::length(touch_.anchor_m - hand_m_));
  model.spring = made_.spring;
  model.is_uncertain = is_uncertain_;
  for (uint32_t i = 0; i < made_.plane_count; ++i) (void)add_plane(model, made_.plane[i]);
}

}  // namespace firmtouch::scene
