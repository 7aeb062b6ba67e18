#pragma once
#include "firmtouch/scene/proxy_contact.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

namespace firmtouch {

/// A tool that touches through a proxy, and the servo step of wall.cpp. Servo holds the proxy from
/// tick to tick.
struct ProxyTool {
  servo::Settings settings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                           /*ramp_in_s*/ 0.0f, /*tick_period_s*/ 0.001f};
  servo::State state;
  servo::LocalModel model;
  servo::StepOutput output;
  uint32_t now = 0;

  /// Begins the model of a tick. Result: the contact that is added to it.
  scene::ProxyContact begin(math::Vec3 hand_m, float stiffness_N_per_m) {
    scene::begin_model(model, hand_m, now, /*age_ticks*/ 2);
    scene::ProxyContact contact;
    contact.material.stiffness_N_per_m = stiffness_N_per_m;
    contact.position_m = hand_m;
    contact.proxy_m = output.proxy_m;
    contact.has_proxy = state.has_proxy;
    contact.is_on = true;
    contact.passed_s = settings.tick_period_s;
    return contact;
  }
  /// Result: the force of the model.
  math::Vec3 step(math::Vec3 hand_m) {
    const servo::StepInput input{hand_m, /*velocity_mps*/ {}, now++, /*enable*/ true};
    output = servo::step(state, settings, model, input);
    show(hand_m, output.force_N);
    return output.force_N;
  }
};

}  // namespace firmtouch
