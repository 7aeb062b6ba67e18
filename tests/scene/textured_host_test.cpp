// Texture of shapes without triangles, a ball and a torus of splines, against closed forms in
// double and by the work of a hand on closed ways.
#include "firmtouch/scene/textured.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/analytic.hpp"
#include "firmtouch/scene/spline_touched.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "scene/spline_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr double kPi = 3.14159265358979, kTool_m = 0.003, kStiff_N_per_m = 1000;
constexpr scene::TextureLayout kGrid{{{{400, 0, 300}, 1e-4f}, {{0, 700, 0}, 5e-5f}}};
// The shape's frame to the device's: axes change places.
constexpr math::RigidTransform kTurned{{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {0.01f, -0.02f, 0.03f}};

double wide(float a) { return static_cast<double>(a); }
Vec3 narrow(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}
struct Wide {
  double x, y, z;
};
Wide operator-(Wide a, Wide b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double size(Wide a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

// Below the surface, and its slope.
Wide cut_at(Wide p, double& depth_m) {
  Wide slope{0, 0, 0};
  depth_m = 0;
  for (const scene::WaveLayout& wave : kGrid.wave) {
    const double x = wide(wave.per_m[0]), y = wide(wave.per_m[1]), z = wide(wave.per_m[2]);
    const double turn = 2 * kPi * (x * p.x + y * p.y + z * p.z), high_m = wide(wave.height_m);
    depth_m += high_m / 2 * (1 - std::cos(turn));
    const double steep = high_m * kPi * std::sin(turn);
    slope = {slope.x + steep * x, slope.y + steep * y, slope.z + steep * z};
  }
  return slope;
}

// A shape in its own frame, placed by a pose that the rig applies.
struct Ball {
  scene::SphereTouched shape{{}, 0.02f};
  float size_m() const { return shape.size_m(); }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) {
    return shape.near(x_m, budget, needed_m);
  }
  // The nearest point of the middle: of the surface the normal points away from it.
  static Wide middle(Wide) { return {0, 0, 0}; }
  static Wide place(double turn, double tilt, double off_m) {
    const double away = 0.02 + off_m;
    return {away * std::cos(turn) * std::cos(tilt), away * std::sin(turn) * std::cos(tilt),
            away * std::sin(tilt)};
  }
};

struct Torus {
  spline_touch::Surface surface = spline_touch::torus();
  scene::SplineObject object;
  spline::Hint hint;
  Torus() { object.surface = &surface.view, object.is_closed = true; }
  float size_m() { return scene::SplineTouched{object, hint}.size_m(); }
  scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) {
    return scene::SplineTouched{object, hint}.near(x_m, budget, needed_m);
  }
  static Wide middle(Wide p) {
    const double r = std::hypot(p.x, p.y);
    return {0.05 * p.x / r, 0.05 * p.y / r, 0};
  }
  static Wide place(double turn, double tilt, double off_m) {
    const double away = 0.05 + (0.02 + off_m) * std::cos(tilt);
    return {away * std::cos(turn), away * std::sin(turn), (0.02 + off_m) * std::sin(tilt)};
  }
};

template <class Shape>
struct TexturedRig {
  Shape shape;
  math::RigidTransform pose;
  scene::ProxyContact contact;
  scene::ProxyTouch touch;
  scene::TexturedTouch state;
  servo::LocalModel model;
  bool is_flat = false;  // without a texture

  explicit TexturedRig(float friction = 0) {
    contact.settings.radius_m = static_cast<float>(kTool_m);
    contact.settings.budget.work = 1u << 20;
    contact.settings.friction_static = contact.settings.friction_dynamic = friction;
    contact.material.stiffness_N_per_m = static_cast<float>(kStiff_N_per_m);
    contact.passed_s = 0.001f;
    contact.is_on = contact.has_proxy = true;
  }
  template <class Texture>
  Vec3 tick(Vec3 hand_m, const Texture& texture) {
    contact.position_m = hand_m;
    contact.proxy_m = model.spring.anchor_m;
    model = {};
    scene::touch_textured(contact, texture, pose, shape, touch, state, model);
    CHECK(servo::is_sound(model));
    if (!model.spring.is_held) return {};
    return (model.spring.anchor_m - hand_m) * model.spring.stiffness_N_per_m;
  }
  Vec3 tick(Wide hand_m) {
    return tick(narrow(hand_m.x, hand_m.y, hand_m.z),
                [this](Vec3 x_m) { return is_flat ? scene::Cut{} : scene::cut_at(kGrid, x_m); });
  }
};

// Without friction the proxy is straight above the hand: k (d - c) along the normal, and as much
// times the slope.
template <class Shape>
void check_closed_form(uint32_t count) {
  TexturedRig<Shape> rig;
  tools::Random random(4);
  uint32_t held = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double turn = 0.002 * i, tilt = 0.4 * std::sin(0.003 * i);
    const double deep_m = i < 50 ? -0.001 : 1e-3 + 0.8e-3 * std::sin(0.01 * i);
    const Wide hand_m = Shape::place(turn, tilt, kTool_m - deep_m);
    const Vec3 force_N = rig.tick(hand_m);
    if (i < 100) continue;
    double cut_m = 0;
    const Wide slope = cut_at(hand_m, cut_m), off = hand_m - Shape::middle(hand_m);
    const double stretch_m = 0.02 + kTool_m - size(off) - cut_m, k = kStiff_N_per_m;
    const double pressed_N = stretch_m > 0 ? k * stretch_m : 0;
    held += pressed_N > 0;
    const Wide error{wide(force_N.x) - pressed_N * (off.x / size(off) + slope.x),
                     wide(force_N.y) - pressed_N * (off.y / size(off) + slope.y),
                     wide(force_N.z) - pressed_N * (off.z / size(off) + slope.z)};
    CHECK_LE(size(error), 0.005 * pressed_N + 1e-3);
  }
  CHECK_LE(count, 2 * held);
}

struct Loops {
  double most = -1e9, least = 1e9;
};

// The most and the least that closed ways give, over the most that was stored.
template <class Shape>
Loops loops_of(float friction, uint32_t count, double step_m, bool is_flat = false) {
  tools::Random random(11);
  Loops loops;
  double stored_J = 0;
  TexturedRig<Shape> rig(friction);
  rig.is_flat = is_flat;
  for (uint32_t loop = 0; loop < count; ++loop) {
    Wide place[5];
    for (Wide& each : place)
      each = Shape::place(random.between(-0.2, 0.2), random.between(-0.2, 0.2),
                          kTool_m + random.between(-0.0025, 0.001));
    place[0] = Shape::place(0, 0, kTool_m + 0.002);
    Vec3 at_N = rig.tick(place[0]);
    double given_J = 0;
    for (int k = 0; k < 5; ++k) {
      const Wide from = place[k], way = place[(k + 1) % 5] - from;
      const double length_m = size(way);
      const int steps = 2 * static_cast<int>(0.5 * length_m / step_m) + 2;
      const auto along = [&](Vec3 f) {
        return (wide(f.x) * way.x + wide(f.y) * way.y + wide(f.z) * way.z) / length_m;
      };
      double sum_N = along(at_N);
      for (int i = 1; i <= steps; ++i) {
        const double share = double{1} * i / steps;
        at_N =
            rig.tick(Wide{from.x + way.x * share, from.y + way.y * share, from.z + way.z * share});
        sum_N += along(at_N) * (i == steps ? 1 : i % 2 == 1 ? 4 : 2);
        const double size_N = wide(math::length(at_N));
        stored_J = std::max(stored_J, size_N * size_N / (2 * kStiff_N_per_m));
      }
      given_J += sum_N * length_m / (3 * steps);
    }
    loops.most = std::max(loops.most, given_J), loops.least = std::min(loops.least, given_J);
  }
  return {loops.most / stored_J, loops.least / stored_J};
}

}  // namespace

TEST(Textured_BallAndSplines_HaveTheForceOfTheClosedForm) {
  check_closed_form<Ball>(6000);
  check_closed_form<Torus>(6000);
}

TEST(Textured_ClosedLoops_GiveNoEnergy) {
  CHECK_LE(loops_of<Ball>(0, 30, 1e-6).most, 1e-5);
  // Simpson's rule takes the small moves of a proxy on splines for work. The texture adds none.
  const double flat = loops_of<Torus>(0, 4, 2e-6, true).most;
  CHECK_LE(loops_of<Torus>(0, 4, 2e-6).most, flat + 1e-3);
  const Loops rough = loops_of<Ball>(0.3f, 30, 5e-6);
  CHECK_LE(rough.most, 0);
  CHECK_LE(rough.least, -0.1);
}

TEST(Textured_ShapeThatWasTurned_TurnsItsTexture) {
  struct TurnedBox {
    scene::BoxTouched box{kTurned, {0.05f, 0.05f, 0.01f}};
    float size_m() const { return box.size_m(); }
    scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) {
      return box.near(x_m, budget, needed_m);
    }
  };
  struct Box {
    scene::BoxTouched box{{}, {0.05f, 0.05f, 0.01f}};
    float size_m() const { return box.size_m(); }
    scene::Near near(Vec3 x_m, query::Budget budget, float needed_m) {
      return box.near(x_m, budget, needed_m);
    }
  };
  TexturedRig<Box> plain;
  TexturedRig<TurnedBox> turned;
  turned.pose = kTurned;
  const auto waves = [](Vec3 x_m) { return scene::cut_at(kGrid, x_m); };
  uint32_t held = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at_m = narrow(2e-5 * i, 0.001, i < 50 ? 0.014 - 4e-5 * i : 0.0122);
    const Vec3 force_N = plain.tick(at_m, waves);
    const Vec3 there_N = turned.tick(math::apply(kTurned, at_m), waves);
    CHECK_LE(math::length(there_N - kTurned.rotation * force_N), 2e-3f);
    held += math::length(force_N) > 0.1f;
  }
  CHECK_LE(900u, held);
}

TEST(Textured_HostileCuts_AreNone) {
  TexturedRig<Ball> rig, plain;
  const auto flat = [](Vec3) { return scene::Cut{}; };
  uint32_t held = 0;
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1e-3f, 1, FLT_MAX};
  for (int i = 0; i < 200; ++i) {
    const float off_m = 0.024f - 1e-5f * static_cast<float>(i);
    const Vec3 at_m{off_m, 1e-5f * static_cast<float>(i), 0};
    const float value = hostile[i % 6];
    const int which = i / 6 % 2;
    const auto cut = [&](Vec3) {
      return which == 0 ? scene::Cut{value, {}}
                        : scene::Cut{0, {0, value < 0 ? -value * 2e3f : value, 0}};
    };
    const Vec3 force_N = rig.tick(at_m, cut), wanted_N = plain.tick(at_m, flat);
    CHECK_LE(math::length(force_N - wanted_N), 1e-5f);
    held += rig.state.is_held;
  }
  CHECK_LE(80u, held);
}
