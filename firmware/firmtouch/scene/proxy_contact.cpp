#include "firmtouch/scene/proxy_contact.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A tool that begins inside: largest force, how fast it grows, and how long it may take.
constexpr float kLeadOut_N = 1.0f;
constexpr float kLeadOutRise_s = 1.0f;
constexpr float kNoWayOut_s = 10.0f;
bool is_stiff(const ProxyTouch& touch) { return touch.material.stiffness_N_per_m > 0.0f; }

// A softer surface takes energy from the hand's spring and gives none: under load it acts slowly
// enough to make no step of the force. Anything else waits until there is no load.
void use_material(const ProxyContact& contact, ProxyTouch& touch) {
  if (!touch.proxy.is_loaded) {
    touch.material = contact.material;
    return;
  }
  constexpr float kSoften_N_per_s = 20.0f;
  float& stiffness = touch.material.stiffness_N_per_m;
  const float softer = stiffness - kSoften_N_per_s * contact.passed_s / touch.penetration_m;
  if (contact.material.stiffness_N_per_m < stiffness)
    stiffness = math::larger(softer, contact.material.stiffness_N_per_m);
}

// `was_m`: how deep it was.
void lead_out(const ProxyContact& contact, float was_m, ProxyTouch& touch,
              servo::LocalModel& model) {
  const Nearness& near = touch.proxy.near;
  touch.inside_s = touch.inside_s + contact.passed_s;
  if (!(touch.inside_s < kNoWayOut_s)) {
    touch.inside_s = kNoWayOut_s;
    model.is_uncertain = true;
    return;
  }
  if (near.sign == 0 || !math::is_about_unit(near.outward)) return;
  const float rise = touch.inside_s < kLeadOutRise_s ? touch.inside_s / kLeadOutRise_s : 1.0f;
  const float depth_m = near.distance_m, out_m = math::larger(was_m - depth_m, 0.0f);
  float push_N = math::smaller(touch.material.stiffness_N_per_m * depth_m, kLeadOut_N);
  // Its way out is damped; against a hand that goes farther in a damper would push harder.
  push_N = push_N - touch.material.damping_N_s_per_m * out_m / contact.passed_s;
  servo::ContactPlane plane;
  plane.normal = near.outward;
  plane.offset_m = math::dot(near.outward, contact.position_m) + depth_m;
  if (push_N > 0.0f) plane.stiffness_N_per_m = push_N * rise / depth_m;
  if (math::is_finite(plane.offset_m) && add_plane(model, plane)) touch.penetration_m = depth_m;
}

}  // namespace

ProxySettings begin_proxy_contact(const ProxyContact& contact, ProxyTouch& touch) {
  Proxy& proxy = touch.proxy;
  const bool is_free = proxy.phase == Proxy::Phase::kFree;
  // Without motors or stiffness a hand goes in: its proxy would wait for it at the surface.
  const bool is_on = contact.is_on && is_stiff(touch);
  if (is_free && (!contact.has_proxy || (proxy.is_loaded && !is_on))) {
    proxy.phase = Proxy::Phase::kUnknown;
    proxy.is_loaded = false;
  } else if (is_free && !proxy.is_loaded) {
    // At two rates servo has moved it within the ball that was certified. Under load it stands: the
    // end of the spring that servo holds may be elsewhere.
    const Vec3 moved_m = contact.proxy_m - proxy.position_m;
    if (!(math::dot(moved_m, moved_m) <= 0.0f)) {
      const float left_m = proxy.free_m - math::length(moved_m) * (1.0f + 0x1p-20f);
      proxy.position_m = contact.proxy_m;
      proxy.free_m = left_m;
      if (!(left_m > 0.0f)) proxy.phase = Proxy::Phase::kUnknown;
    }
  }
  use_material(contact, touch);
  if (proxy.phase != Proxy::Phase::kInside || !is_on) touch.inside_s = 0;
  // Slides are averaged for so long: at 10 mm/s an encoder of 10 um counts once in 1 ms.
  constexpr float kSlideMean_s = 0.008f;
  // How fast a sphere that began too near to a surface grows to its size, with as much force.
  constexpr float kGrowth_mps = 0.005f;
  ProxySettings settings = contact.settings;
  settings.friction_slide_m = contact.friction_speed_mps * contact.passed_s;
  const float viscous = contact.friction_viscous_N_s_per_m;
  const float spring_N_s_per_m = touch.material.stiffness_N_per_m * contact.passed_s;
  if (viscous > 0.0f) settings.viscous_share = viscous / (viscous + spring_N_s_per_m);
  settings.slide_share = contact.passed_s / (contact.passed_s + kSlideMean_s);
  if (contact.is_on && touch.material.stiffness_N_per_m * touch.penetration_m < kLeadOut_N)
    settings.growth_m = kGrowth_mps * contact.passed_s;
  return settings;
}

void end_proxy_contact(const ProxyContact& contact, const ProxyMoved& moved, ProxyTouch& touch,
                       servo::LocalModel& model) {
  const Proxy& proxy = touch.proxy;
  touch.moved = moved;
  const float was_m = touch.penetration_m;
  touch.penetration_m = 0;
  if (proxy.phase == Proxy::Phase::kInside) return lead_out(contact, was_m, touch, model);
  model.is_uncertain = moved.is_starved && is_stiff(touch);
  if (proxy.phase != Proxy::Phase::kFree) return;
  servo::ProxySpring& spring = model.spring;
  spring.is_used = true;
  spring.is_held = proxy.is_loaded;
  spring.anchor_m = proxy.position_m;
  const float reach_m = proxy.free_m - proxy.radius_m;
  spring.reach_m = math::larger(reach_m, 0.0f);
  spring.stiffness_N_per_m = touch.material.stiffness_N_per_m;
  spring.damping_N_s_per_m = touch.material.damping_N_s_per_m;
  if (proxy.is_loaded) touch.penetration_m = math::length(proxy.position_m - contact.position_m);
}

}  // namespace firmtouch::scene
