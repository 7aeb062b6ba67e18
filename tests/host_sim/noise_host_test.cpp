// Noise of encoders and jitter of the tick: their statistics, and what they leave as it is.
#include <cmath>
#include <string>
#include <vector>

#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/plant/machine.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::Machine;
using host_sim::norm;
using host_sim::RunTick;
using host_sim::Scenario;
using host_sim::Vec;

namespace {

Scenario arm_with(double noise_counts, double seed) {
  Scenario scenario;
  scenario.seed = seed;
  scenario.linkage = tools::read_device(
      "arm",
      "linkage serial_arm 2\nlink_0 100 mm\nlink_1 100 mm\nrotor_0 1e-3 kg*m2\nrotor_1 1e-3 kg*m2\n"
      "counts_0 5000 counts/rad\ncounts_1 -5000 counts/rad\nmax_torque_0 1 N*m\nlow_0 0 rad\n"
      "max_torque_1 1 N*m\nhigh_0 1.5 rad\nlow_1 0.7 rad\nhigh_1 2 rad\nencoder_noise_1 " +
          std::to_string(noise_counts) + "\n");
  return scenario;
}

// Of a machine at rest.
std::vector<double> counts_of(const Scenario& scenario, int joint, int ticks) {
  tools::JointMotion start;
  start.angle_rad[0] = 0.7, start.angle_rad[1] = 1.2;
  Machine machine(scenario, points_of(*scenario.linkage, start).tip.at_m, {});
  std::vector<double> counts;
  for (int i = 0; i < ticks; ++i) {
    CHECK_EQ(machine.count(joint), machine.count(joint));  // the same within a tick
    counts.push_back(machine.count(joint));
    machine.command({0, 0, 0});
  }
  CHECK(!(machine.encoder_off_rad() > 0));
  return counts;
}

struct Moments {
  double mean = 0, deviation = 0;
};
Moments moments_of(const std::vector<double>& values) {
  Moments m;
  const double share = 1 / static_cast<double>(values.size());
  for (const double value : values) m.mean += value * share;
  for (const double value : values) m.deviation += (value - m.mean) * (value - m.mean) * share;
  m.deviation = std::sqrt(m.deviation);
  return m;
}

// A device that a hand has thrown and let go, without friction and far from the part.
struct Thrown {
  explicit Thrown(double jitter, double seed = 1) {
    scenario = test::loop_scenario();
    scenario.text.clear(), scenario.moves.clear(), scenario.events.clear();
    scenario.tick_jitter = jitter, scenario.seed = seed;
    scenario.device.viscous_N_s_per_m = scenario.device.coulomb_N = 0;
    scenario.has_start = true;
    scenario.start_m = {0, 0, 0.3};
    host_sim::Move move;
    move.kind = host_sim::Move::Kind::kMove;
    move.to_m = {0.1, 0, 0.3}, move.speed_mps = 0.2;
    scenario.moves.push_back(move);
    move.kind = host_sim::Move::Kind::kLetGo, move.time_s = 1;
    scenario.moves.push_back(move);
    scenario.duration_s = 1;
    host_sim::Session session(test::part_asset());
    const host_sim::Environment environment =
        host_sim::environment_of(*session.controller, scene_origin_m(scenario));
    host_sim::Simulation simulation(scenario, session.tick(), environment);
    for (RunTick tick; simulation.next(tick);) ticks.push_back(tick);
  }
  Scenario scenario;
  std::vector<RunTick> ticks;
};

double time_s(const RunTick& tick) { return tick.record.input.clock_us * 1e-6; }

}  // namespace

// Rounding down to counts adds the variance of a uniform one, 1/12.
TEST(EncoderNoise_HasItsDeviation_AndTheMeanOfTheAngle) {
  for (const double noise : {1.0, 3.0, 40.0}) {
    const Moments m = moments_of(counts_of(arm_with(noise, 5), 1, 100000));
    const double want = std::sqrt(noise * noise + 1.0 / 12);
    CHECK_LE(std::fabs(m.deviation / want - 1), 0.01);
    CHECK_LE(std::fabs(m.mean + 6000.5), 4 * want / std::sqrt(1e5) + 1e-3);
  }
}

TEST(EncoderNoise_IsOfItsJointAndItsSeed) {
  const std::vector<double> of_other = counts_of(arm_with(3, 5), 0, 1000);
  for (const double count : of_other) CHECK(!(count < of_other[0]) && !(count > of_other[0]));
  CHECK(counts_of(arm_with(3, 5), 1, 1000) == counts_of(arm_with(3, 5), 1, 1000));
  CHECK(counts_of(arm_with(3, 5), 1, 1000) != counts_of(arm_with(3, 6), 1, 1000));
  CHECK(moments_of(counts_of(arm_with(0, 5), 1, 100)).deviation <= 1e-9);
}

// Ticks are late by 0 to the share, evenly: the difference of two has the deviation of a triangle.
TEST(TickJitter_HasItsShare_AndNoDrift) {
  const Thrown thrown(0.4);
  CHECK_EQ(thrown.ticks.size(), 1000u);
  std::vector<double> between_ms;
  double worst = 0, least = 1;
  for (size_t i = 1; i < thrown.ticks.size(); ++i) {
    between_ms.push_back((time_s(thrown.ticks[i]) - time_s(thrown.ticks[i - 1])) * 1e3);
    const double late_ms = time_s(thrown.ticks[i]) * 1e3 - static_cast<double>(i);
    worst = std::fmax(worst, late_ms), least = std::fmin(least, late_ms);
  }
  CHECK(least >= 0 && least <= 0.005 && worst >= 0.395 && worst <= 0.401);
  CHECK_LE(std::fabs(moments_of(between_ms).deviation / (0.4 / std::sqrt(6.0)) - 1), 0.05);
  const Thrown again(0.4), other(0.4, 2);
  CHECK_EQ(time_s(again.ticks[500]), time_s(thrown.ticks[500]));
  CHECK(std::fabs(time_s(other.ticks[500]) - time_s(thrown.ticks[500])) > 1e-6);
}

// What coasts has gone its speed times the time that the clock shows, to a microsecond.
TEST(TickJitter_IsThatOfTheMachineAndOfTheClock) {
  for (const double jitter : {0.0, 0.3, 0.9}) {
    const Thrown thrown(jitter);
    const RunTick &from = thrown.ticks[600], &last = thrown.ticks.back();
    CHECK_GE(norm(from.device_mps), 0.01);
    CHECK_LE(norm(last.device_mps - from.device_mps), 1e-12);
    for (size_t i = 601; i < thrown.ticks.size(); ++i) {
      const RunTick& tick = thrown.ticks[i];
      const double gone_m = norm(tick.device_m - from.device_m);
      const double want_m = norm(from.device_mps) * (time_s(tick) - time_s(from));
      CHECK_LE(std::fabs(gone_m - want_m), 1.001e-6 * norm(from.device_mps));
    }
  }
}
