// Effects against closed forms in double, and hostile settings.
#include "firmtouch/scene/effects.hpp"

#include <cfloat>
#include <cmath>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr Vec3 kAside{0.6f, 0, -0.8f};

scene::Vibration buzz() {
  scene::Vibration v;
  v.direction = kAside;
  v.amplitude_N = 1.5f;
  v.cycles_a_tick = 0.2371f;
  v.start_tick = 1000;
  v.rise_ticks = 40;
  v.hold_ticks = 400;
  v.fall_ticks = 100;
  return v;
}

double expected_N(const scene::Vibration& v, uint32_t tick) {
  if (tick < v.start_tick) return 0;
  const double passed = double{1} * (tick - v.start_tick);
  double share = 1;
  if (passed < v.rise_ticks)
    share = passed / v.rise_ticks;
  else if (passed >= double{1} * v.rise_ticks + v.hold_ticks)
    share = 1 - (passed - v.rise_ticks - v.hold_ticks) / v.fall_ticks;
  if (!(share > 0)) return 0;
  return double{v.amplitude_N} * share *
         sin(2 * 3.14159265358979323846 * fmod(passed * double{v.cycles_a_tick}, 1.0));
}

Vec3 force_N(const servo::LocalModel& model, Vec3 at_m) { return servo::evaluate(model, at_m, {}); }

scene::Attraction magnet() {
  scene::Attraction a;
  a.point_m = {0.01f, -0.02f, 0.03f};
  a.stiffness_N_per_m = 400;
  a.limit_N = 2;
  a.reach_m = 0.02f;
  return a;
}

bool attracted(const scene::Attraction& a, Vec3 at_m, servo::LocalModel& model) {
  model = {};
  scene::begin_model(model, at_m, 1, 3);
  return scene::add_attraction(a, at_m, model);
}

}  // namespace

TEST(Vibration_EveryTick_IsTheClosedForm) {
  const scene::Vibration v = buzz();
  uint32_t forces = 0;
  for (uint32_t tick = 900; tick < 1700; ++tick) {
    servo::LocalModel model;
    scene::begin_model(model, {0.01f, 0.02f, 0}, tick, 3);
    const bool is_added = scene::add_vibration(v, tick, {0.01f, 0.02f, 0}, model);
    CHECK(servo::is_sound(model));
    forces += is_added;
    const Vec3 force = force_N(model, {0.011f, 0.02f, 0.003f});  // not of the place
    const double wanted_N = expected_N(v, tick);
    CHECK_LE(fabs(double{math::dot(force, kAside)} - wanted_N), 1.5e-6);
    CHECK_LE(fabs(double{math::dot(force, {0.8f, 0, 0.6f})}), 1e-6);
  }
  CHECK_LE(530u, forces);
  CHECK_LE(forces, 540u);
}

// After 49 days of 1 kHz, where a sum of floats has lost the phase.
TEST(Vibration_HeldForever_KeepsItsPhase) {
  scene::Vibration v = buzz();
  v.start_tick = 5;
  v.hold_ticks = UINT32_MAX;
  v.cycles_a_tick = 0.15625f;  // exact in binary
  for (uint32_t tick = 4294960000u; tick < 4294961000u; ++tick)
    CHECK_LE(fabs(double{scene::vibration_N(v, tick)} - expected_N(v, tick)), 1.5e-6);
}

TEST(Vibration_OverTheWrapOfTheTick_IsTheSame) {
  const scene::Vibration from_zero = buzz();
  const uint32_t all[] = {0, 900, 4294966100, 4294966296, 4294966800, 2147483648};
  for (const uint32_t later : all) {
    scene::Vibration v = from_zero;
    v.start_tick += later;
    for (uint32_t tick = 900; tick < 1700; ++tick)
      CHECK_EQ(scene::vibration_N(v, tick + later), scene::vibration_N(from_zero, tick));
  }
}

TEST(Vibration_HostileSettings_MakeNoForce) {
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1, 0, FLT_MAX};
  for (const float value : hostile) {
    for (int which = 0; which < 3; ++which) {
      scene::Vibration v = buzz();
      (which == 0 ? v.amplitude_N : which == 1 ? v.cycles_a_tick : v.direction.x) = value;
      servo::LocalModel model;
      scene::begin_model(model, {}, 1101, 3);
      CHECK(!scene::add_vibration(v, 1101, {}, model));
      CHECK(servo::is_sound(model) && !model.has_guide);
    }
    servo::LocalModel model;
    scene::begin_model(model, {}, 1101, 3);
    if (!(fabsf(value) <= 1)) CHECK(!scene::add_vibration(buzz(), 1101, {0, value, 0}, model));
  }
  scene::Vibration v = buzz();
  v.rise_ticks = v.hold_ticks = v.fall_ticks = 0;
  CHECK_EQ(scene::vibration_N(v, 1000), 0.0f);
  v.rise_ticks = v.hold_ticks = v.fall_ticks = UINT32_MAX;
  CHECK_LE(fabsf(scene::vibration_N(v, UINT32_MAX)), 1.5f);
}

TEST(Attraction_AnyPlace_PullsByTheClosedForm) {
  const scene::Attraction a = magnet();
  uint32_t near = 0, limited = 0;
  for (int i = 0; i < 4000; ++i) {
    const double away = 0.024 * (i % 97) / 96, turn = 0.7 * i, tilt = 0.31 * i;
    const Vec3 off{static_cast<float>(away * cos(turn) * cos(tilt)),
                   static_cast<float>(away * sin(turn) * cos(tilt)),
                   static_cast<float>(away * sin(tilt))};
    const Vec3 at_m = a.point_m + off;
    servo::LocalModel model;
    const bool is_near = attracted(a, at_m, model);
    CHECK(servo::is_sound(model));
    if (fabs(away - 0.02) > 1e-6) CHECK_EQ(is_near, away < 0.02);
    if (!is_near) continue;
    ++near;
    limited += away > 0.005;
    const double wanted_N = fmin(400 * away, 2);
    const Vec3 force = force_N(model, at_m);
    CHECK_LE(fabs(double{math::length(force)} - wanted_N), 4e-6);
    CHECK_LE(double{math::dot(force, off)}, -wanted_N * away + 1e-7);
    // At the place of the next tick, aside.
    if (away < 0.0051) continue;
    const Vec3 next = off + math::cross(off, kAside) * 0.01f;
    const Vec3 limited_N = next * (-2.0f / math::length(next));
    CHECK_LE(math::length(force_N(model, a.point_m + next) - limited_N), 5e-4f);
  }
  CHECK_LE(3000u, near);
  CHECK_LE(2000u, limited);
}

// Around loops that leave and enter its reach, and with the force at the fresh place, too.
TEST(Attraction_ClosedLoops_GiveNoEnergy) {
  const scene::Attraction a = magnet();
  double given_J = 0;
  Vec3 before_m, before_N;
  constexpr int kSteps = 200000;
  for (int i = 0; i <= kSteps; ++i) {
    const double turn = 2 * 3.14159265358979323846 * (i % kSteps) / kSteps;
    const Vec3 at_m = a.point_m + Vec3{static_cast<float>(0.004 + 0.017 * cos(turn)),
                                       static_cast<float>(0.009 * sin(2 * turn)),
                                       static_cast<float>(0.006 * sin(turn))};
    servo::LocalModel model;
    const Vec3 here_N = attracted(a, at_m, model) ? force_N(model, at_m) : Vec3{};
    if (i > 0) given_J += double{math::dot((here_N + before_N) * 0.5f, at_m - before_m)};
    before_m = at_m, before_N = here_N;
  }
  CHECK_LE(fabs(given_J), 2e-6);  // of 30 mJ
}

TEST(Attraction_HostileSettings_MakeNoForce) {
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1, FLT_MAX};
  for (const float value : hostile)
    for (int which = 0; which < 6; ++which) {
      scene::Attraction a = magnet();
      Vec3 at_m = a.point_m + Vec3{0.001f, 0, 0};
      float* const settings[] = {&a.point_m.y,         &a.stiffness_N_per_m, &a.limit_N,
                                 &a.damping_N_s_per_m, &a.reach_m,           &at_m.z};
      *settings[which] = value;
      servo::LocalModel model;
      const bool is_added = attracted(a, at_m, model);
      if (which != 4 || !(value > 0)) CHECK(!is_added);
      CHECK(!model.has_guide || servo::is_sound(model));
    }
  servo::LocalModel model;
  CHECK(attracted(magnet(), magnet().point_m, model));  // at the point itself
  CHECK(servo::is_sound(model));
  CHECK(!scene::add_attraction(magnet(), magnet().point_m, model));  // there is a guide
}
