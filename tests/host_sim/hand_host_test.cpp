// What a simulated hand does beside its spring and damper: it stiffens, trembles, is startled and
// lets go.
#include <cmath>

#include "harness/test.hpp"
#include "host_sim/hand/hand.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

using namespace firmtouch::host_sim;  // NOLINT: a test file

namespace {

constexpr double kPi = 3.14159265358979323846;
const std::string kHead =
    "asset a.fta\nstart 0 0 0.1 m\nhand_stiffness 400 N/m\nhand_damping 4 N*s/m\n";

struct Subject {
  explicit Subject(const std::string& lines)
      : scenario(read_scenario("test.scenario", kHead + lines, {}, parameter_rows())),
        hand(scenario, environment, 0.003) {}
  Environment environment;
  Scenario scenario;
  Hand hand;
};

}  // namespace

TEST(Hand_ThatStiffens_PullsAsItsClosedFormAndKeepsEnergy) {
  const Subject subject("hand_stiffening 100 1/m\nhold for 1 s\n");
  const Vec aim_m{0.01, -0.02, 0.03};
  for (const double s : {0.0, 0.001, 0.01, 0.05}) {
    const Vec away{0.6 * s, 0, -0.8 * s};
    const Vec force_N = subject.hand.force_N(0.5, aim_m, {}, aim_m - away, {});
    CHECK_LE(std::abs(norm(force_N) - 400 * s * (1 + 100 * s)), 1e-12);
    CHECK_GE(dot(force_N, away), 0.0);
  }
  // Round a closed way it does no work.
  double work_J = 0;
  Vec before = aim_m + Vec{0.01, 0, 0};
  constexpr int kSteps = 20000;
  for (int i = 1; i <= kSteps; ++i) {
    const double turn = 2 * kPi * i / kSteps;
    const Vec at =
        aim_m + Vec{0.01 * std::cos(turn), 0.003 * std::sin(turn), 0.002 * std::sin(2 * turn)};
    work_J += dot(subject.hand.force_N(0, aim_m, {}, (before + at) * 0.5, {}), at - before);
    before = at;
  }
  CHECK_LE(std::abs(work_J), 1e-9);
}

TEST(Hand_WithTremor_SwingsAtItsFrequencyAndAmplitude) {
  const Subject subject("hand_tremor 0.2 mm\nhand_tremor_frequency 8 Hz\nhold for 2 s\n");
  int rises = 0;
  double most_N = 0, sum_N = 0, before_N = 0;
  constexpr int kTicks = 2000;
  for (int i = 0; i < kTicks; ++i) {
    const Vec aim_m = subject.hand.target_m(i * 0.001);
    const Vec force_N = subject.hand.force_N(i * 0.001, aim_m, {}, aim_m, {});
    rises += before_N < 0 && force_N.x >= 0;
    before_N = force_N.x;
    sum_N += force_N.x;
    CHECK_LE(std::abs(force_N.x + force_N.y + force_N.z), 1e-12);  // a third of a cycle apart
    most_N = std::max(most_N, std::abs(force_N.x));
  }
  CHECK(rises == 15 || rises == 16);
  CHECK_LE(std::abs(sum_N / kTicks), 1e-6);
  const double turn = 2 * kPi * 8, closed_N = 0.2e-3 * std::hypot(400.0, 4 * turn);
  CHECK_LE(std::abs(most_N - closed_N), 0.001 * closed_N);
}

TEST(Hand_ThatLetsGo_HasNoForceAndClosesWithoutAStep) {
  const Subject subject("hold for 1 s\nlet_go for 0.5 s\nhold for 1 s\n");
  const Vec at_m{0, 0, 0.09}, aim_m{0, 0, 0.1};
  const auto force_N = [&](double time_s) {
    return norm(subject.hand.force_N(time_s, aim_m, {}, at_m, {}));
  };
  CHECK_LE(std::abs(force_N(0.999) - 4), 1e-12);
  for (const double time_s : {1.0, 1.2, 1.499, 1.5}) CHECK_LE(force_N(time_s), 1e-12);
  double before_N = 0;
  for (double time_s = 1.5; time_s < 1.7; time_s += 0.001) {
    CHECK_GE(force_N(time_s), before_N);
    CHECK_LE(force_N(time_s) - before_N, 4 * 1.875 * 0.001 / 0.2 + 1e-9);
    before_N = force_N(time_s);
  }
  CHECK_LE(std::abs(force_N(1.7) - 4), 1e-9);
  CHECK_LE(std::abs(subject.hand.end_s() - 2.5), 1e-12);
}

TEST(Hand_Startled_JerksAndReturns) {
  const Subject subject("hold for 1 s\nstartle 0 0 0.14 m\n");
  const auto up_m = [&](double time_s) { return subject.hand.target_m(time_s).z - 0.1; };
  CHECK_LE(std::abs(up_m(1.0)), 1e-12);
  CHECK_LE(std::abs(up_m(1.1) - 0.04), 1e-9);
  CHECK_LE(std::abs(up_m(1.5)), 1e-9);
  double fastest_mps = 0;
  for (double time_s = 1; time_s < 1.5; time_s += 1e-4)
    fastest_mps = std::max(fastest_mps, (up_m(time_s + 1e-4) - up_m(time_s)) / 1e-4);
  CHECK_LE(std::abs(fastest_mps - 1.875 * 0.04 / 0.1), 0.001);  // minimum jerk
}
