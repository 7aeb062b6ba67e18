// What you feel: a table top. Its left half is ice, where the tool glides. Its right half is
// rubber, where it sticks, gives way, and drags.
// Picture: pictures/friction.svg
//
// Contact through a proxy: the ball of the tool as it would be if it could not enter the table. The
// spring from the hand to the proxy is all the force there is, friction included.
#include "firmtouch/scene/analytic.hpp"
#include "proxy_tool.hpp"

using namespace firmtouch;

namespace {

constexpr float kRadius_m = 0.003f;

scene::BoxTouched table;  // its top is at height 0
scene::ProxyTouch touch;
ProxyTool tool;

math::Vec3 tick(float x_m, float height_m) {
  const math::Vec3 position_m{x_m, 0, height_m};
  scene::ProxyContact contact = tool.begin(position_m, 1000.0f);
  contact.settings.radius_m = kRadius_m;
  contact.settings.friction_static = x_m < 0 ? 0.0f : 0.8f;  // of the force across the top
  contact.settings.friction_dynamic = x_m < 0 ? 0.0f : 0.5f;
  scene::touch_by_proxy(contact, table, touch, tool.model);
  return tool.step(position_m);
}

}  // namespace

int main() {
  table.half_m = {0.1f, 0.1f, 0.02f};
  table.pose.translation_m = {0, 0, -0.02f};
  bool is_right = true;
  // Down onto the ice, 3 mm deep.
  for (uint32_t i = 0; i <= 300; ++i) tick(-0.05f, 0.006f - 0.00002f * static_cast<float>(i));
  // Across both halves at 20 mm/s.
  float stuck_N = 0;
  for (uint32_t i = 0; i <= 4500; ++i) {
    const float x_m = -0.05f + 0.00002f * static_cast<float>(i);
    const math::Vec3 force_N = tick(x_m, 0.0f);
    is_right &= is_between(force_N.z, 2.99f, 3.01f);
    if (x_m < -0.001f) is_right &= is_between(force_N.x, 0, 0);
    if (-force_N.x > stuck_N) stuck_N = -force_N.x;
    if (x_m > 0.01f) is_right &= is_between(-force_N.x, 1.49f, 1.51f);  // 0.5 of 3 N
  }
  is_right &= is_between(stuck_N, 2.39f, 2.42f);  // 0.8 of 3 N, before it gave way
  return is_right && tool.output.faults == 0 ? 0 : 1;
}
