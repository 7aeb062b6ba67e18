// Homing by the firmware on every machine, with every thing that may be wrong.
#include <string>

#include "device/machines.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "host_sim/device/homing_check.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::HomingFault;
using host_sim::HomingCase;

TEST(Homing_EveryMachine_IsWithinACountOrFaults) {
  const uint32_t runs = test::is_long() ? 10000 : 120;
  uint32_t named = 0, wrong_axes = 0, dead_motors = 0, homed_dead = 0;
  for (const std::string& name : tools::machine_names()) {
    const tools::LinkageDevice device = tools::read_device(name, tools::machine_text(name));
    host_sim::HomingTally tallies[host_sim::kHomingCases];
    for (uint32_t run = 0; run < runs; ++run) {
      const uint32_t which = run % host_sim::kHomingCases;
      add(simulate_homing(device, static_cast<HomingCase>(which), run), tallies[which]);
    }
    for (uint32_t i = 0; i < host_sim::kHomingCases; ++i) {
      const host_sim::HomingTally& tally = tallies[i];
      test::note((name + ", " + case_name(static_cast<HomingCase>(i))).c_str(), tally.runs);
      CHECK_EQ(tally.wrong, 0u);
      CHECK_GE(tally.torque_share, 0.9);
      if (i == static_cast<uint32_t>(HomingCase::kGood)) CHECK_GE(tally.homed * 10, tally.runs * 9);
      const auto it = static_cast<HomingCase>(i);
      if (it == HomingCase::kDead || it == HomingCase::kReversed || it == HomingCase::kSwapped ||
          it == HomingCase::kNoStop || it == HomingCase::kNoIndex ||
          it == HomingCase::kMotorReversed)
        CHECK_EQ(tally.homed, 0u);
      // The other motors of a five-bar may move the joint.
      if (it == HomingCase::kMotorDead) dead_motors += tally.runs, homed_dead += tally.homed;
      if (it != HomingCase::kReversed && it != HomingCase::kSwapped &&
          it != HomingCase::kMotorReversed)
        continue;
      wrong_axes += tally.runs;
      named += tally.faults[static_cast<uint32_t>(HomingFault::kWrongWay)] +
               tally.faults[static_cast<uint32_t>(HomingFault::kSwapped)];
    }
  }
  test::note("reversed or swapped axes that are named so", named);
  CHECK_GE(named * 10, wrong_axes * 8);
  test::note("homed with a dead motor", homed_dead);
  CHECK_LE(homed_dead * 20, dead_motors);
}

// Ranges of 150 and 40 degrees: margin and index periods fit the smaller one.
TEST(Homing_JointsOfUnequalRanges_AreHomed) {
  const tools::LinkageDevice device = tools::read_device(
      "arm",
      "linkage serial_arm 2\nlink_0 120 mm\nlink_1 100 mm\nlow_0 -50 deg\nhigh_0 100 deg\n"
      "low_1 90 deg\nhigh_1 130 deg\ncounts_0 5000 counts/rad\ncounts_1 5000 counts/rad\n"
      "max_torque_0 1 N*m\nmax_torque_1 0.6 N*m\nlink_mass_0 100 g\nlink_mass_1 60 g\n"
      "tip_mass 50 g\nrotor_0 1e-5 kg*m2\nrotor_1 1e-5 kg*m2\n");
  host_sim::HomingTally good;
  for (uint32_t run = 0; run < 40; ++run)
    add(simulate_homing(device, HomingCase::kGood, run), good);
  CHECK_EQ(good.wrong, 0u);
  CHECK_EQ(good.faults[static_cast<uint32_t>(HomingFault::kSettings)], 0u);
  CHECK_GE(good.homed, 32u);
}

// Both links of an arm are light against its joints' torques: the joint that is driven in truth
// swings the other one when it meets its stop.
TEST(Homing_PlanarArmWithSwappedEncoders_IsNamed) {
  const std::string arm =
      "linkage serial_arm 2\nlink_0 120 mm\nlink_1 100 mm\nlow_0 -50 deg\nhigh_0 100 deg\n"
      "low_1 30 deg\nhigh_1 150 deg\ncounts_0 5000 counts/rad\ncounts_1 5000 counts/rad\n"
      "max_torque_0 1 N*m\nmax_torque_1 0.6 N*m\nlink_mass_0 100 g\nlink_mass_1 60 g\n"
      "tip_mass 50 g\nrotor_0 1e-5 kg*m2\nrotor_1 1e-5 kg*m2\n";
  for (const char* elbow : {"", "elbow parallelogram\n"}) {
    const tools::LinkageDevice device = tools::read_device("arm", arm + elbow);
    host_sim::HomingTally swapped;
    for (uint32_t run = 0; run < 40; ++run)
      add(simulate_homing(device, HomingCase::kSwapped, run), swapped);
    CHECK_EQ(swapped.homed, 0u);
    CHECK_EQ(swapped.faults[static_cast<uint32_t>(HomingFault::kTooLong)], 0u);
    CHECK_GE(swapped.faults[static_cast<uint32_t>(HomingFault::kSwapped)], 24u);
  }
}
