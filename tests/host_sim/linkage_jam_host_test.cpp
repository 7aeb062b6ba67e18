// A simulated linkage that is pushed to where its links come into one line: it jams, and all stays
// finite, whatever pushes it.
#include <cmath>
#include <string>

#include "device/machines.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"
#include "host_sim/device/linkage_body.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::JointMotion;
using host_sim::LinkageBody;
using host_sim::Vec;
using tools::LinkageDevice;

namespace {

constexpr double kStep_s = 2e-5;
constexpr double kNone[3] = {0, 0, 0};

// A machine whose ranges have no ends.
LinkageDevice endless(const std::string& name) {
  LinkageDevice device = tools::read_device(name, tools::machine_text(name));
  for (device::JointSetting& joint : device.joints.joint) joint.low_rad = -90, joint.high_rad = 90;
  return device;
}

JointMotion middle(const std::string& name) {
  const LinkageDevice device = tools::read_device(name, tools::machine_text(name));
  JointMotion at;
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    at.angle_rad[k] =
        0.5 * static_cast<double>(device.joints.joint[k].low_rad + device.joints.joint[k].high_rad);
  return at;
}

bool is_finite(const LinkageBody& body) {
  const host_sim::EnergyBook& book = body.energy();
  double all = host_sim::norm(body.tip().at_m) + host_sim::norm(body.tip().velocity_mps) +
               book.hand_J + book.motors_J + book.lost_J + book.stored_J;
  for (uint32_t k = 0; k < 3; ++k)
    all += body.motion().angle_rad[k] + body.motion().rate_rad_per_s[k];
  return std::isfinite(all);
}

double uniform(test::Lcg& random) { return static_cast<double>(random.between(-1, 1)); }
Vec any_way(test::Lcg& random) { return {uniform(random), uniform(random), uniform(random)}; }

// A spring and damper toward a goal that jumps; `damping` below 0: it feeds energy in.
struct Hand {
  double stiffness, damping, reach_m, torque_Nm;
};

// Result: whether all was finite.
bool survives(const LinkageDevice& device, const JointMotion& start, const Hand& hand,
              uint32_t seed, uint64_t& jams) {
  test::Lcg random(seed);
  LinkageBody body(device, start);
  Vec goal_m, hand_N;
  double motor_Nm[3] = {};
  bool is_good = true;
  for (uint32_t step = 0; step < 2000 && is_good; ++step) {
    if (step % 500 == 0) {
      goal_m = any_way(random) * hand.reach_m;
      for (double& torque_Nm : motor_Nm) torque_Nm = hand.torque_Nm * uniform(random);
    }
    hand_N = (goal_m - body.tip().at_m) * hand.stiffness - body.tip().velocity_mps * hand.damping;
    body.advance(motor_Nm, hand_N, kStep_s);
    is_good = is_finite(body);
  }
  jams += body.jams();
  return is_good;
}

}  // namespace

TEST(Jam_EveryMachineUnderEveryHand_StaysFinite) {
  const Hand hands[] = {{400, 4, 0.3, 0.1},    {3000, 20, 0.5, 0}, {400, -4, 0.3, 0.3},
                        {20000, -50, 1, 5},    {1e6, 0, 10, 100},  {1e12, -1e9, 1e3, 1e9},
                        {1e300, 1e300, 1e5, 0}};
  for (const std::string& name : tools::machine_names()) {
    const LinkageDevice device = endless(name);
    uint64_t jams = 0;
    uint32_t seed = 0;
    for (const Hand& hand : hands)
      for (uint32_t run = 0; run < 2; ++run) {
        test::note(name.c_str(), ++seed);
        CHECK(survives(device, middle(name), hand, seed, jams));
      }
    test::note("jams", static_cast<uint32_t>(jams));
    CHECK_GE(jams, 1u);
  }
}

// A hand that pulls outward ends where the rods are in one line; then the other way leads it back.
TEST(Jam_HoldsWhereTheLinksAreInLine_AndIsLeftByAPullBack) {
  for (const char* name : {"haply_pantograph", "pantograph_mk2", "omega_like"}) {
    const LinkageDevice device = endless(name);
    LinkageBody body(device, middle(name));
    const Vec start_m = body.tip().at_m, out_N = host_sim::unit(start_m) * 3;
    for (uint32_t step = 0; step < 50000; ++step) body.advance(kNone, out_N, kStep_s);
    const Vec held_m = body.tip().at_m;
    test::note(name, static_cast<uint32_t>(body.jams()));
    CHECK_GE(body.jams(), 1u);
    CHECK_GE(dot(held_m - start_m, out_N), 0.003);
    CHECK_LE(body.energy().error_J(), 1e-3 * body.energy().turnover_J);
    CHECK_GE(body.energy().error_J(), -1e-3 * body.energy().turnover_J);
    for (uint32_t step = 0; step < 10000; ++step) body.advance(kNone, out_N * -1, kStep_s);
    CHECK_LE(dot(body.tip().at_m - held_m, out_N), -0.003);
  }
}

// An arm has no loop: straight is a pose like others, and its energy does not change there.
TEST(ArmThroughItsStraightPose_KeepsItsEnergy) {
  const LinkageDevice device = endless("touch_like");
  LinkageBody body(device, {{0.2, 0.5, -0.4}, {0, 0, 4}});
  double high_rad = -1, kinetic_J = body.kinetic_J();
  for (uint32_t step = 0; step < 25000; ++step) {
    body.advance(kNone, {}, kStep_s);
    kinetic_J = std::max(kinetic_J, body.kinetic_J());
    high_rad = std::max(high_rad, body.motion().angle_rad[2]);
  }
  CHECK_GE(high_rad, 0.1);
  CHECK_EQ(body.jams(), uint64_t{0});
  CHECK_LE(std::fabs(body.energy().error_J()), 1e-6 * kinetic_J);
}

TEST(TorqueThatIsNotFinite_MovesNothing) {
  LinkageBody body(endless("falcon_like"), middle("falcon_like"));
  const double bad_Nm[] = {NAN, 0, INFINITY};
  for (uint32_t step = 0; step < 100; ++step) body.advance(bad_Nm, {NAN, 0, 0}, kStep_s);
  CHECK(is_finite(body));
  CHECK_LE(std::fabs(body.motion().angle_rad[0] - middle("falcon_like").angle_rad[0]), 0.0);
}
