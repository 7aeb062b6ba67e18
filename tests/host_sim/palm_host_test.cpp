// Hands with a mass between grip and arm, against their closed forms.
#include "host_sim/hand/palm.hpp"

#include <cmath>

#include "harness/random.hpp"
#include "harness/test.hpp"
#include "host_sim/bench/rig.hpp"
#include "host_sim/hand/hand.hpp"
#include "host_sim/hand/hands.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"

using namespace firmtouch::host_sim;  // NOLINT: a test file

namespace {

constexpr double kTwoPi = 2 * 3.14159265358979323846;
constexpr double kStep_s = 1e-3 / 16;

Scenario scenario_of(const std::string& lines) {
  return read_scenario("test.scenario", "asset a.fta\nhold for 1 s\n" + lines, {},
                       parameter_rows());
}

std::string refusal_of(const std::string& lines) {
  try {
    scenario_of(lines);
  } catch (const Refused& refused) {
    return refused.what();
  }
  return "";
}

// Amplitude of the force over that of the grip's sine, whole periods after a transient.
double seen_N_per_m(const Scenario& scenario, double frequency_Hz) {
  const Environment environment;
  const Hand hand(scenario, environment, 0.003);
  Palm palm(scenario.hand, {});
  const double amplitude_m = 1e-3, w = kTwoPi * frequency_Hz;
  const int settle = static_cast<int>(3 / kStep_s);
  const int steps = static_cast<int>(std::lround(5 / kStep_s));
  double in_phase = 0, across = 0;
  for (int i = 0; i < settle + steps; ++i) {
    const double t = i * kStep_s;
    const Vec force_N = hand.force_N(t, palm.position_m(), palm.velocity_mps(),
                                     {amplitude_m * std::sin(w * t), 0, 0},
                                     {amplitude_m * w * std::cos(w * t), 0, 0});
    palm.advance({}, {}, force_N, kStep_s);
    if (i < settle) continue;
    in_phase += force_N.x * std::sin(w * t), across += force_N.x * std::cos(w * t);
  }
  return 2 * std::hypot(in_phase, across) / steps / amplitude_m;
}

}  // namespace

TEST(HandWithAMass_AtEveryFrequency_HasTheImpedanceOfItsClosedForm) {
  for (const KnownHand& known : known_hands())
    for (const char* grip : {"weak", "mean", "firm"}) {
      const Scenario scenario = scenario_of("hand " + std::string(known.name) + " " + grip + "\n");
      for (const double frequency_Hz : {1.0, 3.0, 10.0, 30.0, 100.0}) {
        const double closed = impedance_N_per_m(scenario.hand, frequency_Hz);
        CHECK_LE(std::fabs(seen_N_per_m(scenario, frequency_Hz) / closed - 1), 0.02);
      }
    }
}

// At rest grip and arm are springs in series with the contact.
TEST(HandWithAMass_PressesAsSpringsInSeries) {
  const Rig rig(0);
  const double aim_m = 0.004;
  Lines lines;
  const HandModel& hand = *find_hand("arm", "mean");
  for (const HandKey& key : hand_keys())
    lines.emplace_back(key.name, with_unit(hand.*key.member, key.unit));
  const Vec away_m{0.0123, 0.0071, rig.radius_m + 0.006},
      in_m{0.0123, 0.0071, rig.radius_m - aim_m};
  const RigRun run =
      rig.run(plate(0.04), away_m, {Rig::hold_s(0.3), Rig::to(in_m, 0.05), Rig::hold_s(2)},
              Contact::kProxy, lines);
  const double series =
      1 / (1 / rig.stiffness_N_per_m + 1 / hand.stiffness_N_per_m + 1 / hand.arm_stiffness_N_per_m);
  CHECK_LE(std::fabs(mean_force_N(run, 500).z / (series * aim_m) - 1), 0.02);
}

TEST(Palm_AnyStep_GainsNoEnergy) {
  firmtouch::test::Lcg random(7);
  const auto draw = [&](float low, float high) {
    return static_cast<double>(random.between(low, high));
  };
  for (int run = 0; run < 200; ++run) {
    HandModel model;
    model.mass_kg = draw(0.01f, 1);
    model.arm_stiffness_N_per_m = draw(0, 5000);
    model.arm_damping_N_s_per_m = draw(0, 20);
    const double step_s = std::pow(10, draw(-5, 0));
    Palm palm(model, {draw(-1, 1), draw(-1, 1), draw(-1, 1)});
    const auto energy_J = [&] {
      return 0.5 * model.mass_kg * dot(palm.velocity_mps(), palm.velocity_mps()) +
             0.5 * model.arm_stiffness_N_per_m * dot(palm.position_m(), palm.position_m());
    };
    double before_J = energy_J();
    for (int step = 0; step < 200; ++step) {
      palm.advance({}, {}, {}, step_s);
      CHECK_LE(energy_J(), before_J * (1 + 1e-12));
      before_J = energy_J();
    }
  }
}

TEST(Scenario_Hand_IsFiveKeysOrRefused) {
  const HandModel hand = scenario_of("hand stylus firm\n").hand,
                  &firm = *find_hand("stylus", "firm");
  for (const HandKey& key : hand_keys())
    CHECK(!(hand.*key.member < firm.*key.member) && !(hand.*key.member > firm.*key.member));
  CHECK(refusal_of("hand stylus tight\n").find("pinch, stylus, arm, handle") != std::string::npos);
  CHECK(refusal_of("hand stylus\n").find("a grip") != std::string::npos);
  CHECK(refusal_of("hand arm mean\nhand_mass 1 kg\n").find("twice") != std::string::npos);
  CHECK(refusal_of("hand arm mean\nhand_stiffening 10 1/m\n").find("without") != std::string::npos);
  CHECK(refusal_of("hand_mass 1 g\nhand_damping 100 N*s/m\n").find("so light") !=
        std::string::npos);
  for (const KnownHand& known : known_hands())
    for (const char* grip : {"weak", "mean", "firm"})
      CHECK(refusal_of("hand " + std::string(known.name) + " " + grip + "\n").empty());
}
