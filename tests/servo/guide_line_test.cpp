// The spring of a guide: from all sides or from one, and what of it the hand has paid for.
#include "firmtouch/servo/guide_line.hpp"

#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

namespace {

constexpr float kReservoir_J = 0.0006f;

servo::GuideLine along_x(float stiffness_N_per_m, float y_m = 0) {
  servo::GuideLine line;
  line.point_m = {0, y_m, 0};
  line.direction = {1, 0, 0};
  line.stiffness_N_per_m = stiffness_N_per_m;
  return line;
}

// Motors that follow in a tick, without a ramp.
struct Hand {
  servo::Settings settings{100, 1e6f, 0, 0.001f, {kReservoir_J, 0}};
  servo::State state;
  servo::LocalModel model;
  uint32_t tick = 0;
  float x_m = 0;
  bool is_enabled = true;

  explicit Hand(const servo::GuideLine& line) { hold(line); }
  void hold(const servo::GuideLine& line) {
    model.guide = line, model.has_guide = true;
    ++model.made_tick;
  }
  float force_y_N(float y_m) {
    model.expires_tick = ++tick;
    return servo::step(state, settings, model, {{x_m, y_m, 0}, {}, tick, is_enabled, false, 0})
        .force_N.y;
  }
  // In steps of 10 um. Result: the force there.
  float go_N(float from_m, float to_m) {
    const int steps = static_cast<int>((to_m > from_m ? to_m - from_m : from_m - to_m) * 1e5f);
    for (int i = 0; i <= steps; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(steps);
      force_y_N(from_m + (to_m - from_m) * share);
    }
    return force_y_N(to_m);
  }
};

float to_and_fro_m(int tick) { return 0.001f * static_cast<float>(tick % 4 == 3 ? 1 : tick % 4); }

float stretch_at_m(const servo::GuideLine& line, Vec3 at_m) {
  return servo::stretch_m(line, servo::guided_off_m(line, at_m));
}

Vec3 pull_at_N(const servo::GuideLine& line, Vec3 at_m, Vec3 velocity_mps, float share) {
  return servo::pull_N(line, servo::guided_off_m(line, at_m), velocity_mps, share);
}

bool is_about(float a, float b, float by) { return a - b <= by && b - a <= by; }

}  // namespace

TEST(Edge_PullsOneWayBeyondItsTunnel_AndItsDamperNeverBack) {
  servo::GuideLine line = along_x(1000);
  line.edge = {0, 1, 0};
  line.tunnel_m = 0.001f;
  line.damping_N_s_per_m = 2;
  CHECK_EQ(stretch_at_m(line, {0, 0.003f, 0}), 0.0f);
  CHECK_EQ(stretch_at_m(line, {0, -0.001f, 0.5f}), 0.0f);
  CHECK(is_about(stretch_at_m(line, {0, -0.003f, 0.5f}), 0.002f, 1e-8f));
  const Vec3 push_N = pull_at_N(line, {7, -0.003f, 0.5f}, {}, 1);
  CHECK(is_about(push_N.y, 2, 1e-5f));
  CHECK_EQ(push_N.x, 0.0f);
  CHECK_EQ(push_N.z, 0.0f);
  CHECK_EQ(pull_at_N(line, {0, -0.003f, 0}, {0, 10, 0}, 1).y, 0.0f);  // out, fast
  CHECK(is_about(pull_at_N(line, {0, -0.002f, 0}, {5, -1, 5}, 1).y, 2, 1e-5f));
  CHECK_EQ(pull_at_N(line, {0, 0.003f, 0}, {0, -1, 0}, 1).y, 0.0f);
  CHECK(is_about(pull_at_N(line, {0, -0.002f, 0}, {}, 0.25f).y, 0.25f, 1e-5f));
}

TEST(GuideModel_EdgeThatIsNoUnitVector_IsNotSound) {
  servo::LocalModel model;
  model.guide = along_x(1000);
  model.has_guide = true;
  CHECK(servo::is_sound(model));
  model.guide.edge = {0, 0, 1};
  CHECK(servo::is_sound(model));
  const float lengths[] = {1e-30f, 0.5f, 1.1f, 1e30f};
  for (const float length : lengths) {
    model.guide.edge = {0, 0, length};
    CHECK(!servo::is_sound(model));
  }
}

// Taking hold gives what the spring then stores; so does enabling.
TEST(GuideEnergy_TakesHold_InFull) {
  Hand hand(along_x(1000));
  hand.model.has_guide = false;
  CHECK_EQ(hand.force_y_N(0), 0.0f);
  CHECK_EQ(hand.force_y_N(0.005f), 0.0f);
  hand.model.has_guide = true;
  CHECK(is_about(hand.force_y_N(0.005f), -5, 1e-5f));
  hand.is_enabled = false;
  for (uint32_t i = 0; i < 20; ++i) hand.force_y_N(0.001f);
  hand.force_y_N(0.008f);
  hand.is_enabled = true;
  CHECK(is_about(hand.force_y_N(0.008f), -8, 1e-5f));
}

// A line elsewhere stores more: what the hand put in and the reservoir is what it gets.
TEST(GuideEnergy_NewLineFartherAway_PullsWithWhatIsPaidFor) {
  for (int sides = 1; sides <= 2; ++sides) {
    servo::GuideLine line = along_x(1000), farther = along_x(1000, 0.01f);
    if (sides == 1) line.edge = farther.edge = {0, 1, 0};
    Hand hand(line);
    CHECK(is_about(hand.go_N(0, -0.004f), 4, 1e-3f));
    hand.hold(farther);
    // 8 mJ of 4 mm, and 0.6 mJ: sqrt(2 x 8.6 mJ x 1,000 N/m).
    CHECK(is_about(hand.force_y_N(-0.004f), 4.147f, 0.01f));
    const float left_N = hand.force_y_N(-0.0039f);
    CHECK_LE(left_N, 4.147f);
    CHECK_GE(left_N, 3.5f);
  }
}

TEST(GuideEnergy_StiffnessRaisedUnderLoad_ActsBehindTheLine) {
  Hand hand(along_x(100));
  CHECK(is_about(hand.go_N(0, -0.01f), 1, 1e-3f));
  const float stiffer_N_per_m[] = {500, 2000};
  for (const float stiffness_N_per_m : stiffer_N_per_m) {
    hand.hold(along_x(stiffness_N_per_m));
    for (int i = 0; i < 5; ++i) CHECK(is_about(hand.force_y_N(-0.01f), 1, 1e-3f));
  }
  CHECK_LE(hand.go_N(-0.01f, -0.005f), 1.0f);
  hand.go_N(-0.005f, 0.001f);
  CHECK(is_about(hand.go_N(0.001f, 0.003f), -6, 0.02f));
}

// Off and on again under load is no way to take hold anew.
TEST(GuideEnergy_StiffnessOfNoneInBetween_GivesTheReservoirAlone) {
  Hand hand(along_x(1000));
  hand.go_N(0, -0.01f);
  hand.hold(along_x(0));
  CHECK_EQ(hand.force_y_N(-0.01f), 0.0f);
  hand.hold(along_x(1000));
  CHECK_EQ(hand.force_y_N(-0.01f), 0.0f);
  CHECK_LE(hand.force_y_N(-0.0099f), 1.2f);  // sqrt(2 x 0.6 mJ x 1,000 N/m)
}

// A reservoir that is used up is not filled by releasing the tool and holding it anew.
TEST(GuideEnergy_ReleasedAndHeldAnew_HasNoNewReservoir) {
  Hand hand(along_x(1000));
  hand.go_N(0, -0.004f);
  hand.hold(along_x(1000, 0.01f));
  CHECK(is_about(hand.go_N(-0.004f, 0), 0, 0.2f));  // it gave 8.6 mJ on the way
  hand.model.has_guide = false;
  hand.force_y_N(0);
  hand.hold(along_x(1000, 0.002f));
  CHECK(is_about(hand.force_y_N(0), 2, 1e-3f));
  hand.go_N(0, 0.002f);
  hand.hold(along_x(1000, 0.006f));
  CHECK(is_about(hand.force_y_N(0.002f), 0, 0.2f));  // 1.1 N of 0.6 mJ
}

// What a hand does without motors is no work of the guide.
TEST(GuideEnergy_MovedFarWhileOff_IsThereAgain) {
  Hand hand(along_x(1000));
  hand.go_N(0, -0.004f);
  hand.is_enabled = false;
  for (int i = 0; i < 10; ++i) hand.force_y_N(-0.004f);
  hand.model.has_guide = false;
  hand.force_y_N(1);
  hand.is_enabled = true;
  hand.force_y_N(1);
  hand.hold(along_x(1000, 1.004f));
  CHECK(is_about(hand.force_y_N(1), 4, 0.01f));
}

// The slew limit would hold 3.9 N.
TEST(GuideEnergy_HandThatLeavesFast_IsNotPushedOn) {
  Hand hand(along_x(1000));
  hand.settings.slew_limit_N_per_s = 100;
  CHECK(is_about(hand.go_N(0, -0.004f), 4, 0.01f));
  CHECK_LE(hand.force_y_N(-0.001f), 1.0f);
  // What is counted is what acts, where nothing else does.
  CHECK(is_about(hand.state.guide_energy.force_N.y, hand.state.force_N.y, 1e-6f));
  // It owes 4 mJ, of which 4.5 mJ pay: a stiffness that is raised does not pay the rest.
  CHECK(is_about(hand.go_N(-0.001f, -0.004f), 3, 0.02f));
  hand.hold(along_x(1100));
  CHECK_LE(hand.force_y_N(-0.0039f), 2.0f);
}

// The device's friction fills the reservoir of contact and guide once, whichever it counts for.
TEST(GuideEnergy_FrictionOfTheDevice_CountsOnce) {
  const bool both[] = {false, true};
  for (const bool is_in_contact : both) {
    Hand hand(along_x(0));
    hand.settings.energy.friction_N_per_m = 5;
    servo::ProxySpring& spring = hand.model.spring;
    spring.is_used = spring.is_held = is_in_contact;
    spring.anchor_m = {0, 0, 0.001f};
    hand.force_y_N(0);
    hand.state.energy.saved_J = hand.state.guide_energy.saved_J = hand.state.reservoir_J = 0;
    float taken_J = 0, before_m = 0;
    for (int i = 1; i <= 20; ++i) {
      hand.x_m = to_and_fro_m(i);  // along the guide
      const float move_m = hand.x_m - to_and_fro_m(i - 1);
      taken_J += move_m * before_m > 0 ? 5 * move_m * before_m : 0;
      before_m = move_m;
      hand.force_y_N(0);
    }
    CHECK(taken_J < kReservoir_J && is_about(hand.state.reservoir_J, taken_J, 1e-8f));
  }
}

TEST(GuideEnergy_WithoutAGuide_FrictionFillsTheReservoirOfContact) {
  Hand hand(along_x(1000));
  hand.settings.energy.friction_N_per_m = 500;
  hand.model.has_guide = false;
  hand.force_y_N(0);
  hand.state.energy.saved_J = hand.state.guide_energy.saved_J = hand.state.reservoir_J = 0;
  for (int i = 0; i < 10; ++i) hand.force_y_N(i % 2 == 0 ? 0.001f : 0);  // an encoder's steps
  CHECK_EQ(hand.state.reservoir_J, 0.0f);
  for (int i = 0; i < 10; ++i) hand.force_y_N(to_and_fro_m(i));
  CHECK(is_about(hand.state.reservoir_J, kReservoir_J, 1e-7f));
}

TEST(GuideEnergy_OfADrive_IsNotCounted) {
  servo::GuideLine line = along_x(1000);
  line.direction = {0, 1, 0};
  line.drive_N = -5;
  line.drive_limit_N = 5;
  Hand hand(line);
  CHECK(is_about(hand.go_N(0, -0.05f), -5, 1e-3f));  // 250 mJ
  hand.model.guide.direction = {1, 0, 0};
  hand.model.guide.point_m = {0, -0.05f, 0};
  hand.go_N(-0.05f, -0.054f);
  CHECK_GE(hand.force_y_N(-0.0539f), 3.8f);
}
