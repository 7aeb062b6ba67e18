// Friction that motors carry, on every machine: what it leaves to a hand that moves in free space,
// joints at rest under noisy encoders, and hands that try to gain energy from it.
#include <algorithm>
#include <cmath>
#include <string>

#include "device/machines.hpp"
#include "harness/test.hpp"
#include "host_sim/bench/passive_hands.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "host_sim/trace/run.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace host_sim;   // NOLINT: a test file

namespace {

constexpr double kShare = 0.8, kFade_rad_per_s = 0.05;
constexpr double kFriction = 0.03;  // of a joint's largest torque

// A machine with friction, of which motors carry `share`.
struct Rubbing {
  bench::TemporaryFolder folder;
  std::string path;
  tools::LinkageDevice device;

  Rubbing(const std::string& machine, double share, double noise_counts = 0) {
    std::string text = tools::machine_text(machine);
    if (text.find("carried_share") == std::string::npos) text += "carried_share 0.5\n";
    const tools::LinkageDevice bare = tools::read_device(machine, text);
    for (uint32_t k = 0; k < bare.joints.joints; ++k) {
      const std::string end = "_" + std::to_string(k) + " ";
      const double most_Nm = static_cast<double>(bare.limits.max_torque_Nm[k]);
      text += "coulomb" + end + with_unit(kFriction * most_Nm, "N*m") + "\nencoder_noise" + end +
              std::to_string(noise_counts) + "\n";
    }
    if (share > 0) text += "friction_share " + std::to_string(share) + "\n";
    path = folder.write("rubbing.txt", text);
    device = tools::read_device(path, text);
  }
};

// Of a part of a run, between two places of rest.
struct Work {
  double hand_J = 0, friction_J = 0;
  double law_J = 0;   // what the law carries of the friction at the true rates
  double turned = 0;  // the sum of all joints, radians
  double most_Nm = 0;
  uint32_t faults = 0;
};

Work work_of(const Rubbing& machine, const std::vector<std::string>& script, double from_s) {
  const Rig rig(1, machine.path);
  const Vec start_m{0, 0, 0.012};
  const Session session(rig.bake(plate(0.04)), {}, Contact::kProxy);
  const Scenario scenario =
      rig.scenario(start_m, script, {{"hand_stiffness", "3000 N/m"}, {"hand_damping", "20 N*s/m"}});
  const Environment environment;
  Simulation simulation(scenario, session.tick(), environment);
  Work work;
  JointMotion before;
  double before_J = 0;
  uint32_t ticks = 0;
  for (RunTick tick; simulation.next(tick); ++ticks) {
    if (ticks * 1e-3 >= from_s) {
      work.hand_J += tick.hand_J - before_J;
      for (uint32_t k = 0; k < machine.device.joints.joints; ++k) {
        const double turn_rad = std::fabs(tick.joints.angle_rad[k] - before.angle_rad[k]);
        const double rate = turn_rad / 1e-3;
        const double lost_J = machine.device.masses.joint[k].coulomb_N_m * turn_rad;
        work.friction_J += lost_J;
        work.law_J += kShare * lost_J * rate / (rate + kFade_rad_per_s);
        work.turned += turn_rad;
        work.most_Nm =
            std::max(work.most_Nm, std::fabs(static_cast<double>(tick.record.output.motor_N[k])) /
                                       static_cast<double>(machine.device.limits.max_torque_Nm[k]));
      }
    }
    before = tick.joints;
    before_J = tick.hand_J;
    work.faults |= tick.record.output.faults;
  }
  return work;
}

// Forth and back.
std::vector<std::string> strokes(double speed_mps) {
  std::vector<std::string> script = {Rig::hold_s(0.5)};
  for (const double x : {0.01, -0.01, 0.01, -0.01, 0.0})
    script.push_back(Rig::to({x, 0, 0.012}, speed_mps));
  script.push_back(Rig::hold_s(0.3));
  return script;
}

}  // namespace

// A bare hand does the work of Coulomb friction, and of one machine's viscous friction, too. Motors
// take from it what the law says, of rates that coarse encoders show late.
TEST(CarriedFriction_AMovingHand_HasTheRestToDo) {
  for (const std::string& name : tools::machine_names()) {
    const Rubbing bare(name, 0), carried(name, kShare);
    for (const bool is_fast : {false, true}) {
      const std::vector<std::string> script = strokes(is_fast ? 0.2 : 0.02);
      const Work whole = work_of(bare, script, 0.4), left = work_of(carried, script, 0.4);
      CHECK_EQ(whole.faults | left.faults, 0u);
      CHECK_LE(std::fabs(whole.hand_J - whole.friction_J), 0.03 * whole.friction_J);
      const double viscous_J = whole.hand_J - whole.friction_J;
      const double expected_J = left.friction_J - left.law_J + viscous_J;
      CHECK_LE(std::fabs(left.hand_J - expected_J), (is_fast ? 0.03 : 0.07) * expected_J);
      CHECK_LE(left.hand_J, (is_fast ? 0.3 : 0.55) * whole.hand_J);
      CHECK_GE(left.hand_J - viscous_J, (1 - kShare) * left.friction_J);
    }
  }
}

// A hand pulls at each joint by less than its friction. Noise makes the torques chatter, by no more
// than their share; what turns then is the joint that this hand pulls on.
TEST(CarriedFriction_AtRest_NothingCreeps) {
  for (const std::string& name : tools::machine_names())
    for (const double noise : {0.0, 1.0}) {
      const Rubbing carried(name, kShare, noise), bare(name, 0, noise);
      std::vector<std::string> script = strokes(0.1);
      script.push_back(Rig::hold_s(0.5));
      const Work rest = work_of(carried, script, 1.9), without = work_of(bare, script, 1.9);
      CHECK_EQ(rest.faults, 0u);
      CHECK_LE(rest.turned, noise > 0 ? 3e-4 : 1e-12);
      CHECK_LE(rest.most_Nm - without.most_Nm, noise > 0 ? kShare * kFriction + 5e-4 : 1e-5);
    }
}

// Whatever the encoders say, friction takes more than its torques give: the hand's work never
// falls.
TEST(CarriedFriction_InFreeSpace_GivesNothingBack) {
  for (const std::string& name : tools::machine_names())
    for (const double noise : {0.0, 3.0}) {
      const Rubbing carried(name, kShare, noise);
      const Rig rig(1, carried.path);
      const RigRun run = rig.run(plate(0.04), {0, 0, 0.012}, strokes(0.3));
      CHECK_EQ(run.back().faults, 0u);
      CHECK_LE(gain_J(run), 1e-9);
    }
}

TEST(CarriedFriction_HandsGainNoMoreThanAMillijoule) {
  for (const char* const name : {"haply_pantograph", "falcon_like", "touch_like"})
    for (const double noise : {0.0, 2.0}) {
      const Rubbing carried(name, kShare, noise);
      for (const uint64_t seed : {uint64_t{9}, uint64_t{36}})
        CHECK_LE(gain_J(random_run(carried.path, 5000, seed, {})), 0.001);
    }
}
