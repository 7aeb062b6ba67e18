// The figures of a score against closed forms.
#include <cmath>
#include <vector>

#include "harness/test.hpp"
#include "host_sim/report/buzz.hpp"
#include "host_sim/report/score.hpp"

namespace host_sim = firmtouch::host_sim;
using host_sim::Score;
using host_sim::ScoredTick;
using host_sim::ScoreSettings;
using host_sim::Vec;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr ScoreSettings kSettings{1000, 8, 0.003, 1000};

std::vector<Vec> sines(double frequency_Hz, size_t count) {
  std::vector<Vec> force_N;
  for (size_t i = 0; i < count; ++i) {
    const double wave = std::sin(2 * kPi * frequency_Hz * static_cast<double>(i) / 1000);
    force_N.push_back({3 + 0.6 * wave, -0.8 * wave, 1});
  }
  return force_N;
}

// Pressed 2 mm deep on a spring along z, at rest.
std::vector<ScoredTick> pressed(size_t count) {
  return std::vector<ScoredTick>(count,
                                 {{0, 0, 2}, {0, 0, 2}, 0, {0, 0, -0.002}, 0.002, 1000, true});
}

void add_turns(std::vector<ScoredTick>& ticks) {
  host_sim::ContactTurn turn;
  for (ScoredTick& tick : ticks) tick.turn_rad = turn.add_rad({}, tick.contact_N);
}

}  // namespace

// A window of Hann spreads a sine over three bins and keeps its power.
TEST(Buzz_SineWithinTheBand_IsItsRootMeanSquare) {
  for (const double frequency_Hz : {80.0, 123.4, 300.0}) {
    const std::vector<Vec> force_N = sines(frequency_Hz, 3000);
    CHECK_LT(std::fabs(host_sim::buzz_N(force_N.data(), force_N.size(), 1000) - std::sqrt(0.5)),
             1e-3);
  }
}

TEST(Buzz_SineBelowTheBand_IsNone) {
  const std::vector<Vec> force_N = sines(20, 2048);
  CHECK_LT(host_sim::buzz_N(force_N.data(), force_N.size(), 1000), 1e-4);
}

TEST(Score_PressAtRest_MeetsEveryBar) {
  const Score score = score_of(pressed(3000), kSettings);
  CHECK_LT(score.buzz_N, 1e-9);
  CHECK(!(score.turn_rad > 0) && !(score.given_J > 0));
  CHECK(score.limit_ticks == 0 && score.let_go == 0);
  CHECK_LT(std::fabs(score.deepest_radii - 2.0 / 3), 1e-12);
}

// A spring that gives back 2 mJ of the 2 mJ that were put in gives nothing, and 3 mJ one too many.
TEST(Score_Energy_IsWorkPlusWhatTheSpringHolds) {
  std::vector<ScoredTick> ticks;
  const auto add = [&](double depth_m, double force_N) {
    const Vec force{0, 0, force_N};
    ticks.push_back({force, force, 0, {0, 0, -depth_m}, depth_m, 1000, true});
  };
  // The mean force of a step does the work of a spring in it.
  for (int i = 0; i < 20; ++i) add(i * 1e-4, (i + 0.5) * 1e-1);
  for (int i = 20; i >= 0; --i) add(i * 1e-4, (i - 0.5) * 1e-1);
  CHECK_LT(score_of(ticks, kSettings).given_J, 1e-9);
  for (size_t i = 20; i < ticks.size(); ++i) ticks[i].force_N.z *= 1.5;
  CHECK_LT(std::fabs(score_of(ticks, kSettings).given_J - 1e-3), 1e-5);
  for (ScoredTick& tick : ticks) tick.is_guided = true;  // a guide's spring holds some, too
  CHECK(!(score_of(ticks, kSettings).given_J > 0));
  for (ScoredTick& tick : ticks) tick.is_guided = false, tick.is_ramping = true;
  CHECK(!(score_of(ticks, kSettings).given_J > 0));
  for (ScoredTick& tick : ticks) tick.is_ramping = tick.is_on = false;
  CHECK(!(score_of(ticks, kSettings).given_J > 0));
}

// Motors that render 2 N at most: pressed 5 mm deep, a spring of 1,000 N/m holds what 2 N do. One
// that is twice as soft, as the material's is, holds more on the way to them.
TEST(Score_SpringAtTheMotorsLimit_HoldsWhatTheyRender) {
  for (const double stiffness_N_per_m : {1000.0, 500.0}) {
    std::vector<ScoredTick> ticks;
    const auto add = [&](double depth_m, double off_m) {
      const double wanted_N = stiffness_N_per_m * (depth_m + off_m);
      const Vec force{0, 0, std::fmin(std::fmax(wanted_N, 0.0), 2.0)};
      ticks.push_back({force, force, 0, {0, 0, -depth_m}, depth_m, stiffness_N_per_m, true});
    };
    for (int i = 0; i < 500; ++i) add(i * 1e-5, 5e-6);
    for (int i = 500; i >= 0; --i) add(i * 1e-5, -5e-6);
    ScoreSettings settings = kSettings;
    settings.damping_N_s_per_m = 0;  // what the speed of 0.01 m/s would add
    CHECK_LT(score_of(ticks, settings).given_J, 2e-5);
    for (ScoredTick& tick : ticks) tick.stiffness_N_per_m = 4 * stiffness_N_per_m;
    CHECK_GE(score_of(ticks, settings).given_J, 1e-3);  // of another spring
  }
}

TEST(Score_SpringAtTheForceLimit_HoldsWhatTheLimitDoes) {
  CHECK_LT(std::fabs(host_sim::stored_J(1000, 0.008, 8) - 0.032), 1e-12);
  CHECK_LT(std::fabs(host_sim::stored_J(1000, 0.018, 8) - (0.032 + 0.08)), 1e-12);
}

TEST(Score_ContactThatTurnsAndLetsGo_IsCounted) {
  std::vector<ScoredTick> ticks = pressed(4);
  ticks[1].force_N = {2, 0, 0};
  ticks[2].force_N = {0, 0.01, 0};  // no direction
  ticks[3].force_N = {0, 8, 0};
  for (ScoredTick& tick : ticks) tick.contact_N = tick.force_N;
  add_turns(ticks);
  const Score score = score_of(ticks, kSettings);
  CHECK_LT(std::fabs(score.turn_rad - kPi / 2), 1e-12);
  CHECK(score.let_go == 1);
  CHECK(score.limit_ticks == 1);
  for (ScoredTick& tick : ticks) tick.is_on = false;
  CHECK(score_of(ticks, kSettings).let_go == 0);
}

// A spring that turns, or lets go, by as much as the tool moves does what a spring does.
TEST(Score_SpringThatFollowsTheTool_NeitherTurnsNorLetsGo) {
  std::vector<ScoredTick> ticks = pressed(3);
  for (ScoredTick& tick : ticks) tick.contact_N = tick.force_N;
  ticks[1].contact_N = {0.4, 0, 0};
  ticks[2].contact_N = {};
  add_turns(ticks);
  const auto move = [&](double part) {
    for (size_t i = 1; i < 3; ++i) {
      const double change_N = host_sim::norm(ticks[i].contact_N - ticks[i - 1].contact_N);
      ticks[i].device_m = ticks[i - 1].device_m + Vec{0, 0, part * change_N / 1000};
    }
    return score_of(ticks, kSettings);
  };
  CHECK(!(move(1.01).turn_rad > 0) && move(1.01).let_go == 0);
  CHECK_LT(std::fabs(move(0.99).turn_rad - kPi / 2), 1e-12);
  CHECK(move(0.99).let_go == 1);
}

TEST(Score_DepthWithAProxy_IsNoDefect) {
  std::vector<ScoredTick> ticks = pressed(3);
  for (ScoredTick& tick : ticks) tick.has_proxy = true;
  CHECK(!(score_of(ticks, kSettings).deepest_radii > 0));
}
