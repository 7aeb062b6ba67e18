// Force shading against closed forms in double: how far the force's direction lags behind an edge,
// what an edge takes, and what closed ways of a hand give.
#include "firmtouch/scene/force_shading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/proxy_contact.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/long.hpp"
#include "scene/proxy_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr double kPi = 3.14159265358979, kStiff_N_per_m = 1000;

double wide(float a) { return static_cast<double>(a); }
double size_m(Vec3 a) { return wide(math::length(a)); }

// A hand whose contact with a mesh is shaded, as controller/shaded.hpp does it.
struct ShadedRig {
  scene_test::ProxyRig mesh;
  scene::ProxyContact contact;
  scene::ProxyTouch touch;
  scene::ForceShading shading;
  servo::LocalModel model;
  Vec3 hand_m, force_N;
  double given_J = 0;  // to the hand: force of both ends of a move, halved
  const float round_m;

  ShadedRig(const tools::Surface& surface, double radius_m, double its_round_m)
      : mesh(surface), round_m(static_cast<float>(its_round_m)) {
    contact.settings.radius_m = static_cast<float>(radius_m);
    contact.settings.budget.work = 1u << 20;
    contact.material.stiffness_N_per_m = static_cast<float>(kStiff_N_per_m);
    contact.passed_s = 0.001f;
    contact.is_on = contact.has_proxy = true;
  }
  Vec3 tick(double x_m, double y_m, double z_m) {
    const Vec3 to_m{static_cast<float>(x_m), static_cast<float>(y_m), static_cast<float>(z_m)};
    contact.position_m = to_m;
    contact.proxy_m = model.spring.anchor_m;
    model = {};
    scene::MeshTouched shape{mesh.object, mesh.hint};
    scene::touch_by_proxy(contact, shape, touch, model);
    if (round_m > 0) scene::shade(round_m, to_m, {}, shading, model.spring);
    CHECK(servo::is_sound(model));
    const Vec3 last_N = force_N;
    force_N = {};
    if (model.spring.is_held)
      force_N = (model.spring.anchor_m - to_m) * model.spring.stiffness_N_per_m;
    given_J += wide(math::dot(last_N + force_N, to_m - hand_m)) / 2;
    hand_m = to_m;
    return force_N;
  }
};

// Level at z = 0 up to x = 0; beyond it the top goes down by `angle`, or up if that is negative.
tools::Surface bent(double angle) {
  tools::Surface surface;
  const float end_m = static_cast<float>(-0.04 * std::tan(angle));
  scene_test::extrude(
      {{{-0.04f, 0}, {-0.04f, -0.05f}, {0, -0.05f}, {0.04f, -0.05f}, {0.04f, end_m}, {0, 0}},
       {{0, 1, 5}, {1, 2, 5}, {5, 2, 4}, {2, 3, 4}}},
      0.04f, surface);
  return surface;
}

}  // namespace

// A hand d below the level side, until the proxy falls; from there along the other side.
TEST(ForceShading_ConvexEdge_LagsAndTakesEnergyAsTheClosedFormSays) {
  constexpr double kDeep_m = 0.002, kTool_m = 0.0005, kStep_m = 2e-5;
  for (const double angle : {0.1, 0.26, 0.6}) {
    for (const double round_m : {0.003, 0.01}) {
      ShadedRig rig(bent(angle), kTool_m, round_m);
      double x_m = -0.01, z_m = kTool_m - kDeep_m, gone_m = 0, fallen_N = 0;
      for (int i = 0; i < 300; ++i) rig.tick(x_m, 0.001, z_m + 0.003 * (299 - i) / 299);
      while (rig.shading.aside_m.x >= 0) rig.tick(x_m += kStep_m, 0.001, z_m);
      const double lag_m = size_m(rig.shading.aside_m), deep_m = wide(rig.shading.depth_m);
      // Where the radius is no more than the edge's, it has a part of its turn before the fall.
      CHECK_LE(std::fabs(lag_m / (kDeep_m * std::sin(angle)) - 1), 0.15);
      fallen_N = size_m(rig.force_N);
      CHECK_LE(std::fabs(fallen_N - kStiff_N_per_m * kDeep_m), 0.03 * fallen_N);
      const double before_J = rig.given_J, ends_m = lag_m * round_m / deep_m;
      double worst_m = 0;
      while (gone_m < ends_m + 3 * kStep_m) {
        x_m += kStep_m * std::cos(angle), z_m -= kStep_m * std::sin(angle), gone_m += kStep_m;
        const Vec3 force_N = rig.tick(x_m, 0.001, z_m);
        const double across_m =
            (wide(force_N.x) * std::cos(angle) - wide(force_N.z) * std::sin(angle)) /
            kStiff_N_per_m;
        const double wanted_m = -std::max(0.0, lag_m - gone_m * deep_m / round_m);
        worst_m = std::max(worst_m, std::fabs(across_m - wanted_m));
      }
      CHECK_LE(worst_m, 2e-6);
      const double taken_J = before_J - rig.given_J;
      const double wanted_J = kStiff_N_per_m * lag_m * ends_m / 2;
      CHECK_LE(std::fabs(taken_J / wanted_J - 1), 0.01);
      const double closed_J =
          kStiff_N_per_m * kDeep_m * round_m * std::sin(angle) * std::tan(angle) / 2;
      CHECK_LE(std::fabs(taken_J / closed_J - 1), 0.3);
      // Then direction and bits are the true ones.
      CHECK_EQ(rig.shading.depth_m > 0, true);
      CHECK_LE(size_m(rig.shading.aside_m), 0);
    }
  }
}

TEST(ForceShading_ConcaveEdge_TurnsWithTheHandAsWithout) {
  for (const double angle : {-0.1, -0.6}) {
    ShadedRig with(bent(angle), 0.0005, 0.01), without(bent(angle), 0.0005, 0);
    for (int i = -500; i < 500; ++i) {
      const double x_m = 2e-5 * i, z_m = 0.001 - 1e-5 * std::min(i + 500, 300);
      const double up_m = x_m > 0 ? -x_m * std::tan(angle) : 0;
      const Vec3 a = with.tick(x_m, 0.001, z_m + up_m), b = without.tick(x_m, 0.001, z_m + up_m);
      CHECK(i < -300 || size_m(a) > 1);
      CHECK_LE(size_m(a - b), 1e-6);
    }
  }
}

// Just beyond an edge, where the lag is largest: one that stands, one that presses and lifts there.
TEST(ForceShading_HandThatStands_KeepsItsForce_AndContactBeginsAnewWithTheTrueOne) {
  ShadedRig rig(bent(0.3), 0.0005, 0.01);
  double x_m = -0.005;
  for (int i = 0; i < 300; ++i) rig.tick(x_m, 0.001, -0.0015 + 0.003 * (299 - i) / 299);
  while (rig.shading.aside_m.x >= 0) rig.tick(x_m += 2e-5, 0.001, -0.0015);
  const Vec3 stood_N = rig.force_N;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 still_N = rig.tick(x_m, 0.001, -0.0015);
    CHECK_LE(size_m(still_N - stood_N), 2e-4);  // rounding moves the proxy by 5e-10 m a tick
  }
  double largest = 0;
  for (double z_m = -0.0015; rig.model.spring.is_held; z_m += 1e-5) {
    rig.tick(x_m + 0.3 * (z_m + 0.0015), 0.001, z_m);
    if (rig.shading.depth_m > 0)
      largest = std::max(largest, size_m(rig.shading.aside_m) / wide(rig.shading.depth_m));
  }
  CHECK_LE(largest, 0.32);  // it has faded with the depth
  rig.tick(x_m, 0.001, 0.003);
  rig.tick(0.01, 0.001, -0.003);
  CHECK(rig.model.spring.is_held);
  CHECK_LE(size_m(rig.shading.aside_m), 0);
}

// Faceted drums from outside, tubes from inside; edges of 15 and 45 degrees. Hands that stay near
// an edge, and that go over many. The sum over a way errs by its steps, as it does without shading.
TEST(ForceShading_ClosedWays_GiveNoMoreThanContactWithoutIt) {
  const int loops = test::is_long() ? 4000 : 250;
  const auto way = [](ShadedRig& rig, bool is_tube, double radius_m, int count) {
    tools::Random random(7);
    double most_J = -1;
    const auto tick = [&](double turn, double y, double deep_m) {
      const double away_m = 0.01 + (is_tube ? deep_m - radius_m : radius_m - deep_m);
      const double x = away_m * std::cos(turn), z = away_m * std::sin(turn);
      if (is_tube) return rig.tick(x, y, z);
      return rig.tick(0.36 * x - 0.8 * z + 0.48 * y, 0.48 * x + 0.6 * z + 0.64 * y,
                      -0.8 * x + 0.6 * y);
    };
    const double off_m = -0.002;
    for (int loop = 0; loop < count; ++loop) {
      double at[3] = {0, 0, off_m};
      const double begin_J = rig.given_J, spread = random.between(0, 1) < 0.5 ? 0.15 : 1.2;
      const int legs = 3 + static_cast<int>(random.between(0, 5));
      for (int leg = 0; leg <= legs; ++leg) {
        double to[3] = {0, 0, off_m};
        if (leg < legs)
          to[0] = random.between(-spread, spread), to[1] = random.between(-0.01, 0.01),
          to[2] = random.between(-0.0005, 0.003);
        const double long_m = std::hypot(0.01 * (to[0] - at[0]), to[1] - at[1], to[2] - at[2]);
        const int steps = 1 + static_cast<int>(long_m / random.between(2e-5, 2e-4));
        for (int i = 1; i <= steps; ++i) {
          const double share = static_cast<double>(i) / steps;
          tick(at[0] + (to[0] - at[0]) * share, at[1] + (to[1] - at[1]) * share,
               at[2] + (to[2] - at[2]) * share);
        }
        std::copy(to, to + 3, at);
      }
      most_J = std::max(most_J, rig.given_J - begin_J);
    }
    return most_J;
  };
  for (const double radius_m : {0.0005, 0.003})
    for (const uint32_t sides : {24u, 8u})
      for (const bool is_tube : {false, true}) {
        const tools::Surface surface =
            is_tube ? scene_test::tube(0.01f, 0.02f, sides) : scene_test::drum(0.01f, 0.02f, sides);
        ShadedRig without(surface, radius_m, 0);
        const double bare_J = way(without, is_tube, radius_m, loops);
        for (const double round_m : {0.002, 0.01}) {
          ShadedRig rig(surface, radius_m, round_m);
          CHECK_LE(way(rig, is_tube, radius_m, loops), bare_J + 1e-7);
          if (!is_tube) CHECK_LE(rig.given_J, without.given_J);
        }
      }
}

// Friction holds the proxy beside an edge, and the hand goes round below it: its turns, which are
// no fall, led the lag round with it, for as much energy as there are turns.
TEST(ForceShading_HandThatCirclesBelowAProxyThatStands_GetsNothing) {
  for (const double round_m : {0.003, 0.1}) {
    ShadedRig rig(bent(0.5), 0.0005, round_m);
    double x_m = -0.005;
    for (int i = 0; i < 300; ++i) rig.tick(x_m, 0.001, -0.0015 + 0.003 * (299 - i) / 299);
    while (rig.shading.aside_m.x >= 0) rig.tick(x_m += 2e-5, 0.001, -0.0015);
    rig.contact.settings.friction_static = rig.contact.settings.friction_dynamic = 2.0f;
    const double before_J = rig.given_J;
    for (int i = 0; i <= 4000; ++i) {
      const double turn = 2 * kPi * i / 400;
      rig.tick(x_m + 0.0005 * std::sin(turn), 0.001 + 0.0005 * (1 - std::cos(turn)), -0.0015);
    }
    CHECK(rig.model.spring.is_held);
    CHECK_LE(rig.given_J, before_J);
  }
}

// The same contact on an object that moves has the same lag: what carries the proxy is no way.
TEST(ForceShading_CarriedProxy_KeepsItsLag) {
  const Vec3 carried_m{0.0005f, -0.0002f, 0.0001f};
  scene::ForceShading last{{}, {0, 0, 0.002f}, {-0.0005f, 0, 0}, 0.002f};
  for (int i = 1; i <= 100; ++i) {
    servo::ProxySpring spring;
    spring.is_held = true;
    spring.anchor_m = carried_m * static_cast<float>(i);
    scene::shade(0.01f, spring.anchor_m - Vec3{0, 0, 0.002f}, carried_m, last, spring);
  }
  CHECK_LE(size_m(last.aside_m - Vec3{-0.0005f, 0, 0}), 1e-6);
}

TEST(ForceShading_AnyHandAndCarrier_LeaveAnEndWithinTheDepthOfTheProxy) {
  tools::Random random(3);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const float values[] = {0, -0.0f, 1e-38f, -1e-30f, 1e-3f, -0.01f, 1, 1e4f, -1e4f, 1e-20f, kNan};
  const auto draw = [&] { return values[static_cast<size_t>(random.between(0, 10.999))]; };
  const auto place = [&] { return Vec3{draw(), draw(), draw()}; };
  const auto near = [&] { return static_cast<float>(random.between(-1, 1)); };
  scene::ForceShading last;
  for (int i = 0; i < 200000; ++i) {
    servo::ProxySpring spring;
    spring.anchor_m = i % 5 == 0 ? last.proxy_m : Vec3{near(), near(), near()};
    const Vec3 proxy_m = spring.anchor_m;
    const Vec3 hand_m = i % 7 == 0 ? place() : Vec3{near(), near(), near()};
    spring.is_held = i % 11 != 0;
    scene::shade(std::fabs(draw()), hand_m, i % 13 == 0 ? place() : Vec3{}, last, spring);
    CHECK(math::is_finite(spring.anchor_m));
    CHECK(spring.is_held || last.depth_m <= 0);  // the next contact begins anew
    if (math::is_finite(hand_m))
      CHECK_LE(size_m(spring.anchor_m - proxy_m), size_m(proxy_m - hand_m) * 1.00001);
  }
}
