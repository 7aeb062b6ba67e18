// Energy that contact may give to the hand: what the observer counts and what it holds back.
#include "firmtouch/servo/energy.hpp"

#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"
#include "specials.hpp"

namespace math = firmtouch::math;
namespace servo = firmtouch::servo;
using firmtouch::test::kSpecialBits;

namespace {

constexpr float kReservoir_J = 0.0005f;
constexpr float kStiffness_N_per_m = 5000.0f;

servo::Settings settings(float reservoir_J) {
  return {8.0f, 1e5f, 0.0f, 0.001f, {reservoir_J, 0.0f}};
}

// A wall at z = 0 that holds the proxy of a tool below it.
servo::LocalModel wall(float z_m) {
  servo::LocalModel model;
  model.spring.is_used = true;
  model.spring.is_held = z_m < 0;
  model.spring.reach_m = 1.0f;
  model.spring.stiffness_N_per_m = kStiffness_N_per_m;
  model.expires_tick = 1000000;
  return model;
}

// A tool that something else moves, and its energy account in double.
struct Tool {
  explicit Tool(float reservoir_J) : limits(settings(reservoir_J)) {}
  servo::StepOutput at(float z_m, bool is_wall_there = true) {
    given_J +=
        static_cast<double>(force_N) * (static_cast<double>(z_m) - static_cast<double>(at_m));
    servo::StepInput input;
    input.position_m = {0, 0, z_m};
    input.tick = tick++;
    input.enable = true;
    const servo::StepOutput output =
        servo::step(state, limits, wall(is_wall_there ? z_m : 1.0f), input);
    at_m = z_m;
    force_N = output.force_N.z;
    return output;
  }
  // Into the wall from outside.
  void press(int ticks) {
    at(0.0001f);
    for (int i = 0; i < ticks; ++i) at(-0.0016f);
  }
  servo::Settings limits;
  servo::State state;
  double given_J = 0;
  float at_m = 0.01f, force_N = 0;
  uint32_t tick = 0;
};

// In and out of the wall by a sine: a sampled spring gives energy in each period.
double given_by_sine_J(float reservoir_J, uint32_t ticks, float period_ticks) {
  Tool tool(reservoir_J);
  float x = 0.001f, v = 0;  // a rotation that stays on its ellipse (symplectic)
  const float turn = 6.2831853f / period_ticks;
  for (uint32_t i = 0; i < ticks || x < 0.0005f; ++i) {  // and out
    v = v - turn * x;
    x = x + turn * v;
    (void)tool.at(x);
  }
  return tool.given_J;
}

}  // namespace

// A reservoir that was raised before enabling filled up from what contact dissipates alone.
TEST(Energy_WhenEnabled_TheReservoirIsFull) {
  servo::StepInput input;
  input.position_m = {0, 0, 0.0001f};
  const float both_J[] = {0.0f, 1.0f};
  for (const float reservoir_J : both_J) {
    servo::State state;
    input.enable = false;
    (void)servo::step(state, settings(0.5f), wall(1.0f), input);
    (void)servo::step(state, settings(reservoir_J), wall(1.0f), input);
    input.enable = true;
    for (int i = 0; i < 2; ++i) {
      (void)servo::step(state, settings(reservoir_J), wall(1.0f), input);
      ++input.tick;
    }
    CHECK_EQ(state.reservoir_J, reservoir_J);
    (void)servo::step(state, settings(2.0f), wall(1.0f), input);
    CHECK_EQ(state.reservoir_J, reservoir_J);
  }
}

// At 5 N a tick a tool that leaves fast was pushed on outside of the wall.
TEST(Energy_ToolThatLeft_IsPushedNoMore) {
  Tool tool(kReservoir_J);
  tool.limits.slew_limit_N_per_s = 5000;
  tool.press(4);
  CHECK_GE(tool.force_N, 7.9f);
  CHECK_LE(tool.at(0.0001f).force_N.z, 0.0f);
}

// Nor by more than its spring where it is still inside: 2.5 N held for a tick gave 2.4 mJ.
TEST(Energy_ToolThatAllButLeft_IsPushedByItsSpringAlone) {
  Tool tool(0.0135f);  // what it gives in the last tick, and 0.8 mJ
  tool.limits.slew_limit_N_per_s = 5000;
  tool.press(4);
  CHECK_LE(tool.at(-0.00001f).force_N.z, kStiffness_N_per_m * 0.0000101f);
}

// At two rates a model may say late that the tool is in free space: its force fell by its slew
// limit while the hand turned, gave 5 mJ that the wall no longer stored, and was a fault.
TEST(Energy_WallThatWentAway_PushesNoMore) {
  Tool tool(kReservoir_J);
  tool.limits.slew_limit_N_per_s = 1000;
  tool.press(20);
  CHECK_GE(tool.force_N, 7.9f);
  const double before_J = tool.given_J;
  CHECK_GE(tool.at(-0.0016f, false).force_N.z, 6.9f);  // by its slew limit
  for (float z_m = -0.0014f; z_m < 0.0f; z_m += 0.0002f) {
    CHECK_LE(tool.at(z_m, false).force_N.z, 0.0f);
    CHECK_EQ(tool.state.faults, 0u);
  }
  CHECK_LE(tool.given_J - before_J, 0.0015);  // of one tick
}

TEST(Energy_ToolThatTurnsAfterAnUnpaidTick_IsResistedByItsWholeStep) {
  Tool tool(0.0129f);  // what it gives in the tick before it turns, and 0.18 mJ
  tool.limits.slew_limit_N_per_s = 5000;
  tool.press(4);
  tool.at(-0.00001f);
  CHECK_GE(tool.at(-0.0003f).force_N.z, kStiffness_N_per_m * 0.0002999f);
}

TEST(Energy_AnySine_GivesNoMoreThanTheReservoir) {
  const float periods[] = {10.0f, 12.7f, 20.0f, 60.0f};
  for (const float period : periods) {
    CHECK_GE(given_by_sine_J(1000.0f, 2000, period), 0.004);  // it shows that the next can fail
    CHECK_LE(given_by_sine_J(kReservoir_J, 2000, period), 0.00051);
  }
}

TEST(Energy_SlowPress_IsRenderedInFull) {
  Tool tool(kReservoir_J);
  for (int i = 0; i <= 1000; ++i) {
    const float z_m = -1e-6f * static_cast<float>(i);
    CHECK_GE(tool.at(z_m).force_N.z, kStiffness_N_per_m * -z_m * 0.999999f);
  }
}

TEST(Energy_AnEmptyReservoir_DoesNotHideTheWallFromASlowHand) {
  Tool tool(0);
  float z_m = 0, last_N = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i % 10 == 0) z_m = z_m - 1e-5f;  // a count of the encoder
    const float force_N = tool.at(z_m).force_N.z;
    CHECK_GE(force_N, last_N * 0.999999f);
    last_N = force_N;
  }
  CHECK_GE(last_N, 7.0f);  // of 8 N with a full reservoir
  CHECK_EQ(tool.state.faults, 0u);
}

TEST(Energy_HandThatOutruns_IsAFaultIn10ms) {
  Tool tool(kReservoir_J);
  uint32_t latched = 0;
  for (uint32_t i = 0; i < 200 && latched == 0; ++i) {
    // Whenever the wall holds a force, the tool leaps out against all that came before.
    const servo::StepOutput output = tool.at(i % 2 == 0 ? -0.0008f : 0.004f);
    if ((output.faults & servo::kFaultEnergy) != 0) latched = i;
  }
  CHECK_GE(latched, 1u);
  CHECK_LE(latched, 20u);
}

TEST(Energy_GuideBeyondTheForceLimit_IsNotCounted) {
  servo::State state;
  for (uint32_t i = 0; i < 400; ++i) {
    servo::LocalModel model = wall(0.001f);
    model.has_guide = true;
    model.guide.direction = {1, 0, 0};
    model.guide.stiffness_N_per_m = 2000.0f;
    servo::StepInput input;
    const float phase = static_cast<float>(i % 40) * 0.05f - 1.0f;
    input.position_m = {0, 0, 0.02f * (phase < 0 ? -phase : phase)};  // to and fro across it
    input.tick = i;
    input.enable = true;
    const servo::StepOutput output = servo::step(state, settings(kReservoir_J), model, input);
    CHECK_EQ(output.faults, 0u);
    CHECK_GE(state.energy.saved_J, -0.1f * kReservoir_J);  // owes nothing
  }
}

// A drive that turns faster than the slew limit, while the tool rests in the wall and slides along
// it. What the motors lag behind the drive was taken for contact's: a vibration of 3 N and 400 Hz
// emptied the account of a wall that gave nothing, until it pushed no more.
TEST(Energy_DriveBeyondTheSlewLimit_IsNotCounted) {
  constexpr float kDepth_m = 0.001f, kStored_J = 0.5f * kStiffness_N_per_m * kDepth_m * kDepth_m;
  servo::Settings slow = settings(kReservoir_J);
  slow.slew_limit_N_per_s = 1000;
  servo::State state;
  for (uint32_t i = 0; i < 2000; ++i) {
    servo::LocalModel model = wall(-kDepth_m);
    model.spring.anchor_m = {0.0002f * static_cast<float>(i), 0, 0};
    model.has_guide = true;
    model.guide.direction = {1, 0, 0};
    model.guide.drive_N = i % 40 < 20 ? 2.0f : -2.0f;
    model.guide.drive_limit_N = 2.0f;
    servo::StepInput input;
    input.position_m = {model.spring.anchor_m.x, 0, -kDepth_m};
    input.tick = i;
    input.enable = true;
    const servo::StepOutput output = servo::step(state, slow, model, input);
    CHECK_EQ(output.faults, 0u);
    if (i < 40) continue;  // the force rises by its slew limit
    CHECK_GE(state.energy.saved_J + state.reservoir_J, 0.99f * (kStored_J + kReservoir_J));
    CHECK_GE(output.force_N.z, 0.99f * kStiffness_N_per_m * kDepth_m);
  }
}

// The same, with a tool that leaves: its force falls at once, however long the drive's beside it.
// At 200 N/s a drive of 6 N along the wall let it push for 35 mJ.
TEST(Energy_ToolThatLeavesBesideADrive_IsGivenNoMoreThanTheReservoir) {
  const float drives_N[] = {0.0f, 2.0f, 6.0f};
  for (const float drive_N : drives_N) {
    servo::Settings slow = settings(kReservoir_J);
    slow.slew_limit_N_per_s = 200;
    servo::State state;
    float z_m = 0.001f, force_N = 0, given_J = 0;
    for (uint32_t i = 0; i < 300; ++i) {
      const float last_m = z_m;
      z_m += i < 100 ? -2.5e-5f : i < 200 ? 0.0f : 2.5e-4f;
      given_J += force_N * (z_m - last_m);
      servo::LocalModel model = wall(z_m);
      model.has_guide = true;
      model.guide.direction = {1, 0, 0};
      model.guide.drive_N = model.guide.drive_limit_N = drive_N;
      servo::StepInput input;
      input.position_m = {0, 0, z_m};
      input.tick = i;
      input.enable = true;
      const servo::StepOutput output = servo::step(state, slow, model, input);
      CHECK_EQ(output.faults, 0u);
      force_N = output.force_N.z;
      if (i == 199) CHECK_GE(force_N, 5.0f);
    }
    CHECK_LE(given_J, 1.01f * kReservoir_J);
  }
}

// A tool that had left the ball of a model 20 ms old, and was on its way back, was given 1.9 mJ.
TEST(Energy_BallOfALateModelThatTheToolLeft_PullsWithWhatIsPaidFor) {
  const float before_m[] = {0.00557f, 0.005f};
  for (const float last_m : before_m) {
    servo::LocalModel model = wall(1.0f);
    servo::State state;
    servo::StepInput input;
    servo::StepOutput output;
    input.enable = true;
    for (input.tick = 1; input.tick < 4; ++input.tick) {
      input.position_m = {0, 0, input.tick < 3 ? last_m : 0.0053f};
      if (input.tick == 3) model.made_tick = 1, model.spring.reach_m = 0.005f;
      model.spring.stiffness_N_per_m = 20000;
      output = servo::step(state, settings(kReservoir_J), model, input);
    }
    const bool is_leaving = last_m > 0.0053f;
    CHECK_LE(output.force_N.z, is_leaving ? -0.9f : -5.9f);
    CHECK_GE(output.force_N.z, is_leaving ? -1.0f : -6.1f);
  }
}

// The proxy that each tick's own model moves along is no motion of the tool away from it.
TEST(Energy_SlideWithAnEmptyReservoir_KeepsItsForce) {
  constexpr float kDepth_m = 0.001f;
  servo::State state;
  servo::StepInput input;
  input.enable = true;
  for (input.tick = 1; input.tick < 60; ++input.tick) {
    const float x_m = 0.0001f * static_cast<float>(input.tick);
    input.position_m = {x_m, 0, -kDepth_m};
    servo::LocalModel model = wall(-kDepth_m);
    model.spring.anchor_m = {x_m, 0, 0};
    model.made_tick = input.tick;
    const servo::StepOutput output = servo::step(state, settings(kReservoir_J), model, input);
    if (input.tick == 10) state.energy.saved_J = state.reservoir_J = 0;
    if (input.tick > 1) CHECK_GE(output.force_N.z, 0.999f * kStiffness_N_per_m * kDepth_m);
  }
}

// Something else moves the proxy on, as a turn of the tool does, and the hand gives way.
TEST(Energy_StretchThatGrowsWhileTheHandGivesWay_GivesNoMoreThanTheReservoir) {
  servo::Energy energy;
  float left_J = kReservoir_J, stretch_m = 0, force_N = 0;
  double given_J = 0;
  for (int i = 0; i < 200; ++i) {
    const float move_m = i < 50 ? 0.0f : 0.00005f;
    given_J += static_cast<double>(force_N) * static_cast<double>(move_m);
    stretch_m += 0.00001f;
    const float payable_m = servo::payable_stretch_m(
        energy, left_J, {kReservoir_J, 0.0f}, kStiffness_N_per_m, stretch_m, {0, 0, move_m}, {});
    force_N = kStiffness_N_per_m * payable_m;
    energy.force_N = {0, 0, force_N};
    CHECK_EQ(energy.overdrawn_ticks, 0u);
  }
  CHECK_LE(given_J, static_cast<double>(kReservoir_J) + 0.0002);
}

// A hand in the corner of a guide and a wall got a reservoir from each.
TEST(Energy_TwoSprings_GiveOneReservoir) {
  constexpr servo::EnergySettings kSettings{kReservoir_J, 0};
  constexpr float kForce_N = 1, kMove_m = 0.00001f;
  servo::Energy spring[2];
  float left_J = kReservoir_J;
  const auto gives_J = [&](int which, float move_m, int ticks) {
    float given_J = 0;
    for (int i = 0; i < ticks; ++i) {
      const float payable_m = servo::payable_stretch_m(spring[which], left_J, kSettings, 1000,
                                                       kForce_N / 1000, {0, 0, move_m}, {});
      const float force_N = 1000 * payable_m;
      spring[which].force_N = {0, 0, force_N};
      given_J += force_N * move_m;
    }
    return given_J;
  };
  (void)(gives_J(0, 0, 2) + gives_J(1, 0, 2));
  spring[0].saved_J = spring[1].saved_J = 0;  // stretched by nobody's work
  const float first_J = gives_J(0, kMove_m, 200);
  CHECK(first_J >= 0.98f * kReservoir_J && first_J <= 1.02f * kReservoir_J);
  CHECK_LE(gives_J(1, kMove_m, 200), 0.02f * kReservoir_J);
  for (int i = 0; i < 100; ++i) {  // a damper takes it back
    spring[0].force_N = {0, 0, kForce_N};
    (void)servo::payable_stretch_m(spring[0], left_J, kSettings, 1000, 0, {0, 0, -kMove_m}, {});
  }
  CHECK_GE(left_J, 0.98f * kReservoir_J);
  CHECK_GE(gives_J(1, kMove_m, 200), 0.98f * kReservoir_J);
}

// A square of the motion credited 19 uW that no friction took: a hand got it from a guide for as
// long as it liked.
TEST(Energy_FrictionOfMotion_Fills_EncoderStepsToAndFroDoNot) {
  constexpr float kFriction_N_per_m = 500;
  const auto filled_J = [](const float(&moves_m)[4]) {
    servo::Energy energy;
    energy.saved_J = 0;
    float left_J = 0, before_m = moves_m[3];
    for (int i = 0; i < 40; ++i) {
      const float move_m = moves_m[i % 4];
      (void)servo::payable_stretch_m(energy, left_J, {1.0f, kFriction_N_per_m}, kStiffness_N_per_m,
                                     0, {0, 0, move_m}, {0, 0, before_m});
      before_m = move_m;
    }
    return left_J;
  };
  constexpr float kCount_m = 1e-5f, kTaken_J = kFriction_N_per_m * kCount_m * kCount_m;
  CHECK_EQ(filled_J({kCount_m, -kCount_m, kCount_m, -kCount_m}), 0.0f);
  CHECK_EQ(filled_J({kCount_m, 0, 0, 0}), 0.0f);  // a quarter of a count a tick takes 2.5 of these
  CHECK_LE(filled_J({kCount_m, kCount_m, kCount_m, 0}), 22.5f * kTaken_J);  // three quarters
  const float even_J = filled_J({kCount_m, kCount_m, kCount_m, kCount_m});
  CHECK(even_J >= 39.9f * kTaken_J && even_J <= 40.1f * kTaken_J);
}

TEST(Energy_EverySpecial_LeavesAStretchThatIsFiniteAndFillsNothing) {
  for (const uint32_t a : kSpecialBits)
    for (const uint32_t b : kSpecialBits) {
      servo::Energy energy;
      float left_J = kReservoir_J;
      (void)servo::payable_stretch_m(energy, left_J, {kReservoir_J, 500.0f}, kStiffness_N_per_m,
                                     math::float_of(a), {math::float_of(b), 0, 0}, {});
      energy.force_N = {math::float_of(b), 0, math::float_of(a)};
      (void)servo::payable_stretch_m(energy, left_J, {kReservoir_J, 500.0f}, kStiffness_N_per_m,
                                     0.001f, {math::float_of(a), 0, 0}, {math::float_of(b), 0, 0});
      const float stretch_m = servo::payable_stretch_m(energy, left_J, {kReservoir_J, 500.0f},
                                                       kStiffness_N_per_m, 0.001f, {}, {});
      CHECK(stretch_m >= 0.0f && stretch_m <= 0.001f);
      const float most_J = 0.5f * kStiffness_N_per_m * 1e-6f + kReservoir_J;
      CHECK(energy.saved_J + left_J <= most_J * 1.000001f);
    }
}
