// Where a proxy stands whose hand stands: no free way leads nearer.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "scene/objects_rig.hpp"
#include "surface/make/make_part.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_test;

namespace {

double wide(float a) { return static_cast<double>(a); }

// Whether a step of 0.3 radii that goes at least a fifth of itself towards the hand ends as clear
// of all triangles as a tool is placed. A surface between two such places would be too near.
bool can_go_on(const ProxyRig& rig, Vec3 hand_m, Draw& draw) {
  const scene::Proxy& proxy = rig.proxy;
  const Vec3 way_m = hand_m - proxy.position_m;
  const float step_m = 0.3f * proxy.radius_m, lag_m = math::length(way_m);
  if (!(lag_m > 4.0f * step_m)) return false;
  const double clear_m = wide(proxy.radius_m) + 1.1e-6 * wide(rig.view.head().diagonal_m);
  for (int k = 0; k < 60; ++k) {
    const Vec3 any = draw.within(1);
    const float size = math::length(any), towards = math::dot(any, way_m) / lag_m;
    if (size > 1.0f || towards < 0.2f * size) continue;
    if (rig.truth_m(proxy.position_m + any * (step_m / size)) >= clear_m) return true;
  }
  return false;
}

// A half-space that does not know on which side of it a point is.
struct Unsure {
  scene::PlaneTouched plane{{}, {0, 0, 1}};

  float size_m() const { return plane.size_m(); }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) const {
    scene::Near near = plane.near(x_m, budget, needed_m);
    near.sign = 0;
    return near;
  }
};

}  // namespace

// Behind a plane its normal leads away from it.
TEST(Proxy_BehindAPlaneOfUnknownSide_SearchStaysNear) {
  Unsure shape;
  scene::Proxy proxy;
  for (uint32_t tick = 0; tick < 40; ++tick) {
    (void)scene::move_proxy({}, {0, 0, -0.1f}, shape, proxy);
    CHECK_LE(math::length(proxy.position_m), 0.2f);
  }
}

// Each plane beside a triangle leaves more of the way than the one across the line to it, but two
// of them held the tool where both triangles were far away.
TEST(Proxy_HandThatStands_NoFreeWayLeadsNearer) {
  const tools::Surface shapes[] = {two_walls(),
                                   groove(),
                                   slot(0.004f),
                                   plate(0.01f),
                                   tube(0.006f, 0.02f, 24),
                                   tools::make_part(1, 500)};
  uint32_t seed = 0, standing = 0, held = 0;
  for (const tools::Surface& surface : shapes)
    for (const float radius_m : {0.0001f, 0.0005f, 0.003f}) {
      Draw draw(++seed);
      ProxyRig rig(surface);
      rig.settings.radius_m = radius_m;
      rig.settings.budget.work = 1u << 20;
      Broken broken;
      Vec3 hand_m{0.03f, 0.02f, 0.07f};
      for (uint32_t leg = 0; leg < 60; ++leg) {
        const uint32_t ticks = 20 + draw.below(60), corners = rig.view.vertices().size();
        const Vec3 to_m = rig.view.vertex(draw.below(corners)) + draw.within(0.004);
        const Vec3 step_m = (to_m - hand_m) * (1.0f / static_cast<float>(ticks));
        for (uint32_t tick = 0; tick < ticks + 40; ++tick) {
          if (tick < ticks) hand_m = hand_m + step_m;
          rig.tick(hand_m, broken);
        }
        if (rig.proxy.phase != scene::Proxy::Phase::kFree || !rig.proxy.is_loaded) continue;
        if (rig.proxy.is_growing) continue;
        ++standing;
        held += can_go_on(rig, hand_m, draw) ? 1u : 0u;
      }
      CHECK_EQ(broken.crossings, 0u);
    }
  CHECK_LE(400u, standing);
  CHECK_EQ(held, 0u);
}
