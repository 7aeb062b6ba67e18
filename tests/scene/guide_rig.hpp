#pragma once
// A guide along an L, and its force on a tool; runs on the controller too.

#include "curve/small_curve.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"

namespace firmtouch::scene_test {

// An L in the x-y plane: 0.2 m along x, then 0.1 m along y; lifted by 0.5 m in the device's frame.
constexpr curve::Sample kL[] = {{0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.1f, 0}};

inline curve_test::SmallCurve g_small{kL};  // too large for a controller's stack

struct Rig {
  curve::View view = g_small.view();
  scene::CurveGuide guide;
  scene::CurveGuideTouch touch;
  servo::LocalModel model;
  Rig() {
    guide.curve = &view;
    guide.pose.translation_m = {0, 0, 0.5f};
    guide.material = {100.0f, 0.0f};
    guide.snap_m = 0.01f;
    guide.release_m = 0.03f;
  }
  math::Vec3 force_N(math::Vec3 p_m) {
    scene::begin_model(model, p_m, 0, 3);
    scene::follow_curve(guide, p_m, query::kUnlimited, touch, model);
    return servo::evaluate(model, p_m, {});
  }
};

inline bool is_near(math::Vec3 a, math::Vec3 b, float slack = 2e-5f) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z <= slack * slack;
}

}  // namespace firmtouch::scene_test
