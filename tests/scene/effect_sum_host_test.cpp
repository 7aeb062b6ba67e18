// Sums of effects: the limit, the order, continuity, what contact keeps, and the energy of closed
// loops while contact takes and leaves the room.
#include "firmtouch/scene/effect_sum.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/force_parts.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 force_N(double most) {
    const double size = most * std::pow(10.0, between(-4, 0));
    const double z = between(-1, 1), turn = between(-kPi, kPi), r = std::sqrt(1 - z * z);
    return {static_cast<float>(size * r * std::cos(turn)),
            static_cast<float>(size * r * std::sin(turn)), static_cast<float>(size * z)};
  }
  uint32_t bits() { return static_cast<uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

double size(Vec3 a) {
  return std::sqrt(double{a.x} * double{a.x} + double{a.y} * double{a.y} +
                   double{a.z} * double{a.z});
}

// The largest share that stays within the limit, by halving.
double share_of(Vec3 sum_N, Vec3 force_N, double limit_N) {
  const auto is_within = [&](double s) {
    const double x = double{sum_N.x} + s * double{force_N.x},
                 y = double{sum_N.y} + s * double{force_N.y},
                 z = double{sum_N.z} + s * double{force_N.z};
    return x * x + y * y + z * z <= limit_N * limit_N;
  };
  if (is_within(1)) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (is_within((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

scene::Detents rail() { return {{}, {1, 0, 0}, 0.004f, 1.5f}; }

}  // namespace

TEST(EffectSum_AnyForces_GetTheLargestShareWithinTheLimit) {
  Random random(3);
  uint32_t cut = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 contact_N = random.force_N(i % 4 == 0 ? 8 : 4);
    constexpr double kLimit = 5;
    const double most_N = fmax(kLimit, size(contact_N));
    scene::EffectSum sum(static_cast<float>(kLimit), contact_N);
    for (int k = 0; k < 3; ++k) {
      const Vec3 before_N = contact_N + sum.force_N(), force_N = random.force_N(8);
      const double share = double{sum.add(force_N)}, wanted = share_of(before_N, force_N, most_N);
      cut += share < 1;
      // What is left of the square rounds by 1e-6 of the limit's. The way to the surface is the
      // root of it where the force runs along the surface.
      const double along_N = double{math::dot(before_N, force_N)} / size(force_N),
                   left = most_N * most_N - size(before_N) * size(before_N),
                   rounds = 1e-6 * most_N * most_N;
      const double error_N =
          rounds / (std::sqrt(fmax(along_N * along_N + left, 0)) + std::sqrt(rounds));
      CHECK_LE(fabs(share - wanted) * size(force_N), error_N);
      CHECK_LE(size(contact_N + sum.force_N()), most_N * (1 + 1e-6));
      CHECK_LE(size(sum.force_N() + contact_N - before_N - force_N * static_cast<float>(share)),
               2e-6 * most_N);
    }
  }
  CHECK_LE(10000u, cut);
}

TEST(EffectSum_SmallChanges_ChangeItLittle) {
  Random random(4);
  for (int i = 0; i < 50000; ++i) {
    // A third of them at the limit, where the room appears and vanishes.
    Vec3 contact_N = random.force_N(8);
    if (i % 3 == 0) contact_N = contact_N * (5.0f / math::length(contact_N));
    Vec3 force_N[2] = {random.force_N(8), random.force_N(8)};
    Vec3 ends_N[2];
    for (Vec3& end_N : ends_N) {
      scene::EffectSum sum(5, contact_N);
      sum.add(force_N[0]);
      sum.add(force_N[1]);
      end_N = sum.force_N();
      contact_N = contact_N + random.force_N(1e-5);
      force_N[0] = force_N[0] + random.force_N(1e-5);
      force_N[1] = force_N[1] + random.force_N(1e-5);
    }
    // Where a force grazes the limit, the change is the root of it: sqrt(2 x 5 N x 4e-5 N), twice.
    CHECK_LE(size(ends_N[1] - ends_N[0]), 0.06);
  }
}

TEST(EffectSum_WhatComesFirst_LosesNothingToWhatComesAfter) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 contact_N = random.force_N(7), first_N = random.force_N(7);
    scene::EffectSum alone(5, contact_N), both(5, contact_N);
    const float share = alone.add(first_N);
    CHECK_EQ(both.add(first_N), share);
    both.add(random.force_N(1000));
    both.add(random.force_N(1000));
    // What servo keeps of contact, with the effects and without.
    const double without = fmin(1, 5 / size(contact_N));
    const double with = fmin(1, 5 / size(contact_N + both.force_N()));
    CHECK_LE(without * (1 - 1e-6), with);
  }
}

TEST(EffectSum_InTheServo_LeavesContactItsForce) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    servo::State state;
    const servo::Settings settings{6, 1e6f, 0, 0.001f};
    Vec3 contact_N, effects_N, force_N;
    for (uint32_t tick = 0; tick < 3; ++tick) {
      servo::LocalModel model;
      const Vec3 at_m{0, 0, static_cast<float>(random.between(-0.01, 0.001))};
      const Vec3 velocity_mps = random.force_N(0.1);
      scene::begin_model(model, at_m, tick, 3);
      model.plane[model.plane_count++] = {{0, 0, 1}, 0, 1000, 2};
      servo::GuideLine line;
      line.direction = {1, 0, 0};
      line.point_m = {0, 0.002f, 0};
      line.stiffness_N_per_m = 300;
      scene::add_guide(model, line);
      contact_N = servo::contact_N(model, at_m, velocity_mps);
      CHECK_LE(size(contact_N + servo::guide_N(model, at_m, velocity_mps) -
                    servo::evaluate(model, at_m, velocity_mps)),
               1e-5);
      scene::EffectSum sum(settings.force_limit_N, contact_N);
      sum.add(servo::guide_N(model, at_m, velocity_mps));
      sum.add(random.force_N(20));
      sum.put(at_m, model);
      effects_N = sum.force_N();
      CHECK(servo::is_sound(model));
      servo::StepInput input;
      input.position_m = at_m;
      input.velocity_mps = velocity_mps;
      input.tick = tick;
      input.enable = true;
      force_N = servo::step(state, settings, model, input).force_N;
    }
    CHECK_EQ(state.faults, 0u);
    const double kept = fmin(1, 6 / size(contact_N + effects_N));
    CHECK_LE(size(force_N - (contact_N + effects_N) * static_cast<float>(kept)), 2e-4);
    if (size(contact_N) <= 6) CHECK_LE(size(force_N - contact_N - effects_N), 2e-4);
  }
}

namespace {

// What the effect gave the hand on a way of `kSteps`, while contact takes the room in places.
template <class Effect, class Way, class Contact>
double given_J(bool is_stored, const Effect& effect, const Way& way, const Contact& contact_N,
               double& begin_J) {
  constexpr int kSteps = 20000;
  scene::EffectStore store;
  double given = 0;
  Vec3 last_m, last_N;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 at_m = way(double{1} * i / kSteps);
    const scene::EffectForce force = effect(at_m);
    if (i == 0) begin_J = double{force.potential_J};
    scene::EffectSum sum(3, contact_N(double{1} * i / kSteps, force.force_N));
    const float share = is_stored ? sum.add(force, store) : sum.add(force.force_N);
    CHECK(share >= 0 && share <= 1);
    const Vec3 now_N = sum.force_N();
    if (i > 0) given += double{math::dot((now_N + last_N) * 0.5f, at_m - last_m)};
    last_m = at_m, last_N = now_N;
  }
  return given - kSteps * 1e-6;
}

}  // namespace

// A hand that comes with the whole force and goes while contact leaves no room: ten times.
TEST(EffectStore_LoopsThatPayHalf_GiveNoEnergy) {
  const auto magnet = [](Vec3 at_m) { return scene::attraction_at({{}, 400, 0, 2, 0.05f}, at_m); };
  const auto notches = [](Vec3 at_m) { return scene::detents_at(rail(), at_m); };
  const auto to_and_fro = [](double part) {
    return Vec3{static_cast<float>(0.02 * std::cos(20 * kPi * part)), 0, 0};
  };
  const auto rising = [](double part, Vec3 force_N) {
    const float size_N = math::length(force_N);
    const bool is_leaving = std::sin(40 * kPi * part) < 0;  // cos^2 grows
    return is_leaving && size_N > 0 ? force_N * (3 / size_N) : Vec3{};
  };
  double begin_J = 0;
  const double paid_J = given_J(true, magnet, to_and_fro, rising, begin_J);
  CHECK_LE(paid_J, begin_J + 1e-4);
  const double unpaid_J = given_J(false, magnet, to_and_fro, rising, begin_J);
  CHECK_LE(0.5, unpaid_J);  // without a store such a hand is given half a joule
  // Up each notch's slope without room, down with it.
  const auto uphill = [](double part, Vec3 force_N) {
    const bool is_up = -double{force_N.x} * std::sin(20 * kPi * part) < 0;
    const float size_N = math::length(force_N);
    return is_up && size_N > 0 ? force_N * (3 / size_N) : Vec3{};
  };
  const double notches_J = given_J(true, notches, to_and_fro, uphill, begin_J);
  CHECK_LE(notches_J, begin_J + 1e-4);
  const double free_J = given_J(false, notches, to_and_fro, uphill, begin_J);
  CHECK_LE(0.3, free_J);
}

TEST(EffectStore_AnyHandAndContact_GiveAtMostWhatWasStored) {
  Random random(8);
  const auto knob = [](Vec3 at_m) {
    return scene::detents_at(scene::DetentRing{{}, {0, 0, 1}, {1, 0, 0}, 5, 0.004f, 1.5f}, at_m);
  };
  for (int run = 0; run < 40; ++run) {
    double phase[6], rate[6];
    for (int k = 0; k < 6; ++k)
      phase[k] = random.between(-kPi, kPi), rate[k] = random.between(2, 90);
    const auto wave = [&](int k, double part) {
      return static_cast<float>(std::sin(rate[k] * part + phase[k]));
    };
    const auto way = [&](double part) {
      return Vec3{0.02f * wave(0, part), 0.02f * wave(1, part), 0};
    };
    const auto contact_N = [&](double part, Vec3) {
      return Vec3{3 * wave(2, part), 3 * wave(3, part), 2 * wave(4, part)};
    };
    double begin_J = 0;
    CHECK_LE(given_J(true, knob, way, contact_N, begin_J), begin_J + 1e-4);
  }
}

TEST(EffectStore_RoomThatComesBack_GivesTheForceBack) {
  scene::EffectStore store;
  const Vec3 at_m{0.0005f, 0, 0};
  const scene::EffectForce force = scene::detents_at(rail(), at_m);
  for (int tick = 0; tick < 2000; ++tick) {
    const bool is_taken = tick < 10;
    scene::EffectSum sum(3, is_taken ? force.force_N * (3 / math::length(force.force_N)) : Vec3{});
    const float share = sum.add(force, store);
    if (tick < 10) CHECK_LE(share, 1e-3f);
    if (tick == 11) CHECK_EQ(share, 1.0f);  // the hand did not move: nothing was lost
  }
  // Lost on a way of 0.3 mm up the slope: back at 1e-6 J a tick.
  int back = 0;
  for (int tick = 0; tick < 4000; ++tick) {
    const bool is_taken = tick < 30;
    const scene::EffectForce here = scene::detents_at(
        rail(), {0.0002f + 1e-5f * static_cast<float>(tick < 30 ? tick : 30), 0, 0});
    scene::EffectSum sum(3, is_taken ? here.force_N * (3 / math::length(here.force_N)) : Vec3{});
    if (tick == 0) store = {};
    const float share = sum.add(here, store);
    if (tick == 31) CHECK_LE(share, 0.9f);
    if (share >= 1 && back == 0) back = tick;
  }
  CHECK_LE(100, back);
  CHECK_LE(back, 320);
}

TEST(EffectSum_HostileForces_LeaveASoundModel) {
  const float hostile[] = {NAN, INFINITY, -INFINITY, -1, 0, 3e38f};
  Random random(9);
  for (const float value : hostile) {
    scene::EffectSum none(value, {1, 0, 0});
    CHECK_EQ(scene::EffectSum(value, {}).add({1, 0, 0}), 0.0f);
    if (!(fabsf(value) <= 1)) {
      scene::EffectSum sum(5, {0, value, 0});
      CHECK_EQ(sum.add({1, 2, 3}), 0.0f);
    }
    scene::EffectSum sum(5, {1, 0, 0});
    if (!(fabsf(value) <= 1)) CHECK_EQ(sum.add({0, 0, value}), 0.0f);
    scene::EffectStore store;
    if (!(fabsf(value) <= 1)) CHECK_EQ(sum.add({{1, 0, 0}, value}, store), 0.0f);
    servo::LocalModel model;
    scene::begin_model(model, {}, 1, 3);
    sum.add({1, 0, 0});
    const bool is_put = sum.put({value, 0, 0}, model);
    CHECK_EQ(is_put, fabsf(value) <= 1);
    CHECK(servo::is_sound(model));
    CHECK(!scene::EffectSum(5, {}).put({}, model) && !model.has_guide);
  }
  // A store of any bits.
  for (int i = 0; i < 20000; ++i) {
    scene::EffectStore store;
    uint32_t bits[3];
    for (uint32_t& word : bits) word = random.bits();
    std::memcpy(&store.stored_J, &bits[0], 4);
    std::memcpy(&store.potential_J, &bits[1], 4);
    std::memcpy(&store.share, &bits[2], 4);
    store.is_used = true;
    scene::EffectSum sum(5, random.force_N(8));
    const float share = sum.add({random.force_N(8), 0.01f}, store);
    CHECK(share >= 0 && share <= 1);
    CHECK(store.stored_J >= 0 && store.stored_J <= 0.01f);
  }
}

TEST(EffectSum_VibrationBesideAGuide_HasItsForceAndTheGuideItsOwn) {
  const scene::Vibration buzz{{0.6f, 0, -0.8f}, 1.5f, 0.2f, 0, 0, 100, 0};
  for (uint32_t tick = 0; tick < 100; ++tick) {
    servo::LocalModel model;
    const Vec3 at_m{0.001f, 0.002f, 0.003f};
    scene::begin_model(model, at_m, tick, 3);
    servo::GuideLine line;
    line.direction = {1, 0, 0};
    line.stiffness_N_per_m = 300;
    scene::add_guide(model, line);
    const Vec3 guide_N = servo::guide_N(model, at_m, {});
    const float buzz_N = scene::vibration_N(buzz, tick);
    scene::EffectSum sum(8, {});
    CHECK_EQ(sum.add(guide_N), 1.0f);
    const float share = sum.add(buzz.direction, buzz_N);
    CHECK(share >= 1 || buzz_N * buzz_N <= 0);
    CHECK(sum.put(at_m, model));
    CHECK_LE(size(servo::evaluate(model, at_m, {}) - guide_N - buzz.direction * buzz_N), 1e-6);
  }
}

TEST(Model_BegunInAnyBits_IsSoundAndEmpty) {
  servo::LocalModel model;
  memset(static_cast<void*>(&model), 0xFF, sizeof model);
  scene::begin_model(model, {0.1f, 0.2f, 0.3f}, 7, 3);
  CHECK(servo::is_sound(model));
  CHECK(!model.spring.is_used && !model.spring.is_held && !model.is_uncertain &&
        !model.is_squeezed);
  CHECK_EQ(math::length(servo::evaluate(model, {0.2f, 0.1f, 0}, {1, 2, 3})), 0.0f);
  CHECK_EQ(model.expires_tick, 10u);
}
