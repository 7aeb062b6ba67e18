// Stribeck friction of a joint against closed forms: a rotor alone, driven or drawn by a spring.
#include <cmath>
#include <string>

#include "harness/test.hpp"
#include "host_sim/device/linkage_body.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::JointMotion;
using host_sim::LinkageBody;

namespace {

constexpr double kStep_s = 2e-5, kInertia_kg_m2 = 1e-3;
constexpr double kCoulomb_Nm = 0.02, kBreakaway_Nm = 0.03, kStribeck_rad_per_s = 0.5;

// Without masses and weight only the rotors move.
LinkageBody rotor(double viscous_N_m_s, double rate_rad_per_s) {
  const std::string text =
      "linkage serial_arm 2\nlink_0 100 mm\nlink_1 100 mm\nrotor_0 1e-3 kg*m2\n"
      "rotor_1 1e-3 kg*m2\ncounts_0 5000 counts/rad\ncounts_1 5000 counts/rad\n"
      "max_torque_0 1 N*m\nmax_torque_1 1 N*m\nlow_0 -1.5 rad\nhigh_0 1.5 rad\nlow_1 0.7 rad\n"
      "high_1 2 rad\ncoulomb_0 0.02 N*m\nbreakaway_0 0.03 N*m\nstribeck_speed_0 0.5 rad/s\n"
      "viscous_0 " +
      std::to_string(viscous_N_m_s) + " N*m*s/rad\n";
  JointMotion start;
  start.angle_rad[0] = -0.5, start.angle_rad[1] = 1.2, start.rate_rad_per_s[0] = rate_rad_per_s;
  return LinkageBody(tools::read_device("rotor", text), start);
}

double rate_of(const LinkageBody& body) { return body.motion().rate_rad_per_s[0]; }

double friction_Nm(double rate_rad_per_s, double viscous_N_m_s) {
  const double rates = rate_rad_per_s / kStribeck_rad_per_s;
  return kCoulomb_Nm + (kBreakaway_Nm - kCoulomb_Nm) * std::exp(-rates * rates) +
         viscous_N_m_s * rate_rad_per_s;
}

// Viscous friction that makes up for the fall of the dry one at a rate.
double critical_N_m_s(double rate_rad_per_s) {
  const double rates = rate_rad_per_s / kStribeck_rad_per_s;
  return 2 * (kBreakaway_Nm - kCoulomb_Nm) * rates / kStribeck_rad_per_s * std::exp(-rates * rates);
}

}  // namespace

TEST(Stribeck_SlidingEvenly_HasTheTorqueOfItsRate) {
  for (const double rate : {0.02, 0.2, 0.5, 1.0, -0.7}) {
    LinkageBody body = rotor(0.05, 1.2 * rate);
    const double motor_Nm[] = {std::copysign(friction_Nm(std::fabs(rate), 0.05), rate), 0, 0};
    for (int i = 0; i < 35000; ++i) body.advance(motor_Nm, {}, kStep_s);
    CHECK_LE(std::fabs(rate_of(body) / rate - 1), 1e-6);
    CHECK_LE(std::fabs(body.energy().error_J()), 1e-5 * body.energy().turnover_J);
  }
}

TEST(Stribeck_AtRest_HoldsUpToItsBreakaway) {
  LinkageBody body = rotor(0, 0);
  for (int i = 0; i < 50000; ++i) body.advance({0.999 * kBreakaway_Nm, 0, 0}, {}, kStep_s);
  CHECK_LE(std::fabs(rate_of(body)), 1e-12);
  for (int i = 0; i < 5000; ++i) body.advance({1.02 * kBreakaway_Nm, 0, 0}, {}, kStep_s);
  const double rate = rate_of(body);
  CHECK_GE(rate, 1e-3);
  // It slides, and speeds up, under a torque that it held.
  for (int i = 0; i < 1000; ++i) body.advance({0.999 * kBreakaway_Nm, 0, 0}, {}, kStep_s);
  CHECK_GE(rate_of(body), rate);
}

// Drawn by a spring at a rate, an error of the rate grows by (critical - viscous) / (2 inertia).
TEST(Stribeck_DrawnByASpring_SlipsAndSticksBelowTheCriticalDamping) {
  constexpr double kSpring_Nm = 1, kRate = 0.4;
  for (const double share : {0.85, 0.95, 1.05, 1.15}) {
    const double viscous = std::round(1e6 * share * critical_N_m_s(kRate)) * 1e-6;
    LinkageBody body = rotor(viscous, 1.001 * kRate);
    const double ahead_rad = friction_Nm(kRate, viscous) / kSpring_Nm - 0.5;
    double first = 0, last = 0, time_s = 0, peak = 0, before = 0, first_s = 0, last_s = 0;
    for (int i = 0; i < 100000; ++i, time_s += kStep_s) {
      // Half a step ahead: the torque is constant in it.
      const double drawn_rad = ahead_rad + kRate * (time_s + 0.5 * kStep_s);
      const double at_rad = body.motion().angle_rad[0] + 0.5 * kStep_s * rate_of(body);
      body.advance({kSpring_Nm * (drawn_rad - at_rad), 0, 0}, {}, kStep_s);
      const double off = rate_of(body) - kRate;
      if (before <= 0 && off > 0) peak = 0;
      if (off > peak) peak = off;
      if (before > 0 && off <= 0 && time_s > 0.1) {
        if (!(first > 0)) first = peak, first_s = time_s;
        last = peak, last_s = time_s;
      }
      before = off;
    }
    const double growth_per_s = std::log(last / first) / (last_s - first_s);
    const double want_per_s = (critical_N_m_s(kRate) - viscous) / (2 * kInertia_kg_m2);
    CHECK_LE(std::fabs(growth_per_s / want_per_s - 1), 0.02);
  }
}

// Drawn slowly from rest it slips first where the spring has the breakaway's torque.
TEST(Stribeck_DrawnSlowly_SlipsFirstAtItsBreakaway) {
  constexpr double kSpring_Nm = 0.2, kRate = 0.1, kSlow_rad_per_s = 1e-7;
  LinkageBody body = rotor(1e-3, 0);
  double slip_s = 0, time_s = 0, fastest = 0, slowest_after = 1;
  for (int i = 0; i < 150000; ++i, time_s += kStep_s) {
    const double drawn_rad = kRate * time_s - 0.5;
    body.advance({kSpring_Nm * (drawn_rad - body.motion().angle_rad[0]), 0, 0}, {}, kStep_s);
    const double rate = rate_of(body);
    if (!(slip_s > 0) && rate > kSlow_rad_per_s) slip_s = time_s;
    fastest = std::fmax(fastest, rate);
    if (time_s > slip_s + 0.2 && slip_s > 0) slowest_after = std::fmin(slowest_after, rate);
  }
  // From then on the torque grows by spring x rate.
  const double pull_Nm_per_s = kSpring_Nm * kRate;
  const double want_s = kBreakaway_Nm / pull_Nm_per_s +
                        std::sqrt(2 * kSlow_rad_per_s * kInertia_kg_m2 / pull_Nm_per_s);
  CHECK_LE(std::fabs(slip_s - want_s), 2 * kStep_s);
  CHECK_GE(fastest, 2.2 * kRate);  // it slips by more than without a fall,
  CHECK_LE(std::fabs(slowest_after), LinkageBody::kMaxError_rad_per_s);  // and sticks again
}
