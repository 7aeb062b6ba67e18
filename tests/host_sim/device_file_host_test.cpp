// Device files: every key, every kind of mistake with its line, and singular workspaces.
#include "device/device_file.hpp"

#include <cmath>
#include <string>

#include "harness/test.hpp"
#include "host_sim/device/workspace.hpp"
#include "host_sim/scenario/scenario.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::Workspace;
using tools::LinkageDevice;

namespace {

const std::string kFiveBar =
    "# the Pantograph Mk-II's lengths\n"
    "linkage five_bar\nbase 25 mm\n"
    "proximal_0 63 mm\nproximal_1 63 mm\ndistal_0 7.5 cm\ndistal_1 0.075 m\ntip left\n"
    "counts_0 13824 counts/turn\nlow_0 100 deg\nhigh_0 150 deg\nmax_torque_0 300 mN*m\n"
    "counts_1 2000 counts/rad\nlow_1 30 deg\nhigh_1 80 deg\nmax_torque_1 0.2 N*m\n";
const std::string kDelta =
    "linkage delta\nupper_0 60 mm\nupper_1 60 mm\nupper_2 60 mm\n"
    "lower_0 103 mm\nlower_1 103 mm\nlower_2 103 mm\nbase_radius 38 mm\nplatform_radius 21 mm\n"
    "side 4.5 mm\n"
    "counts_0 500 counts/rad\nlow_0 0 deg\nhigh_0 50 deg\nmax_torque_0 1 N*m\n"
    "counts_1 500 counts/rad\nlow_1 0 deg\nhigh_1 50 deg\nmax_torque_1 1 N*m\n"
    "counts_2 500 counts/rad\nlow_2 0 deg\nhigh_2 50 deg\nmax_torque_2 1 N*m\n";

LinkageDevice read(const std::string& text) { return tools::read_device("test.device", text); }

bool near(float a, double b) { return std::fabs(static_cast<double>(a) - b) <= 1e-6 * (1 + b); }

// `text` with its first `from` replaced.
std::string edited(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  CHECK(at != std::string::npos);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void check_refusal(const std::string& text, const std::string& part) {
  try {
    read(text);
    test::fail(__FILE__, __LINE__, ("not refused: " + part).c_str());
  } catch (const host_sim::Refused& refused) {
    const std::string message = refused.what();
    if (message.find(part) == std::string::npos)
      test::fail(__FILE__, __LINE__, ("`" + message + "` lacks `" + part + "`").c_str());
  }
}

}  // namespace

TEST(DeviceFile_EveryKey_ConvertsToSi) {
  const LinkageDevice device =
      read(kFiveBar + "zero_1 -90 deg\nmax_speed 900 deg/s\nfull_from 0.2\ngone_at 0.1\n");
  const auto& bar = std::get<device::FiveBar>(device.linkage);
  CHECK(near(bar.base_m, .025) && near(bar.proximal_m[1], .063) && near(bar.distal_m[0], .075));
  CHECK(bar.is_tip_left);
  CHECK_EQ(device.joints.joints, 2u);
  CHECK(near(device.joints.joint[0].counts_per_rad, 13824 / 6.283185307));
  CHECK(near(device.joints.joint[1].zero_rad + 2, 2 - 1.570796327));
  CHECK(near(device.joints.joint[1].high_rad, 1.396263402));
  CHECK(near(device.joints.max_speed_rad_per_s, 15.70796327));
  CHECK(near(device.limits.max_torque_Nm[0], .3) && near(device.limits.max_torque_Nm[1], .2));
  CHECK(near(device.limits.full_from, .2) && near(device.limits.gone_at, .1));
  const LinkageDevice indexed =
      read(kFiveBar + "home stops\nindex_0 90 deg\nindex_period_0 20 deg\nindex_1 30 deg\n" +
           "index_period_1 21 deg\nindex_within 0.5 deg\n");
  CHECK(indexed.has_index_pulses && indexed.homing.by == device::HomeBy::kStops);
  CHECK(near(indexed.homing.index_rad[0], 1.570796327));
  CHECK(near(indexed.homing.index_period_rad[1], .366519143));
  CHECK(near(indexed.homing.index_within_rad, .008726646));
  const LinkageDevice derated =
      read(kFiveBar + "continuous_torque_1 90 mN*m\nthermal_time_1 5 s\n");
  CHECK(derated.is_derated && near(derated.continuous_Nm[1], .09));
  CHECK(near(derated.thermal_time_s[1], 5));
  const LinkageDevice driven =
      read(edited(kFiveBar, "max_torque_1 0.2 N*m", "max_current_1 2500 mA") +
           "torque_constant_1 80 mN*m/A\ncontinuous_current_1 1.5 A\nthermal_time_1 5 s\n");
  CHECK(near(driven.limits.max_torque_Nm[1], .2) && near(driven.limits.max_torque_Nm[0], .3));
  CHECK(driven.is_derated && near(driven.continuous_Nm[1], .12));
  const std::string spring = "spring_1 50 mN*m/rad\nrelaxed_1 90 deg\n";
  const LinkageDevice sprung = read(kFiveBar + spring + "carried_share 0.5\n");
  CHECK(near(static_cast<float>(sprung.masses.joint[1].spring_N_m_per_rad), .05));
  CHECK(near(static_cast<float>(sprung.masses.joint[1].relaxed_rad), 1.5707963));
  CHECK(tools::has_compensation(sprung) && !tools::has_compensation(read(kFiveBar + spring)));
  CHECK(tools::has_compensation(
      read(kFiveBar + "coulomb_0 1 mN*m\ncarried_share 0.5\nfriction_share 0.5\n")));
  const LinkageDevice delta = read(kDelta + "tip below\n");
  CHECK(!std::get<device::Delta>(delta.linkage).is_tip_above);
  CHECK(near(std::get<device::Delta>(delta.linkage).side_m, .0045));
  const LinkageDevice arm = read(
      "linkage serial_arm 2\nlink_0 150 mm\nlink_1 120 mm\nelbow parallelogram\n"
      "counts_0 -1000 counts/rad\nlow_0 -1 rad\nhigh_0 1 rad\nmax_torque_0 1 N*m\n"
      "counts_1 1000 counts/rad\nlow_1 -1 rad\nhigh_1 1 rad\nmax_torque_1 1 N*m\n");
  CHECK_EQ(std::get<device::SerialArm>(arm.linkage).joints, 2u);
  CHECK(std::get<device::SerialArm>(arm.linkage).has_parallelogram);
  CHECK(near(-arm.joints.joint[0].counts_per_rad, 1000));
}

TEST(DeviceFile_Mistakes_NameTheLineAndTheRemedy) {
  check_refusal("", "begin with `linkage five_bar`");
  check_refusal("base 25 mm\n", "test.device:1: `linkage` is expected");
  check_refusal("\nlinkage hexapod\n", "test.device:2: `hexapod` is no linkage");
  check_refusal("linkage serial_arm 4\n", "test.device:1: a serial arm has 2 or 3 joints, not `4`");
  check_refusal(kFiveBar + "bse 1 mm\n", "test.device:17: unknown key `bse`; did you mean `base`?");
  check_refusal(kFiveBar + "counts_2 1 counts/rad\n",
                "test.device:17: this linkage has no `counts_2`; it has `counts_0` to");
  check_refusal(kFiveBar + "base 25 mm\n", "`base` is given twice, first in line 3");
  check_refusal(kFiveBar + "tip up\n", "given twice");
  check_refusal(edited(kFiveBar, "tip left", "tip up"), "`tip` is left or right, not `up`");
  check_refusal(edited(kFiveBar, "base 25 mm", "base 25 N"), "`N` is not a unit for `base`");
  check_refusal(edited(kFiveBar, "base 25 mm", "base 25"), "the line ends where the unit");
  check_refusal(edited(kFiveBar, "63 mm", "0 mm"), "test.device:4: `proximal_0` = 0 m is outside");
  check_refusal(edited(kFiveBar, "63 mm", "nan mm"), "needs a number instead of `nan`");
  check_refusal(edited(kFiveBar, "63 mm", "63 mm mm"), "unexpected `mm`");
  check_refusal(edited(kFiveBar, "max_torque_1 0.2 N*m\n", ""),
                "`max_torque_1` is missing; add a line `max_torque_1 VALUE N*m`");
  const std::string currents = edited(kFiveBar, "max_torque_1 0.2 N*m", "max_current_1 2 A");
  const std::string constant = "torque_constant_1 0.1 N*m/A\n";
  check_refusal(currents, "test.device:16: `max_current_1` needs `torque_constant_1`, above 0");
  check_refusal(currents + "torque_constant_1 0 N*m/A\n", "needs `torque_constant_1`, above 0");
  check_refusal(kFiveBar + constant + "max_current_1 2 A\n",
                "test.device:18: `max_current_1` and `max_torque_1` say the same; leave one");
  check_refusal(kFiveBar + constant, "test.device:17: `torque_constant_1` needs `max_current_1`");
  check_refusal(edited(currents, "2 A", "0 A") + constant,
                "test.device:16: `max_current_1` needs to be above 0, to 1000 N*m");
  check_refusal(edited(currents, "2 A", "2 N*m"), "`N*m` is not a unit for `max_current_1`");
  check_refusal(currents + constant + "continuous_current_1 0.5 A\n",
                "test.device:18: `continuous_current_1` needs `thermal_time_1`, too");
  check_refusal(
      currents + constant + "continuous_current_1 3 A\nthermal_time_1 5 s\n",
      "test.device:18: `continuous_current_1` needs to be above 0, from `home_torque_` to");
  check_refusal(edited(kFiveBar, "base 25 mm", "base 2500 mm"),
                "test.device:2: `linkage` has links that meet at no angles");
  check_refusal(edited(kFiveBar, "base 25 mm", "base -25 mm"),
                "test.device:3: `base` needs to be 0 or above");
  check_refusal(edited(kFiveBar, "low_1 30", "low_1 130"),
                "test.device:15: `high_1` needs to be above `low_` of its joint");
  check_refusal(edited(kFiveBar, "0.2 N*m", "0 N*m"),
                "test.device:16: `max_torque_1` needs to be above 0");
  check_refusal("linkage serial_arm 2.5\n", "has 2 or 3 joints, not `2.5`");
  check_refusal(kFiveBar + "linkage five_bar\n", "`linkage` is given twice, first in line 2");
  check_refusal(kFiveBar + "quux 1 mm\n", "`firmtouch-sim device --help` lists the known ones");
  check_refusal(kFiveBar + "full_from 1.5\n",
                "test.device:17: `full_from` = 1.5 is outside 0 to 1");
  check_refusal(edited(kFiveBar, "2000 counts", "0 counts"),
                "test.device:13: `counts_1` needs 1 to 1e7 counts/rad");
  check_refusal(kFiveBar + "max_speed 0 deg/s\n",
                "test.device:17: `max_speed` needs to be above 0");
  check_refusal(kFiveBar + "home pose\n",
                "test.device:17: `home_pose_0` needs to be from `low_0` to `high_0`; it is 0");
  check_refusal(kFiveBar + "home stops\nhome_torque_1 0.25 N*m\n",
                "test.device:18: `home_torque_1` needs to be at most `max_torque_1`");
  check_refusal(kFiveBar + "home stops\nhome_speed 0 rad/s\n", "home_speed at most max_speed");
  check_refusal(kFiveBar + "second_1 100 counts/rad\nsecond_within 1 deg\n",
                "test.device:18: `second_within` needs 3 counts");
  check_refusal(kFiveBar + "second_1 0 counts/rad\nsecond_within 1 deg\n",
                "test.device:18: `second_within` needs a `second_` other than 0");
  check_refusal(kFiveBar + "full_from 0.05\ngone_at 0.1\n",
                "test.device:18: `gone_at` needs 0.001 <= gone_at < full_from");
}

TEST(DeviceFile_MistakesInFrictionSpringsAndHeat_NameTheLineAndTheRemedy) {
  check_refusal(kFiveBar + "relaxed_1 90 deg\n", "test.device:17: `relaxed_1` needs `spring_1`");
  check_refusal(kFiveBar + "spring_1 1 N*m/rad\n", "test.device:17: `spring_1` needs `relaxed_1`");
  check_refusal(kFiveBar + "spring_1 1e-50 N*m/rad\nrelaxed_1 1 rad\n",
                "test.device:17: `spring_1` needs to be above 0");
  check_refusal(kFiveBar + "spring_1 1001 N*m/rad\n", "`spring_1` = 1001 N*m/rad is outside");
  check_refusal(kFiveBar + "coulomb_0 1 mN*m\nfriction_share 0.5\n",
                "test.device:18: `friction_share` needs `carried_share`");
  const std::string share = "carried_share 0.5\nfriction_share 0.5\n";
  check_refusal(kFiveBar + share, "test.device:18: `friction_share` needs `coulomb_0`");
  check_refusal(kFiveBar + share + "coulomb_1 0.3 N*m\n", "needs `coulomb_1` up to `max_torque_1`");
  check_refusal(kFiveBar + share + "coulomb_1 1 mN*m\nrotor_1 1e-5 kg*m2\ncable_1 9 N*m/rad\n",
                "needs a joint without `cable_1`");
  check_refusal(kFiveBar + "coulomb_0 -1 mN*m\n", "is outside 0 to 100");
  check_refusal(kFiveBar + "friction_share 0.9\n", "`friction_share` = 0.9 is outside 0 to 0.8");
  const std::string thermal = "continuous_torque_1 0.1 N*m\nthermal_time_1 ";
  check_refusal(kFiveBar + edited(thermal, "0.1", "0.21") + "5 s\n",
                "test.device:17: `continuous_torque_1` needs to be above 0, from `home_torque_`");
  check_refusal(kFiveBar + "home stops\nhome_torque_1 0.11 N*m\n" + thermal + "5 s\n",
                "test.device:19: `continuous_torque_1` needs to be above 0, from `home_torque_`");
  check_refusal(kFiveBar + thermal + "0.39 s\n", "test.device:18: `thermal_time_1` needs 0.1 s");
  check_refusal(kFiveBar + edited(thermal, "0.1", "0") + "0 s\n",
                "`continuous_torque_0` or that of another joint");
  check_refusal(kFiveBar + "thermal_time_1 5 s\n", "needs `continuous_torque_1`, too");
  check_refusal(kFiveBar + "stribeck_speed_1 1 rad/s\n",
                "test.device:17: `stribeck_speed_1` needs `breakaway_1`");
  check_refusal(kFiveBar + "breakaway_1 1 mN*m\n",
                "test.device:17: `breakaway_1` needs `stribeck_speed_1`");
  check_refusal(kFiveBar + "coulomb_1 2 mN*m\nbreakaway_1 1 mN*m\nstribeck_speed_1 1 rad/s\n",
                "test.device:18: `breakaway_1` needs to be at least `coulomb_1`");
  check_refusal(kFiveBar + "cogging_1 1 mN*m\n", "test.device:17: `cogging_1` needs `poles_1`");
  check_refusal(kFiveBar + "cable_0 10 N*m/rad\n", "test.device:17: `cable_0` on `rotor_0` would");
}

TEST(Workspace_GoodRanges_AreFreeOfSingularities) {
  for (const std::string& text : {kFiveBar, kDelta}) {
    const LinkageDevice device = read(text);
    const Workspace space = host_sim::workspace_of(device, 20);
    CHECK(host_sim::is_free_of_singularities(space));
    CHECK_EQ(space.poses, device.joints.joints == 2 ? 441u : 9261u);
    CHECK_EQ(space.reachable, space.poses);
    CHECK_GE(space.worst_condition, 0.1);
  }
}

// By hand, of the elbow at a right angle: columns of 0.25 and 0.15 m, 0.03 m^2 between them.
TEST(Workspace_PlanarArm_HasTheForceAndTheCountOfItsLongestColumn) {
  const std::string text =
      "linkage serial_arm 2\nlink_0 0.2 m\nlink_1 0.15 m\n"
      "counts_0 1000 counts/rad\nlow_0 0 deg\nhigh_0 90 deg\nmax_torque_0 0.5 N*m\n"
      "counts_1 500 counts/rad\nlow_1 90 deg\nhigh_1 91 deg\nmax_torque_1 0.6 N*m\n";
  const Workspace space = host_sim::workspace_of(read(text), 10);
  CHECK(host_sim::is_free_of_singularities(space));
  CHECK_LE(std::fabs(space.least_force_N - 0.5 / 0.25), 1e-6);
  CHECK_EQ(space.lasting_force_N, space.least_force_N);
  const LinkageDevice hot = read(text + "continuous_torque_1 0.1 N*m\nthermal_time_1 5 s\n");
  CHECK_LE(std::fabs(host_sim::workspace_of(hot, 10).lasting_force_N - 0.1 / 0.15), 1e-6);
  CHECK_LE(std::fabs(host_sim::workspace_of(hot, 10).least_force_N - 0.5 / 0.25), 1e-6);
  CHECK_LE(std::fabs(space.count_m - 0.15 / 500), 1e-9);
  CHECK_LE(std::fabs(space.worst_condition - 2 * 0.03 / (0.0625 + 0.0225)), 1e-6);
  CHECK_LE(std::fabs(space.worst_at_rad[1] - 1.570796327), 1e-6);
  CHECK_LE(std::fabs(space.high_m.y - 0.25), 1e-3);
  CHECK_LE(std::fabs(space.high_m.x - 0.2), 1e-6);
}

// A tip of 50 g on links without mass. Where the first rotor is too heavy to move, a force moves
// the tip about the elbow alone, with its rotor: 50 g + 1e-3 kg m2 / (0.1 m)^2.
TEST(Workspace_LeastMass_IsThatOfTheTip_AndOfARotor) {
  const std::string text =
      "linkage serial_arm 2\nlink_0 0.2 m\nlink_1 0.1 m\ntip_mass 50 g\n"
      "counts_0 2000 counts/rad\ncounts_1 2000 counts/rad\nmax_torque_0 1 N*m\n"
      "max_torque_1 1 N*m\nlow_0 0 rad\nhigh_0 1 rad\nlow_1 0.7 rad\nhigh_1 2 rad\n";
  const auto least_kg = [&](const char* rotors) {
    return host_sim::workspace_of(read(text + rotors), 20).least_mass_kg;
  };
  CHECK_LE(std::fabs(least_kg("rotor_0 1e-12 kg*m2\nrotor_1 1e-12 kg*m2\n") - 0.05), 1e-6);
  CHECK_LE(std::fabs(least_kg("rotor_0 100 kg*m2\nrotor_1 1e-3 kg*m2\n") - 0.15), 1e-4);
}

TEST(StiffestWall_ByItsOwnGain_IsOneMillijoule) {
  Workspace space;
  for (const double mass_kg : {0.02, 0.1})
    for (const double count_m : {0.0, 5e-6, 1e-4}) {
      space.least_mass_kg = mass_kg, space.count_m = count_m;
      const double K = host_sim::stiffest_wall_N_per_m(space, 1e-3), E = 0.6e-3;
      const double force_N = std::sqrt(2 * K * E);
      const double outrun_J = force_N * force_N * 1e-6 / mass_kg;
      CHECK_LE(std::fabs(E + outrun_J + count_m * force_N - 1e-3), 1e-9);
    }
}

TEST(Workspace_StretchedElbowBetweenTwoPoses_IsFound) {
  std::string text =
      "linkage serial_arm 2\nlink_0 0.2 m\nlink_1 0.15 m\n"
      "counts_0 1000 counts/rad\nlow_0 0 deg\nhigh_0 90 deg\nmax_torque_0 1 N*m\n"
      "counts_1 1000 counts/rad\nlow_1 -60 deg\nhigh_1 70 deg\nmax_torque_1 1 N*m\n";
  const Workspace space = host_sim::workspace_of(read(text), 1);  // its ends alone
  CHECK_EQ(space.with_whole_force, 4u);
  CHECK(space.changes_orientation);
  CHECK(!host_sim::is_free_of_singularities(space));
  text = edited(text, "low_1 -60", "low_1 1");
  CHECK(!host_sim::is_free_of_singularities(host_sim::workspace_of(read(text), 10)));
}

TEST(Workspace_ElbowsOutOfReach_IsFound) {
  const std::string text =
      edited(edited(kFiveBar, "high_0 150", "high_0 180"), "low_1 30", "low_1 0");
  const Workspace space = host_sim::workspace_of(read(text), 20);
  CHECK_LT(space.reachable, space.poses);
  CHECK(!host_sim::is_free_of_singularities(space));
}
