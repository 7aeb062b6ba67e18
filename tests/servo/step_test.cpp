// The servo step: what it renders, what it limits, and when it lets go.
#include "firmtouch/servo/step.hpp"

#include <stdint.h>

#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace servo = firmtouch::servo;

namespace {

const servo::Settings kSettings{8.0f, 5000.0f, 0.05f, 0.001f};

servo::LocalModel floor_model() {  // free above z = 0
  servo::LocalModel model;
  model.plane[0].normal = {0, 0, 1};
  model.plane[0].stiffness_N_per_m = 1000.0f;
  model.plane[0].damping_N_s_per_m = 2.0f;
  model.plane_count = 1;
  model.expires_tick = 1000000;
  return model;
}

servo::StepInput at(float z_m, uint32_t tick) {
  servo::StepInput input;
  input.position_m = {0, 0, z_m};
  input.tick = tick;
  input.enable = true;
  return input;
}

// A servo that has been on for long, pressed 1 mm into the floor.
servo::State pressed(const servo::LocalModel& model) {
  servo::State state;
  for (uint32_t tick = 0; tick < 100; ++tick)
    (void)servo::step(state, kSettings, model, at(-0.001f, tick));
  return state;
}

}  // namespace

TEST(FloorPushesByItsSpringAndNotAbove) {
  const servo::LocalModel model = floor_model();
  CHECK_EQ(servo::evaluate(model, {0, 0, 0.001f}, {}).z, 0.0f);
  CHECK_EQ(servo::evaluate(model, {3, 4, -0.5f}, {}).z, 500.0f);
  CHECK_EQ(servo::evaluate(model, {3, 4, -0.5f}, {1, 1, -1}).z, 502.0f);
}

TEST(Plane_AnyLeavingSpeed_NeverPulls) {
  const servo::LocalModel model = floor_model();
  for (int i = 0; i < 200; ++i) {
    const float speed = static_cast<float>(i);
    CHECK_GE(servo::evaluate(model, {0, 0, -0.001f}, {0, 0, speed}).z, 0.0f);
    CHECK_EQ(servo::evaluate(model, {0, 0, 0.0001f}, {0, 0, -speed}).z, 0.0f);
  }
}

TEST(GuidePullsAcrossItsLineOnly) {
  servo::LocalModel model;
  model.guide.point_m = {1, 2, 3};
  model.guide.direction = {0, 1, 0};
  model.guide.stiffness_N_per_m = 100.0f;
  model.guide.damping_N_s_per_m = 10.0f;
  model.has_guide = true;
  const math::Vec3 force = servo::evaluate(model, {1.5f, 77, 2}, {0.5f, 9, 0});
  CHECK_EQ(force.x, -55.0f);
  CHECK_EQ(force.y, 0.0f);
  CHECK_EQ(force.z, 100.0f);
}

TEST(ForceRampsInAfterEnable) {
  servo::State state;
  const servo::LocalModel model = floor_model();
  for (uint32_t tick = 1; tick <= 60; ++tick) {
    const servo::StepOutput output = servo::step(state, kSettings, model, at(-0.001f, tick));
    const float share = tick < 50 ? static_cast<float>(tick) / 50.0f : 1.0f;
    CHECK_LE(output.force_N.z, share * 1.0001f);
    CHECK_GE(output.force_N.z, share * 0.9999f);
    CHECK_EQ(static_cast<int>(output.mode),
             static_cast<int>(tick < 50 ? servo::Mode::kRampIn : servo::Mode::kOn));
  }
}

TEST(LongerRampIn_OfAForceThatIsOn_TakesNothingAway) {
  const servo::LocalModel model = floor_model();
  servo::State state = pressed(model);
  servo::Settings longer = kSettings;
  longer.ramp_in_s = 10.0f;
  for (uint32_t tick = 100; tick < 110; ++tick) {
    const servo::StepOutput output = servo::step(state, longer, model, at(-0.001f, tick));
    CHECK_EQ(output.force_N.z, 1.0f);
    CHECK_EQ(static_cast<int>(output.mode), static_cast<int>(servo::Mode::kOn));
  }
}

TEST(NothingIsRenderedUnlessEnabled) {
  servo::State state;
  servo::StepInput input = at(-0.1f, 0);
  input.enable = false;
  for (int i = 0; i < 10; ++i)
    CHECK_EQ(servo::step(state, kSettings, floor_model(), input).force_N.z, 0.0f);
}

TEST(Force_StopsAtItsLimit_GrowsByItsSlew) {
  servo::State state = pressed(floor_model());
  float before = state.force_N.z;
  for (uint32_t tick = 100; tick < 120; ++tick) {
    const servo::StepOutput output = servo::step(state, kSettings, floor_model(), at(-1.0f, tick));
    CHECK_LE(output.force_N.z, 8.0f);
    CHECK_LE(output.force_N.z - before, 5.0f);
    before = output.force_N.z;
  }
  CHECK_GE(before, 7.9999f);
}

TEST(Disable_ForceEndsWithin10Milliseconds) {
  servo::State state = pressed(floor_model());
  servo::StepInput input = at(-0.001f, 100);
  input.enable = false;
  float before = state.force_N.z;
  for (int tick = 1; tick <= 10; ++tick) {
    const servo::StepOutput output = servo::step(state, kSettings, floor_model(), input);
    CHECK_LE(output.force_N.z, before);
    CHECK_GE(before - output.force_N.z, tick <= 8 ? 0.12f : 0.0f);
    before = output.force_N.z;
  }
  CHECK_EQ(before, 0.0f);
  CHECK_EQ(state.faults, 0u);
  CHECK(state.mode == servo::Mode::kOff);
}

TEST(EachFaultIsLatchedInItsTickAndLeavesNoForceTenMillisecondsLater) {
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit) {
    servo::State state = pressed(floor_model());
    servo::StepInput input = at(-0.001f, 100);
    input.reported = 1u << bit;
    servo::StepOutput output = servo::step(state, kSettings, floor_model(), input);
    CHECK_EQ(output.faults, 1u << bit);
    const bool at_once = ((1u << bit) & servo::kCutAtOnce) != 0;
    CHECK_EQ(output.force_N.z > 0.0f, !at_once);
    input.reported = 0;  // gone again: the latch stays
    for (int tick = 0; tick < 9; ++tick)
      output = servo::step(state, kSettings, floor_model(), input);
    CHECK_EQ(output.force_N.z, 0.0f);
    CHECK_EQ(output.faults, 1u << bit);
    CHECK(output.mode == servo::Mode::kFault);
    CHECK(servo::fault_name(bit)[0] != 0);
  }
}

TEST(SqueezedProxy_IsAFaultInItsTickThatLetsGo) {
  servo::State state = pressed(floor_model());
  servo::LocalModel model = floor_model();
  model.is_squeezed = true;
  servo::StepOutput output = servo::step(state, kSettings, model, at(-0.001f, 100));
  CHECK_EQ(output.faults, servo::kFaultSqueezed);
  CHECK_GE(output.force_N.z, 0.01f);  // no sudden loss of support
  for (int tick = 0; tick < 9; ++tick)
    output = servo::step(state, kSettings, model, at(-0.001f, 100));
  CHECK_EQ(output.force_N.z, 0.0f);
}

// A damper against the speed of the hand alone would pull at a hand that goes along.
TEST(ProxyOfAMovingObject_DampsTheMotionRelativeToIt) {
  servo::LocalModel model = floor_model();
  model.plane_count = 0;
  model.spring.is_used = model.spring.is_held = true;
  model.spring.stiffness_N_per_m = 100;
  model.spring.damping_N_s_per_m = 1;
  model.spring.velocity_mps = {0, 0, 0.05f};
  servo::Settings settings = kSettings;
  settings.energy.reservoir_J = 1;
  for (int k = 0; k < 2; ++k) {
    const bool is_along = k == 0;
    servo::State state = pressed(floor_model());
    servo::StepInput input = at(-0.001f, 100);
    input.velocity_mps = {0, 0, is_along ? 0.05f : 0.0f};
    servo::StepOutput output;
    for (int tick = 0; tick < 20; ++tick) output = servo::step(state, settings, model, input);
    CHECK_LE(output.force_N.z, is_along ? 0.1001f : 0.1501f);
    CHECK_GE(output.force_N.z, is_along ? 0.0999f : 0.1499f);
  }
}

TEST(LatchOpensOnlyByAClearWhileDisabled) {
  servo::State state = pressed(floor_model());
  servo::StepInput input = at(-0.001f, 100);
  input.reported = servo::kFaultEmergencyStop;
  (void)servo::step(state, kSettings, floor_model(), input);
  input.reported = 0;
  input.clear_faults = true;
  CHECK_NE(servo::step(state, kSettings, floor_model(), input).faults, 0u);  // enable is still high
  input.enable = false;
  CHECK_EQ(servo::step(state, kSettings, floor_model(), input).faults, 0u);
  input.clear_faults = false;
  input.enable = true;
  const servo::StepOutput output = servo::step(state, kSettings, floor_model(), input);
  CHECK(output.mode == servo::Mode::kRampIn);
  CHECK_GE(output.force_N.z, 0.01f);
}

TEST(TimingAndEncoderFaults_OnlyWhileMotorsAreOn) {
  servo::State state;
  servo::StepInput input = at(-0.001f, 0);
  input.enable = false;
  input.reported = servo::kOnlyWhileOn;
  CHECK_EQ(servo::step(state, kSettings, floor_model(), input).faults, 0u);
  input.enable = true;
  CHECK_EQ(servo::step(state, kSettings, floor_model(), input).faults, servo::kOnlyWhileOn);
}

TEST(EnablingOverAFaultThatStandsPushesInNoTick) {
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit) {
    servo::Settings at_once = kSettings;
    at_once.ramp_in_s = 0;
    servo::State state;
    servo::StepInput input = at(-0.001f, 0);
    input.reported = 1u << bit;
    input.enable = false;
    (void)servo::step(state, at_once, floor_model(), input);
    input.enable = true;
    for (int tick = 0; tick < 3; ++tick) {
      const servo::StepOutput output = servo::step(state, at_once, floor_model(), input);
      CHECK_EQ(output.faults, 1u << bit);
      CHECK_EQ(output.force_N.z, 0.0f);
      CHECK(output.mode == servo::Mode::kFault);
    }
  }
  servo::State state;  // a model that expired is no different
  servo::LocalModel stale = floor_model();
  stale.expires_tick = 3;
  const servo::StepOutput output = servo::step(state, kSettings, stale, at(-0.001f, 4));
  CHECK_EQ(output.faults, servo::kFaultStaleModel);
  CHECK_EQ(output.force_N.z, 0.0f);
}

// Models are uncertain while a tool of several spheres finds its surface. At two rates one of them
// lasts for 20 ticks: 27 of 300 calm hands were refused in the tick that enabled them.
TEST(Enabling_UncertainModel_WaitsForACertainOneWithoutForce) {
  servo::Settings at_once = kSettings;
  at_once.ramp_in_s = 0;
  servo::LocalModel uncertain = floor_model();
  uncertain.is_uncertain = true;
  for (int k = 0; k < 2; ++k) {
    const bool becomes_certain = k == 0;
    servo::State state;
    servo::StepInput input = at(-0.001f, 0);
    input.enable = false;
    for (int tick = 0; tick < 300; ++tick) (void)servo::step(state, at_once, uncertain, input);
    input.enable = true;
    for (int tick = 0; tick < 199; ++tick) {
      const servo::StepOutput output = servo::step(state, at_once, uncertain, input);
      CHECK_EQ(output.faults, 0u);
      CHECK_EQ(output.force_N.z, 0.0f);
      CHECK(output.mode == servo::Mode::kOff);
    }
    const servo::LocalModel last = becomes_certain ? floor_model() : uncertain;
    const servo::StepOutput output = servo::step(state, at_once, last, input);
    CHECK_EQ(output.faults, becomes_certain ? 0u : servo::kFaultContact);
    CHECK_EQ(output.force_N.z > 0, becomes_certain);
    CHECK(output.mode == (becomes_certain ? servo::Mode::kOn : servo::Mode::kFault));
  }
}

TEST(UncertainModel_WhileOn_IsAFaultIn10ms) {
  servo::State state = pressed(floor_model());
  servo::LocalModel uncertain = floor_model();
  uncertain.is_uncertain = true;
  for (int times = 0; times < 3; ++times) {  // a certain one begins the time again
    for (int tick = 0; tick < 9; ++tick)
      CHECK_EQ(servo::step(state, kSettings, uncertain, at(-0.001f, 100)).faults, 0u);
    if (times < 2) (void)servo::step(state, kSettings, floor_model(), at(-0.001f, 100));
  }
  const servo::StepOutput output = servo::step(state, kSettings, uncertain, at(-0.001f, 100));
  CHECK_EQ(output.faults, servo::kFaultContact);
  CHECK(output.mode == servo::Mode::kRampOut);
}

TEST(SettingsBeyondTheCeilingAreAFaultThatCutsAtOnce) {
  for (int field = 0; field < 3; ++field) {
    servo::State state = pressed(floor_model());
    servo::Settings bent = kSettings;
    if (field == 0) bent.force_limit_N = 128.0f;
    if (field == 1) bent.slew_limit_N_per_s = 1.1e6f;
    if (field == 2) bent.tick_period_s = 0.11f;
    const servo::StepOutput output = servo::step(state, bent, floor_model(), at(-0.001f, 100));
    CHECK_EQ(output.faults, servo::kFaultSettings);
    CHECK_EQ(output.force_N.z, 0.0f);
  }
}

TEST(StaleModelIsLetGoOfInItsTickAndAcrossTheWrap) {
  const uint32_t ages[] = {0, 5, 0x7FFFFFF0u, 0xFFFFFFFDu};
  for (const uint32_t made : ages) {
    servo::LocalModel model = floor_model();
    model.expires_tick = made + 3;
    servo::State state;
    for (uint32_t k = 0; k <= 3; ++k) {
      CHECK_EQ(servo::step(state, kSettings, model, at(-0.001f, made + k)).faults, 0u);
    }
    CHECK_EQ(servo::step(state, kSettings, model, at(-0.001f, made + 4)).faults,
             servo::kFaultStaleModel);
  }
}

TEST(LoweredLimitTakesForceAwayAtOnce) {
  servo::State state = pressed(floor_model());
  servo::Settings low = kSettings;
  low.force_limit_N = 0.25f;
  CHECK_LE(servo::step(state, low, floor_model(), at(-0.001f, 100)).force_N.z, 0.25f);
  low.force_limit_N = 0.0f;
  CHECK_EQ(servo::step(state, low, floor_model(), at(-0.001f, 101)).force_N.z, 0.0f);
}
