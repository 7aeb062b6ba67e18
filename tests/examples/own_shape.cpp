// What you feel: a hard rubber ring. It is round from every side, and a finger fits through it.
// Picture: pictures/own_shape.svg
//
// A shape of your own is a struct that answers one query: what is near a point? The proxy does the
// rest: the ball of the tool never enters the ring, and a spring ties the hand to it.
#include "firmtouch/math/elementary.hpp"
#include "proxy_tool.hpp"

using namespace firmtouch;

namespace {

// About the z axis: all points within tube_m of a circle of radius ring_m.
struct Torus {
  float ring_m, tube_m;

  float size_m() const { return 2.0f * (ring_m + tube_m); }
  scene::Near near(math::Vec3 x_m, query::Budget, float) const {
    const float around_m = math::safe_square_root(x_m.x * x_m.x + x_m.y * x_m.y);
    scene::Near near;
    if (!(around_m > 1e-6f)) {  // on the axis, where every point of the circle is as near
      near.lower_m = 0.999f * (ring_m - tube_m);
      near.distance_m = ring_m;
      near.sign = 1;
      return near;
    }
    // The nearest point of the circle. The tube about it holds a ball of radius tube_m there: a
    // convex part of the shape, which is what a feature has to be.
    const float scale = ring_m / around_m;
    const math::Vec3 core_m{x_m.x * scale, x_m.y * scale, 0};
    const float x = x_m.x - core_m.x, y = x_m.y - core_m.y, z = x_m.z;
    const float from_core_m = math::safe_square_root(x * x + y * y + z * z);
    const float signed_m = from_core_m - tube_m;
    near.feature.kind = scene::Feature::Kind::kBall;
    near.feature.corner[0] = core_m;
    near.feature.corner[1].x = tube_m;
    near.distance_m = signed_m < 0 ? -signed_m : signed_m;
    // No point is nearer than this: the distance, less what rounding may have added.
    const float lower_m = near.distance_m - 2e-6f * size_m();
    near.lower_m = lower_m > 0 ? lower_m : 0;
    near.sign = signed_m < 0 ? -1 : 1;
    near.has_inside = near.is_exact = true;
    near.outward = from_core_m > 0 ? math::Vec3{x / from_core_m, y / from_core_m, z / from_core_m}
                                   : math::Vec3{0, 0, 1};
    return near;
  }
};

Torus torus{/*ring_m*/ 0.03f, /*tube_m*/ 0.008f};
scene::ProxyTouch touch;
ProxyTool tool;

math::Vec3 tick(math::Vec3 position_m) {
  scene::ProxyContact contact = tool.begin(position_m, 800.0f);
  contact.settings.radius_m = 0.003f;
  scene::touch_by_proxy(contact, torus, touch, tool.model);
  return tool.step(position_m);
}

}  // namespace

int main() {
  bool is_right = true;
  math::Vec3 force_N;
  // Through the ring along its axis: nothing is there.
  for (int i = 2000; i >= -2000; --i) {
    force_N = tick({0, 0, 0.00002f * static_cast<float>(i)});
    is_right &= is_near(force_N.x, 0) && is_near(force_N.y, 0) && is_near(force_N.z, 0);
  }
  // Outwards below it, and up against its underside, 3 mm deep: 2.4 N down.
  for (int i = 0; i <= 1500; ++i) tick({0.00002f * static_cast<float>(i), 0, -0.04f});
  for (int i = 2000; i >= 400; --i) force_N = tick({0.03f, 0, -0.00002f * static_cast<float>(i)});
  is_right &= is_near(force_N.z, -2.4f) && is_near(force_N.x, 0);
  // On through the whole ring and out above it: the proxy has stayed below.
  for (int i = 400; i >= -1000; --i) {
    tick({0.03f, 0, -0.00002f * static_cast<float>(i)});
    const math::Vec3 at_m = tool.output.proxy_m;
    is_right &= torus.near(at_m, {}, 0).sign > 0 && torus.near(at_m, {}, 0).distance_m > 0.0029f;
  }
  is_right &= tool.output.proxy_m.z < 0 && tool.output.force_N.z < -7.9f;  // at the limit
  return is_right && tool.output.faults == 0 ? 0 : 1;
}
