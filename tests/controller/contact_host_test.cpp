// How contact begins, changes under load and ends, over the whole tick of a controller.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "controller/ride.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

// Penalty contact was silently absent with 8 visits: no force in 19,000 ticks, and no fault.
TEST(TooFewVisits_AreAFaultIn10ms) {
  Ride ride;
  uint32_t certain = 0;
  for (uint32_t tick = 0; tick < 1200; ++tick) {
    ride.fill(tick);
    if (tick == 200) {
      ride.input.command = 1 + params::kMeshWork;
      ride.input.command_value = 1;
    }
    ride.step();
    if ((ride.output.state & record::kStateUncertain) == 0) {
      certain = tick;
    } else {
      CHECK_LE(tick, certain + 10);
    }
    if (ride.output.faults != 0) break;
  }
  CHECK_EQ(ride.output.faults, servo::kFaultContact);
  CHECK_GE(certain, 200u);
}

// What the surface leaves of a tick's pool is the guide's. A query takes one visit at least.
TEST(QueriesOfATick_ShareItsWork_TheSurfaceFirst) {
  uint32_t short_guides = 0;
  for (const uint32_t pool : {1u, 3u, 20u, 60u, 200u}) {
    Ride ride;
    for (uint32_t tick = 0; tick < 1200; ++tick) {
      ride.fill(tick);
      ride.input.flags &= ~record::kFlagEnable;
      if (tick == 0) {
        ride.input.command = 1 + params::kTickWork;
        ride.input.command_value = params::kFixedTickWork + static_cast<float>(pool);
      }
      ride.step();
      if (tick == 0) CHECK((ride.output.state & record::kStateCommandTaken) != 0);
      const uint32_t of_surface = ride.output.steps - ride.output.guide_steps;
      CHECK_LE(of_surface, 3 * pool);  // at most three visits a unit
      const uint32_t left = pool > of_surface / 3 ? pool - of_surface / 3 : 0;
      CHECK_LE(ride.output.guide_steps, std::max(left, 1u));
      short_guides += (ride.output.state & record::kStateGuideExact) == 0 ? 1 : 0;
    }
  }
  CHECK_GE(short_guides, 1000u);
}

TEST(PoolBelowTheFixedCostOfATick_IsRefused_AndMayOnlyFallUnderPower) {
  Ride ride;
  const auto set = [&ride](uint32_t tick, float value) {
    ride.fill(tick);
    ride.input.command = 1 + params::kTickWork;
    ride.input.command_value = value;
    ride.step();
    return (ride.output.state & record::kStateCommandTaken) != 0;
  };
  CHECK(!set(0, 0.0f));
  CHECK(!set(1, params::kFixedTickWork));
  CHECK(!set(2, NAN));
  CHECK(set(3, params::kFixedTickWork + 1));
  CHECK(set(4, 2000.0f));
  ride.run(5, 200);
  CHECK(!set(200, 2001.0f));
  CHECK(set(201, 1000.0f));
  CHECK(!set(202, 1001.0f));
}

// Presses to a depth without a guide, then sets the stiffness.
struct Changed {
  double step_N = 0, before_N = 0, after_N = 0;  // greatest change in a tick; force 300 ticks after
};
Changed change_under_load(Ride& ride, float stiffness_N_per_m) {
  const auto press = [&ride](uint32_t tick, uint32_t parameter = 0, float value = 0) {
    ride.fill(400);
    ride.input.encoder_counts[2] +=
        1000 - static_cast<int32_t>(2 * std::clamp(tick, 300u, 700u) - 600);
    ride.input.tick = tick;
    ride.input.clock_us = tick * 1000u;
    ride.input.flags = tick < 10 ? 0 : record::kFlagEnable;
    if (tick == 0 || tick == 800) {
      ride.input.command = 1 + parameter;
      ride.input.command_value = value;
    }
    ride.step();
    return size_of(ride.output.force_N);
  };
  Changed changed;
  press(0, params::kGuideStiffness);
  for (uint32_t tick = 1; tick < 800; ++tick) changed.before_N = press(tick);
  CHECK_NE(ride.output.state & record::kStateContact, 0u);
  CHECK_GE(changed.before_N, 0.5);
  changed.after_N = changed.before_N;
  for (uint32_t tick = 800; tick < 1100; ++tick) {
    const double force_N = press(tick, params::kContactStiffness, stiffness_N_per_m);
    changed.step_N = std::max(changed.step_N, std::fabs(force_N - changed.after_N));
    changed.after_N = force_N;
  }
  return changed;
}

// A stiffness that was raised under load threw the hand at 0.68 m/s.
TEST(StiffnessRaisedUnderLoad_MakesNoStepOfTheForce) {
  Ride ride;
  CHECK_LE(change_under_load(ride, 8000).step_N, 1e-6);
  CHECK_NE(ride.output.state & record::kStateContact, 0u);
}

// For a hand that goes on pressing nothing changed for as long as it pressed.
TEST(StiffnessLoweredUnderLoad_ActsAtOnceWithoutAStepOfTheForce) {
  Ride ride;
  const float before = ride.controller.values()[params::kContactStiffness];
  const Changed changed = change_under_load(ride, before / 2);
  CHECK_LE(changed.step_N, 0.0201);  // 20 N/s
  CHECK_LE(std::fabs(changed.after_N - changed.before_N / 2), 1e-3);
  Ride to_nothing;
  const Changed gone = change_under_load(to_nothing, 0);
  CHECK_LE(gone.step_N, 0.0201);
  CHECK_LE(gone.after_N, 1e-3);
}

// A proxy waited at the surface for a hand that had gone through it: it was never touched again.
TEST(SurfaceWithoutStiffness_HoldsNothingAndIsThereAgainWhenItHasOne) {
  Ride ride;
  const auto step = [&ride](uint32_t tick, uint32_t place, int32_t counts, uint32_t parameter = 0,
                            float value = 0) {
    ride.fill(place);
    ride.input.encoder_counts[2] += counts;
    ride.input.tick = tick;
    ride.input.clock_us = tick * 1000u;
    ride.input.flags = tick < 10 ? 0 : record::kFlagEnable;
    if (parameter != 0) {
      ride.input.command = 1 + parameter;
      ride.input.command_value = value;
    }
    ride.step();
    return size_of(ride.output.force_N);
  };
  uint32_t tick = 0;
  for (; tick < 300; ++tick) step(tick, 400, 1000);
  step(tick++, 400, 1000, params::kGuideStiffness, 0);
  step(tick++, 400, 1000, params::kContactStiffness, 0);
  // In through the surface, to stay there, and out of the part below.
  double most_N = 0;
  int32_t height = 1000;
  for (; height > -200; height -= 2) most_N = std::max(most_N, step(tick++, 400, height));
  for (uint32_t i = 0; i < 12000; ++i) most_N = std::max(most_N, step(tick++, 400, height));
  CHECK_LE(most_N, 0.05);  // the damper's
  CHECK_EQ(ride.output.faults, 0u);
  most_N = step(tick++, 400, height, params::kContactStiffness, 1200);
  for (uint32_t i = 0; i < 500; ++i) most_N = std::max(most_N, step(tick++, 400, height));
  CHECK_LE(most_N, 1.01);  // led out
  step(tick++, 400, height, params::kContactStiffness, 0);
  for (; height > -7000; height -= 4) step(tick++, 400, height);
  step(tick++, 400, height, params::kContactStiffness, 1200);
  while (height < 0 && most_N < 2) most_N = std::max(most_N, step(tick++, 400, height += 2));
  CHECK_GE(most_N, 2.0);  // from below
  CHECK_GE(ride.output.force_N[2], -8.0f);
  CHECK_LE(ride.output.force_N[2], -1.0f);
  CHECK_EQ(ride.output.faults, 0u);
}

// The scene moves while the motors are off and the hand rests to the last bit: what was certified
// about it no longer holds. The oracle is a controller in whose scene the part never was elsewhere.
TEST(SceneMoved_UnderAHandThatRests_ContactBeginsAnew) {
  constexpr float kLifts_m[] = {0.002f, -0.001f, -0.01f, 0.005f};
  for (const float lift_m : kLifts_m) {
    Ride moved, never;
    const auto both_set = [&](uint32_t moves, uint32_t set_at) {
      for (uint32_t tick = 0; tick < 40; ++tick) {
        Ride& ride = set_at == 0 ? never : moved;
        ride.fill(143);  // free
        ride.input.tick = tick;
        ride.input.clock_us = tick * 1000u;
        ride.input.flags = tick < 20 ? 0 : record::kFlagEnable;
        if (tick == set_at) {
          ride.input.command = 1 + moves;
          ride.input.command_value = lift_m;
        }
        ride.step();
        if (tick == set_at) CHECK((ride.output.state & record::kStateCommandTaken) != 0);
      }
    };
    both_set(params::kSceneZ, 0);
    both_set(params::kSceneZ, 10);
    CHECK_EQ(moved.output.faults, 0u);
    CHECK_EQ(moved.output.distance_m, never.output.distance_m);
    for (int k = 0; k < 3; ++k) CHECK_EQ(moved.output.proxy_m[k], never.output.proxy_m[k]);
  }
}
