// A proxy on spline surfaces: its theorems against a torus in closed form.
#include <cmath>
#include <limits>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "firmtouch/scene/spline_touched.hpp"
#include "scene/spline_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;     // NOLINT: a test file
using namespace spline_touch;  // NOLINT

namespace {

double wide(float a) { return static_cast<double>(a); }

// Below 0 inside.
double to_torus_m(math::Vec3 p) {
  return std::hypot(std::hypot(wide(p.x), wide(p.y)) - 0.05, wide(p.z)) - 0.02;
}

double between_m(math::Vec3 a, math::Vec3 b) {
  return std::hypot(wide(a.x) - wide(b.x), wide(a.y) - wide(b.y), wide(a.z) - wide(b.z));
}

struct Drag {
  const Surface surface = torus();
  scene::SplineObject object;
  spline::Hint hint;
  scene::SplineTouched shape{object, hint};
  scene::Proxy proxy;
  scene::ProxySettings settings;
  uint32_t held = 0, nearer = 0, through = 0, longer = 0;

  explicit Drag(float friction) {
    object.surface = &surface.view;
    settings.radius_m = kRadius_m;
    settings.friction_static = settings.friction_dynamic = friction;
  }
  void tick(math::Vec3 hand_m) {
    const math::Vec3 from_m = proxy.position_m;
    const bool was_free = proxy.phase == scene::Proxy::Phase::kFree;
    const scene::ProxyMoved moved = scene::move_proxy(settings, hand_m, shape, proxy);
    CHECK_LE(moved.queries, scene::kMaxQueries);
    if (!was_free) return;
    const double size_m = wide(shape.size_m()), off_m = to_torus_m(proxy.position_m);
    nearer += std::fabs(off_m) < wide(proxy.radius_m) - 2e-6 * size_m;
    through += (off_m > 0) != (to_torus_m(from_m) > 0);
    const double longer_m = between_m(proxy.position_m, hand_m) - between_m(from_m, hand_m);
    longer += longer_m > (settings.friction_static > 0 ? 0 : 1e-7 * size_m);
    held += proxy.is_loaded;
  }
};

}  // namespace

TEST(SplineProxy_AnyHandAndFriction_KeepsTheTheorems) {
  for (const float friction : {0.0f, 0.05f, 0.5f, 2.0f}) {
    const float bends[] = {0, std::numeric_limits<float>::quiet_NaN(), 1e30f, -1e3f, 300};
    Drag drag(friction);
    tools::Random random(5);
    math::Vec3 hand_m{0, 0, 0.06f}, step_m;
    for (int i = 0; i < 20000; ++i) {
      if (i % 40 == 0) {
        const double most_m = i % 200 == 0 ? 0.01 : 0.001;
        const auto any_m = [&] { return static_cast<float>(random.between(-most_m, most_m)); };
        step_m = {any_m(), any_m(), any_m()};
      }
      hand_m = hand_m + step_m;
      if (math::length(hand_m) > 0.09f) step_m = hand_m * -0.01f;
      if (i % 500 == 0) drag.settings.budget.work = i % 1000 == 0 ? 640 : 40;
      if (i % 7 == 0) drag.proxy.bend_per_m = bends[i / 7 % 5];
      drag.tick(hand_m);
    }
    CHECK_LT(4000u, drag.held);
    CHECK_EQ(drag.nearer, 0u);
    CHECK_EQ(drag.through, 0u);
    CHECK_EQ(drag.longer, 0u);
  }
}

// A hand 6 mm behind the surface that goes 0.8 mm a tick: a plane leaves up to a third of the way.
TEST(SplineProxy_FastHandBehindATorus_EndsWhereFrictionBearsThePull) {
  for (const float friction : {0.0f, 0.1f, 0.3f}) {
    Drag drag(friction);
    uint32_t queries = 0, solved = 0, ticks = 0;
    double most = 0, least = 1;
    for (int i = 0; i < 2000; ++i) {
      const double turn = 0.01 * i, tilt = 0.02 * i, deep_m = i < 100 ? 6e-5 * i - 1e-4 : 0.006;
      const double away_m = 0.02 + wide(kRadius_m) - deep_m, out_m = 0.05 + away_m * std::cos(tilt);
      const math::Vec3 hand_m =
          tools::to_vec3({out_m * std::cos(turn), out_m * std::sin(turn), away_m * std::sin(tilt)});
      const scene::ProxyMoved moved =
          scene::move_proxy(drag.settings, hand_m, drag.shape, drag.proxy);
      if (i < 200) continue;
      ++ticks, queries += moved.queries, solved += moved.is_optimal;
      const math::Vec3 at_m = drag.proxy.position_m;
      const double radial_m = std::hypot(wide(at_m.x), wide(at_m.y)), in = 1 - 0.05 / radial_m;
      const double x_m = wide(at_m.x) * in, y_m = wide(at_m.y) * in, z_m = wide(at_m.z);
      const math::Vec3 pull_m = at_m - hand_m;
      const double across_m = (wide(pull_m.x) * x_m + wide(pull_m.y) * y_m + wide(pull_m.z) * z_m) /
                              std::hypot(x_m, y_m, z_m);
      const double part = between_m(at_m, hand_m) / across_m;
      const double ratio = std::sqrt(std::fmax(part * part - 1, 0));
      most = std::fmax(most, ratio), least = std::fmin(least, ratio);
    }
    firmtouch::test::note("friction, percent", static_cast<uint32_t>(100 * friction + 0.5f));
    CHECK_LE(most, 1.003 * wide(friction) + 0.003);
    CHECK_LE(0.97 * wide(friction), least);
    if (friction < 0.01f) continue;  // the last micrometre is the closest point's
    CHECK_LE(0.95 * ticks, 1.0 * solved);
    CHECK_LE(queries, 3 * ticks);
  }
}

// A ball of 20 mm that a sheet cuts.
struct CutBall {
  scene::SphereTouched ball{{}, 0.02f};
  float size_m() const { return 0.07f; }
  scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const {
    const scene::Near of_ball = ball.near(x_m, budget, needed_m);
    const float off_m = std::fabs(x_m.x);
    if (of_ball.distance_m < off_m) return of_ball;
    scene::Near near;
    near.lower_m = off_m * (1 - 1e-6f), near.distance_m = off_m;
    near.outward = {x_m.x < 0 ? -1.0f : 1.0f, 0, 0};
    near.is_exact = true;
    near.feature.kind = scene::Feature::Kind::kBall;
    near.feature.corner[0] = {0, x_m.y, x_m.z};
    return near;
  }
};

// The bend of the ball would lead over the sheet, to where the tool is clear again.
TEST(SplineProxy_WayThatABendMakesLonger_CrossesNothing) {
  for (uint32_t phase = 0; phase < 40; ++phase) {
    const float step_m = 0.00015f + 0.000003f * static_cast<float>(phase);
    scene::Proxy proxy;
    scene::ProxySettings settings;
    settings.radius_m = 0.0003f;
    settings.friction_static = settings.friction_dynamic = 0.2f;
    CutBall shape;
    float most_m = -1;
    for (uint32_t i = 0; i < 400; ++i) {
      const float x_m = -0.01f + step_m * static_cast<float>(i);
      const math::Vec3 hand_m{x_m < 0.01f ? x_m : 0.01f, 0, i < 4 ? 0.021f : 0.005f};
      (void)scene::move_proxy(settings, hand_m, shape, proxy);
      most_m = std::fmax(most_m, proxy.position_m.x);
    }
    CHECK_LE(most_m, -0.00029f);
    CHECK_LE(-0.00031f, most_m);
  }
}

// The normal that a query finds is off by rounding: on a flat face that is no bend.
TEST(SplineProxy_FastHandBehindAFlatFace_FollowsIt) {
  const Surface surface = sheet();
  scene::SplineObject object;
  object.surface = &surface.view;
  spline::Hint hint;
  scene::SplineTouched shape{object, hint};
  scene::Proxy proxy;
  scene::ProxySettings settings;
  settings.radius_m = kRadius_m;
  settings.budget.work = 640;
  uint32_t queries = 0, solved = 0;
  for (int i = 0; i < 2200; ++i) {
    const double high_m = i < 200 ? 0.005 - 2e-5 * i : 0.001, turn = 0.025 * i;
    const math::Vec3 hand_m =
        tools::to_vec3({0.02 * std::cos(turn), 0.02 * std::sin(turn), high_m});
    const scene::ProxyMoved moved = scene::move_proxy(settings, hand_m, shape, proxy);
    if (i < 200) continue;
    queries += moved.queries, solved += moved.is_optimal;
  }
  CHECK_LE(queries, 2600u);
  CHECK_LE(1900u, solved);
}

TEST(SplineProxy_HostileHands_StaysFiniteAndOutside) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              most = std::numeric_limits<float>::max();
  Drag drag(0.3f);
  const math::Vec3 hands[] = {{0, 0, 0.06f},  {0, 0.05f, 0.02f}, {nan, 0, 0}, {most, 0, -most},
                              {0, 0.05f, 0},  {1e6f, 0, 0},      {0, nan, 0}, {0, -0.05f, 0.01f},
                              {0, 0, 1e-30f}, {-0.05f, 0, 0}};
  for (int i = 0; i < 2000; ++i) {
    const math::Vec3 hand_m = hands[i * 7 % 10];
    (void)scene::move_proxy(drag.settings, hand_m, drag.shape, drag.proxy);
    CHECK(math::is_finite(drag.proxy.position_m));
    if (drag.proxy.phase == scene::Proxy::Phase::kFree)
      CHECK_LE(0.999 * wide(drag.proxy.radius_m), to_torus_m(drag.proxy.position_m));
  }
}

// On the axis whole rings are equally near. That none is as near as the radius takes little work;
// which point is nearest takes more than there is, also of a tool that all but fills the hole.
TEST(SplineProxy_AlongTheAxisOfATorus_IsNotStuckWithLittleWork) {
  for (const float radius_m : {0.003f, 0.025f}) {
    Drag drag(0);
    drag.settings.radius_m = radius_m;
    drag.settings.budget.work = 240;
    uint32_t uncertain = 0, most = 0;
    for (int i = 0; i <= 1000; ++i) {
      const math::Vec3 hand_m = tools::to_vec3({0, 0, 0.08 - 1.6e-4 * i});
      const bool is_starved =
          scene::move_proxy(drag.settings, hand_m, drag.shape, drag.proxy).is_starved;
      uncertain = is_starved ? uncertain + 1 : 0;
      most = uncertain > most ? uncertain : most;
    }
    CHECK_LT(most, 10u);
    CHECK_LE(wide(math::length(drag.proxy.position_m - math::Vec3{0, 0, -0.08f})), 1e-6);
  }
}

// Beyond an edge no normal gives the side where the tool begins.
TEST(SplineProxy_BeginsBesideAnyEdge_IsCertainWithinTenTicks) {
  for (const float lean : {0.0f, 0.5f, 3.0f, 10.0f}) {  // edges of 90, 63, 18 and 6 degrees
    const Surface surface = cube(0, wide(lean));
    scene::SplineObject object;
    object.surface = &surface.view;
    object.is_closed = true;
    tools::Random random(11);
    uint32_t begun = 0, unknown = 0, wrong = 0;
    for (int i = 0; i < 3000; ++i) {
      const auto any_m = [&] { return static_cast<float>(random.between(-0.08, 0.08)); };
      const math::Vec3 hand_m{any_m() * (1.0f + 0.25f * lean), any_m(), any_m()};
      const float most_m =
          std::fmax(std::fmax(std::fabs(hand_m.x - lean * hand_m.y), std::fabs(hand_m.y)),
                    std::fabs(hand_m.z));
      if (std::fabs(most_m - 0.02f) < 0.001f * (1.0f + lean)) continue;  // the tool touches
      spline::Hint hint;
      scene::SplineTouched shape{object, hint};
      scene::Proxy proxy;
      scene::ProxySettings settings;
      settings.radius_m = 0.0005f;
      settings.budget.work = 465;  // as by default in a tick
      ++begun;
      for (int tick = 0; tick < 10 && proxy.phase == scene::Proxy::Phase::kUnknown; ++tick)
        scene::move_proxy(settings, hand_m, shape, proxy);
      const bool is_unknown = proxy.phase == scene::Proxy::Phase::kUnknown;
      unknown += is_unknown;
      wrong += !is_unknown && (proxy.phase == scene::Proxy::Phase::kInside) != (most_m < 0.02f);
    }
    test::note("lean, percent", static_cast<uint32_t>(100 * lean));
    CHECK_LT(2500u, begun);
    CHECK_EQ(unknown, 0u);
    CHECK_EQ(wrong, 0u);
  }
}
