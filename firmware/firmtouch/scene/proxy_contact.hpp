#pragma once
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::scene {

/// Input of a tick of contact through a proxy.
struct ProxyContact {
  ProxySettings settings;
  Material material;
  math::Vec3 position_m;  // of the tool, device frame
  // Where servo holds the proxy; none: contact begins anew.
  math::Vec3 proxy_m;
  bool has_proxy = false;
  bool is_on = false;                 // the motors; without them a loaded proxy is let go
  float passed_s = 0;                 // since the last model
  float friction_speed_mps = 0.001f;  // of a slide at which friction is mostly dynamic
  float friction_viscous_N_s_per_m = 0;
};

/// State of a (tool, object) pair from tick to tick. The caller owns one a pair.
struct ProxyTouch {
  Proxy proxy;
  Material material;        // in use; changes only without load
  float inside_s = 0;       // since the tool is led out
  float penetration_m = 0;  // hand to proxy
  ProxyMoved moved;         // in the last tick
};

static_assert(sizeof(ProxyTouch) <= 512);

/// Before the proxy moves: takes servo's place of it, and settings that may change.
/// Result: the settings of the move.
ProxySettings begin_proxy_contact(const ProxyContact& contact, ProxyTouch& touch);
/// After it: adds contact to the model.
void end_proxy_contact(const ProxyContact& contact, const ProxyMoved& moved, ProxyTouch& touch,
                       servo::LocalModel& model);

/// Contact of a sphere with a shape (scene/touched.hpp) through a proxy. Radius and material take
/// effect without load: they make no step of the force and give the hand no energy. A tool that
/// begins inside is led out by the nearest way, damped, by at most 1 N. The model is uncertain
/// where the visits ran out before the proxy could be certified at its place.
/// Bounds: scene/proxy.hpp; re-entrant for different touches.
template <class Shape>
void touch_by_proxy(const ProxyContact& contact, Shape& shape, ProxyTouch& touch,
                    servo::LocalModel& model) {
  const ProxySettings settings = begin_proxy_contact(contact, touch);
  const ProxyMoved moved = move_proxy(settings, contact.position_m, shape, touch.proxy);
  end_proxy_contact(contact, moved, touch, model);
}

}  // namespace firmtouch::scene
