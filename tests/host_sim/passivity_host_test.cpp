// Energy that contact through a linkage gives to a hand: the seeds are those that gained most while
// the observer counted forces that weak motors did not render, the tip's way instead of the
// joints', or nothing for the place within a count.
#include <string>

#include "device/machines.hpp"
#include "harness/test.hpp"
#include "host_sim/bench/passive_hands.hpp"

using namespace firmtouch::host_sim;  // NOLINT: a test file

TEST(Passivity_HandsOnLinkages_GainNoMoreThanAMillijoule) {
  const struct {
    const char* machine;
    double stiffest_N_per_m;
    uint64_t seed;
  } kHands[] = {{"haply_pantograph", 20000, 9}, {"touch_like", 5253, 21},
                {"pantograph_mk2", 6811, 9},    {"pantograph_mk2", 6811, 16},
                {"falcon_like", 14582, 99},     {"omega_like", 20000, 134}};
  for (const auto& hand : kHands) {
    const RigRun run = random_run(hand.machine, hand.stiffest_N_per_m, hand.seed, {});
    CHECK_LE(gain_J(run), 0.001);
    CHECK_EQ(run.back().faults, 0u);
  }
}

TEST(Passivity_GainIsCounted_BetweenTicksWithoutContact) {
  RigRun run(4);
  for (RigTick& tick : run) tick.is_ramped_in = true;
  run[0].taken_J = 0.008, run[0].depth_m = 0.005;  // pressed as the ramp ended
  run[1].taken_J = 0.001;
  run[2].taken_J = 0.005, run[2].depth_m = 0.002;
  CHECK_LE(gain_J(run), 0.001 + 1e-12);
  CHECK_GE(gain_J(run), 0.001 - 1e-12);
}

// The weight that motors carry half a tick late gave this swinging hand 0.6 mJ.
TEST(Passivity_CarriedWeight_GivesAMovingHandNoEnergy) {
  CHECK_LE(gain_J(random_run("falcon_like", 500, 36, {})), 5e-5);
}

// Springs that balance half of that weight, and too much of it.
TEST(Passivity_CarriedWeightAndSprings_GiveAMovingHandNoEnergy) {
  for (const double stiffness : {0.05, 0.5}) {
    const firmtouch::bench::TemporaryFolder folder;
    std::string text = firmtouch::tools::machine_text("falcon_like");
    for (const char* const joint : {"0", "1", "2"})
      text += std::string("spring_") + joint + " " + with_unit(stiffness, "N*m/rad") +
              "\nrelaxed_" + joint + " 80 deg\n";
    const std::string path = folder.write("sprung.txt", text);
    CHECK_LE(gain_J(random_run(path, 500, 36, {})), 5e-5);
  }
}

TEST(Passivity_WithoutALimit_ALinkageGivesMore) {
  CHECK_GE(gain_J(random_run("touch_like", 20000, 1, {{"energy_reservoir", "1000 J"}})), 0.001);
}

TEST(Passivity_HandsWithAMass_GainNoMoreThanAMillijoule) {
  const HandsGain gain = massive_hands("touch_like", 5253, 9, {});
  CHECK_EQ(gain.hands, 9u);
  CHECK_EQ(gain.touched, 9u);
  CHECK_LE(gain.worst_J, 0.001);
}
