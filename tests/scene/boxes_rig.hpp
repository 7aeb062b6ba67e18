#pragma once
// Several objects in closed form, and a tool with its servo among them.
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/objects.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"

namespace firmtouch::scene_boxes {

using math::Vec3;

inline scene::Object object_at(Vec3 place_m, Vec3 velocity_mps = {}) {
  scene::Object object;
  object.pose.translation_m = place_m;
  object.twist.velocity_mps = velocity_mps;
  return object;
}

// Boxes of 0.2 x 0.2 x 0.02 m, or all that is below their tops, or balls, and a tool with its
// servo.
struct Boxes {
  static constexpr float kRadius_m = 0.003f, kTick_s = 0.001f;
  scene::SphereTouched ball{{}, 0.02f};
  scene::BoxTouched box{{}, {0.1f, 0.1f, 0.01f}};
  scene::PlaneTouched top{{0, 0, 0.01f}, {0, 0, 1}};
  scene::Object object[scene::kMaxObjects];
  scene::ObjectPair pair[scene::kMaxObjects];
  scene::ObjectsTouch touch;
  scene::ProxyContact contact;
  servo::LocalModel model;
  servo::State state;
  servo::Settings limits{8.0f, 1e5f, 0.0f, kTick_s, {1.0f, 0.0f}};
  bool is_plane = false, is_ball = false;
  servo::StepOutput output;
  uint32_t count = 0, now = 0, queries = 0;

  Boxes() {
    contact.settings.radius_m = kRadius_m;
    contact.material.stiffness_N_per_m = 1000;
    contact.is_on = true;
    contact.passed_s = kTick_s;
  }
  scene::Object& add(const scene::Object& wanted) {
    CHECK(scene::set_object(wanted, object[count]) == scene::ObjectProblem::kNone);
    pair[count].pose = object[count].pose;
    return object[count++];
  }
  scene::Near near(uint32_t, Vec3 x_m, query::Budget budget, float needed_m) {
    ++queries;
    if (is_ball) return ball.near(x_m, budget, needed_m);
    return is_plane ? top.near(x_m, budget, needed_m) : box.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t, const scene::Way& way, query::Budget budget, uint32_t& work) const {
    if (is_ball) return ball.free_part(way, budget, work);
    return is_plane ? top.free_part(way, budget, work) : box.free_part(way, budget, work);
  }
  float size_m() const { return 0.5f; }

  void tick(Vec3 hand_m, Vec3 velocity_mps = {}) {
    for (uint32_t i = 0; i < count; ++i) scene::advance(object[i], kTick_s);
    contact.position_m = hand_m;
    contact.proxy_m = output.proxy_m;
    contact.has_proxy = state.has_proxy;
    scene::begin_model(model, hand_m, now, 2);
    scene::touch_objects(contact, {object, pair, count}, *this, touch, model);
    servo::StepInput input;
    input.position_m = hand_m;
    input.velocity_mps = velocity_mps;
    input.tick = now++;
    input.enable = true;
    output = servo::step(state, limits, model, input);
  }
};

inline bool is_near(float a, float b, float by) { return a - b <= by && b - a <= by; }

}  // namespace firmtouch::scene_boxes
