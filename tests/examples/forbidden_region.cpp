// What you feel: a drill that may go anywhere, except to the nerve. A hard sleeve of 5 mm around it
// stops the tool from every side; along the sleeve it glides. Pull through it as you like: the
// force is at its limit, and the drill is still where it came from.
// Picture: pictures/forbidden_region.svg
//
// The nerve is a row of capsules, and the tool touches the nearest, through a proxy that cannot
// enter. An alarm is raised while the hand is on the wrong side.
#include "firmtouch/scene/analytic.hpp"
#include "proxy_tool.hpp"

using namespace firmtouch;

namespace {

constexpr float kSleeve_m = 0.005f, kTool_m = 0.002f;
constexpr uint32_t kPieces = 2;

// A shape made of shapes answers with the nearest of them. Its bound is the least of theirs: of the
// farther one less may be known. It has worked for both.
scene::Near nearest_of(const scene::Near& a, const scene::Near& b) {
  const bool is_b = b.sign < a.sign || (b.sign == a.sign && b.distance_m < a.distance_m);
  scene::Near best = is_b ? b : a;
  best.lower_m = a.lower_m < b.lower_m ? a.lower_m : b.lower_m;
  best.steps = a.steps + b.steps;
  best.work = a.work + b.work;
  return best;
}

struct Nerve {  // two capsules that meet at an obtuse angle
  scene::CapsuleTouched piece[kPieces];

  float size_m() const { return piece[0].size_m() + piece[1].size_m(); }
  scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const {
    return nearest_of(piece[0].near(x_m, budget, needed_m), piece[1].near(x_m, budget, needed_m));
  }
};

Nerve nerve;
scene::ProxyTouch touch;
ProxyTool tool;
bool alarm;

void tick(math::Vec3 position_m) {
  scene::ProxyContact contact = tool.begin(position_m, 2000.0f);
  contact.settings.radius_m = kTool_m;
  scene::touch_by_proxy(contact, nerve, touch, tool.model);
  tool.step(position_m);
  const math::Vec3 at_m = tool.output.proxy_m;
  const float x_m = position_m.x - at_m.x, y_m = position_m.y - at_m.y, z_m = position_m.z - at_m.z;
  alarm = x_m * x_m + y_m * y_m + z_m * z_m > 1e-8f;
}

// Capsules know their distance; a mesh that is short of work knows a bound that is far below it.
bool is_bound_of_both() {
  scene::Near a, b;
  a.sign = b.sign = 1;
  a.distance_m = 0.003f, a.lower_m = 0.002f, a.work = 5;
  b.distance_m = 0.004f, b.lower_m = 0.001f, b.work = 7;
  const scene::Near one = nearest_of(a, b), other = nearest_of(b, a);
  return is_near(one.distance_m, 0.003f, 0) && is_near(other.distance_m, 0.003f, 0) &&
         is_near(one.lower_m, 0.001f, 0) && is_near(other.lower_m, 0.001f, 0) && one.work == 12;
}

// The proxy is where the force pulls the hand to: never nearer to the nerve than the tool's radius.
bool is_outside() {
  const scene::Near near = nerve.near(tool.output.proxy_m, {}, 0);
  return near.sign > 0 && near.distance_m > 0.999f * kTool_m;
}

}  // namespace

int main() {
  nerve.piece[0] = {{{-0.04f, 0, 0}, {0, 0, 0}}, kSleeve_m};
  nerve.piece[1] = {{{0, 0, 0}, {0.03f, 0.02f, 0}}, kSleeve_m};
  bool is_right = is_bound_of_both();
  // Down to it from 20 mm above, at 20 mm/s, and on to 12 mm below.
  for (int i = 1000; i >= -600; --i) {
    const float height_m = 0.00002f * static_cast<float>(i);
    tick({-0.02f, 0, height_m});
    const float depth_m = kSleeve_m + kTool_m - height_m;
    is_right &= is_outside() && (depth_m < 0.00009f ? !alarm : depth_m < 0.00011f || alarm);
    const float spring_N = depth_m > 0 ? 2000.0f * depth_m : 0;
    if (depth_m < 0.0039f)
      is_right &= is_between(tool.output.force_N.z, spring_N - 0.02f, spring_N + 0.02f);
  }
  is_right &= is_between(tool.output.proxy_m.z, 0.00699f, 0.00701f);  // where it came from
  is_right &= is_between(tool.output.force_N.z, 7.9f, 8.0f);          // at the limit
  // 3 mm deep along the nerve, round its bend, to the other piece: no step, and never inside.
  for (int i = -600; i <= 200; ++i) tick({-0.02f, 0, 0.00002f * static_cast<float>(i)});
  for (int i = -1000; i <= 1250; ++i) {
    const float along_m = 0.00002f * static_cast<float>(i);
    tick({along_m, along_m > 0 ? along_m * 2 / 3 : 0, 0.004f});
    is_right &= is_outside() && is_between(tool.output.force_N.z, 5.9f, 6.1f) && alarm;
  }
  // Up and away: free.
  for (int i = 200; i <= 1000; ++i) tick({0.025f, 0.0166f, 0.00002f * static_cast<float>(i)});
  is_right &= is_between(tool.output.force_N.z, 0, 0) && !alarm;
  return is_right && tool.output.faults == 0 ? 0 : 1;
}
