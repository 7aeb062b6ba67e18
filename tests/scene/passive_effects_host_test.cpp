// Viscosity, speed walls and detents against closed forms in double: force, energy, continuity.
#include <cfloat>
#include <cmath>
#include <random>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/effects.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Vec3 kAside{0.6f, 0, -0.8f}, kAcross{0.8f, 0, 0.6f};

struct Place {
  double x, y, z;
};
Vec3 rounded(Place p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
Place exact(Vec3 p) { return {p.x, p.y, p.z}; }
double dot(Place a, Vec3 b) { return a.x * double{b.x} + a.y * double{b.y} + a.z * double{b.z}; }

scene::Detents rail() { return {{0.01f, -0.02f, 0.03f}, kAside, 0.004f, 1.5f}; }
scene::DetentRing knob() { return {{0.01f, -0.02f, 0.03f}, kAside, kAcross, 12, 0.005f, 1.5f}; }

// The potentials as they are stated, by other functions than the library's.
double potential_J(const scene::Detents& d, Place p) {
  const double along_m = dot(p, d.direction) - dot(exact(d.notch_m), d.direction);
  return double{d.limit_N} * double{d.pitch_m} / (2 * kPi) *
         (1 - std::cos(2 * kPi * along_m / double{d.pitch_m}));
}
double potential_J(const scene::DetentRing& d, Place p) {
  const Place off{p.x - double{d.centre_m.x}, p.y - double{d.centre_m.y},
                  p.z - double{d.centre_m.z}};
  const Vec3 third{d.axis.y * d.notch.z - d.axis.z * d.notch.y,
                   d.axis.z * d.notch.x - d.axis.x * d.notch.z,
                   d.axis.x * d.notch.y - d.axis.y * d.notch.x};
  const double x = dot(off, d.notch), y = dot(off, third), r = std::hypot(x, y), c = d.core_m;
  const double w = r < c ? r * r / (2 * c) : r - c / 2;
  return double{d.limit_N} / d.count * (1 - std::cos(d.count * std::atan2(y, x))) * w;
}

// Force and potential of the library against the closed form and its slope.
template <class Effect>
void check_at(const Effect& effect, Vec3 at_m, double most_N) {
  const scene::EffectForce found = scene::detents_at(effect, at_m);
  constexpr double kStep = 1e-7;
  double slope[3];
  for (int axis = 0; axis < 3; ++axis) {
    Place low = exact(at_m), high = low;
    (axis == 0 ? low.x : axis == 1 ? low.y : low.z) -= kStep;
    (axis == 0 ? high.x : axis == 1 ? high.y : high.z) += kStep;
    slope[axis] = (potential_J(effect, high) - potential_J(effect, low)) / (2 * kStep);
  }
  const double off_N =
      std::hypot(double{found.force_N.x} + slope[0], double{found.force_N.y} + slope[1],
                 double{found.force_N.z} + slope[2]);
  CHECK_LE(off_N, most_N);
  CHECK_LE(fabs(double{found.potential_J} - potential_J(effect, exact(at_m))),
           5e-8);  // places round by 1e-8 m
  CHECK_LE(0.0f, found.potential_J);
  CHECK_LE(math::length(found.force_N), 1.16f * effect.limit_N);
}

// What the force gives on a way that comes back to where it began, by the rule of trapezoids.
template <class Effect, class Way>
double given_J(const Effect& effect, int steps, const Way& way) {
  double sum_J = 0;
  Vec3 last_m, last_N;
  for (int i = 0; i <= steps; ++i) {
    const Vec3 at_m = rounded(way(2 * kPi * (i % steps) / steps));
    const Vec3 force_N = scene::detents_at(effect, at_m).force_N;
    if (i > 0) sum_J += double{math::dot((force_N + last_N) * 0.5f, at_m - last_m)};
    last_m = at_m, last_N = force_N;
  }
  return sum_J;
}

}  // namespace

TEST(Detents_AnyPlace_ForceIsMinusTheSlopeOfThePotential) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> side(-0.05f, 0.05f);
  for (int i = 0; i < 20000; ++i) {
    const float scale = i % 3 == 0 ? 0.1f : 1.0f;  // a third of them about the core
    const Vec3 at_m = knob().centre_m + Vec3{side(random), side(random), side(random)} * scale;
    check_at(rail(), at_m, 5e-5);
    check_at(knob(), at_m, 5e-5);
  }
  check_at(knob(), knob().centre_m, 1e-6);
}

TEST(Detents_ClosedLoops_GiveNoEnergy) {
  const auto around = [](double turn) {  // the axis, and in and out of the core
    const double r = 0.012 + 0.009 * std::cos(3 * turn), x = r * std::cos(turn);
    return Place{0.01 + 0.8 * x, -0.02 + r * std::sin(turn), 0.03 + 0.6 * x};
  };
  const auto aside = [](double turn) {
    return Place{0.02 + 0.013 * std::cos(turn), 0.01 * std::sin(2 * turn),
                 0.03 + 0.011 * std::sin(turn)};
  };
  CHECK_LE(fabs(given_J(knob(), 200000, around)), 2e-6);
  CHECK_LE(fabs(given_J(knob(), 200000, aside)), 2e-6);
  CHECK_LE(fabs(given_J(rail(), 200000, around)), 2e-6);
  CHECK_LE(fabs(given_J(rail(), 200000, aside)), 2e-6);
  // Into a notch and out: what it takes is what the notch is deep.
  const scene::Detents d = rail();
  const double depth_J = double{d.limit_N} * double{d.pitch_m} / kPi;
  const Vec3 ridge_m = d.notch_m + d.direction * (0.5f * d.pitch_m);
  CHECK_LE(fabs(double{scene::detents_at(d, ridge_m).potential_J} - depth_J), 1e-7);
}

TEST(Detents_HostileSettings_MakeNoForce) {
  // A coordinate may be -1.
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1, FLT_MAX};
  for (const float value : hostile) {
    for (int which = 0; which < 5; ++which) {
      scene::Detents d = rail();
      Vec3 at_m = d.notch_m + Vec3{0.001f, 0, 0};
      float* const settings[] = {&d.notch_m.y, &d.direction.x, &d.pitch_m, &d.limit_N, &at_m.z};
      *settings[which] = value < 0 && value >= -1 && (which == 0 || which == 4) ? NAN : value;
      const scene::EffectForce force = scene::detents_at(d, at_m);
      CHECK(math::dot(force.force_N, force.force_N) <= 0 && force.potential_J <= 0);
    }
    for (int which = 0; which < 6; ++which) {
      scene::DetentRing d = knob();
      Vec3 at_m = d.centre_m + Vec3{0.01f, 0.003f, 0};
      float* const settings[] = {&d.centre_m.y, &d.axis.x,  &d.notch.z,
                                 &d.core_m,     &d.limit_N, &at_m.z};
      *settings[which] = value < 0 && value >= -1 && (which == 0 || which == 5) ? NAN : value;
      const scene::EffectForce force = scene::detents_at(d, at_m);
      CHECK(math::dot(force.force_N, force.force_N) <= 0 && force.potential_J <= 0);
    }
  }
  for (const uint32_t count : {0u, 1u, 1001u, UINT32_MAX}) {
    scene::DetentRing d = knob();
    d.count = count;
    CHECK(scene::detents_at(d, {0.02f, 0, 0}).potential_J <= 0);
  }
  scene::DetentRing slanted = knob();
  slanted.notch = slanted.axis;
  CHECK(scene::detents_at(slanted, {0.02f, 0, 0}).potential_J <= 0);
  scene::Detents fine = rail();
  fine.pitch_m = 1e-6f;
  CHECK(scene::detents_at(fine, {9e3f, 0, 0}).potential_J <= 0);  // beyond 1e6 notches
}

TEST(Attraction_AsAForce_IsTheOneOfItsLine) {
  const scene::Attraction a{{0.01f, -0.02f, 0.03f}, 400, 0, 2, 0.02f};
  double last_J = -1;
  for (int i = 0; i <= 3000; ++i) {
    const double away_m = 1e-5 * i, stretch_m = fmin(away_m, 0.02), limited_m = 2.0 / 400;
    const Vec3 off = kAside * static_cast<float>(away_m);
    const scene::EffectForce found = scene::attraction_at(a, a.point_m + off);
    const double wanted_N = away_m < 0.02 ? fmin(400 * away_m, 2) : 0;
    if (i != 2000) CHECK_LE(fabs(-double{math::dot(found.force_N, kAside)} - wanted_N), 3e-5);
    const double wanted_J =
        stretch_m <= limited_m ? 200 * stretch_m * stretch_m : 2 * stretch_m - 0.5 * 2 * limited_m;
    CHECK_LE(fabs(double{found.potential_J} - wanted_J), 2e-8);
    CHECK_LE(last_J, double{found.potential_J});
    last_J = double{found.potential_J} - 1e-8;
  }
  scene::Attraction endless = a;
  endless.reach_m = INFINITY;
  CHECK(scene::attraction_at(endless, {}).potential_J <= 0);
}

TEST(Dampers_AnyVelocity_AreTheirClosedFormsAndTakeEnergy) {
  const scene::Viscosity honey{5, 2};
  const scene::SpeedWall wall{0.1f, {20, 3}};
  std::mt19937 random(7);
  std::uniform_real_distribution<float> side(-0.6f, 0.6f);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 v{side(random), side(random), side(random) * (i % 2 == 0 ? 0.0f : 1.0f)};
    const double speed = std::sqrt(double{v.x} * double{v.x} + double{v.y} * double{v.y} +
                                   double{v.z} * double{v.z});
    const Vec3 thick_N = scene::viscous_N(honey, v), fast_N = scene::speed_wall_N(wall, v);
    CHECK_LE(fabs(double{math::length(thick_N)} - fmin(5 * speed, 2)), 2e-6);
    CHECK_LE(fabs(double{math::length(fast_N)} - fmin(fmax(20 * (speed - double{0.1f}), 0), 3)),
             4e-6);
    // Against the velocity, straight: never energy for the hand.
    for (const Vec3 force_N : {thick_N, fast_N}) {
      CHECK_LE(math::dot(force_N, v), 0.0f);
      CHECK_LE(math::length(math::cross(force_N, v)), 2e-6f);
    }
    // Continuous: a change of velocity changes the force by at most the damping times it.
    const Vec3 change = Vec3{side(random), side(random), side(random)} * 1e-3f;
    CHECK_LE(math::length(scene::viscous_N(honey, v + change) - thick_N),
             5.0f * math::length(change) + 2e-6f);
    CHECK_LE(math::length(scene::speed_wall_N(wall, v + change) - fast_N),
             20.0f * math::length(change) + 4e-6f);
  }
}

TEST(Dampers_HostileSettings_MakeNoForce) {
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1, FLT_MAX};
  for (const float value : hostile)
    for (int which = 0; which < 4; ++which) {
      scene::SpeedWall wall{0.1f, {20, 3}};
      Vec3 v{0.3f, 0.2f, 0};
      float* const settings[] = {&wall.free_mps, &wall.beyond.damping_N_s_per_m,
                                 &wall.beyond.limit_N, &v.y};
      *settings[which] = value;
      const Vec3 force_N = scene::speed_wall_N(wall, v);
      if (which != 3 || !(fabsf(value) <= 1)) CHECK(math::dot(force_N, force_N) <= 0);
    }
  CHECK(math::dot(scene::viscous_N({5, 0}, {1, 0, 0}), {1, 0, 0}) >= 0);  // limit 0: no force
  CHECK(math::is_finite(scene::viscous_N({5, 2}, {1e-30f, 0, 0})));
  CHECK(math::is_finite(scene::viscous_N({1e4f, 1e3f}, {1e4f, 1e4f, 1e4f})));
}
