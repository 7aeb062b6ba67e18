// Limits of sampled walls: the exact bound against eigenvalues, simulation against the exact bound.
#include <cmath>

#include "device/machines.hpp"
#include "firmtouch/device/stable_wall.hpp"
#include "harness/test.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "host_sim/plant/sampled_wall.hpp"

#if __has_include(<Eigen/Eigenvalues>)
#include <Eigen/Eigenvalues>
#define FIRMTOUCH_HAS_EIGEN 1
#endif

using namespace firmtouch::host_sim;

// Pushed for a moment in 20,000 directions, the simulated tip moves most easily as the figures say;
// at the middle of a machine's ranges, with joints of different friction.
TEST(TipFigures_EveryMachine_AreTheLeastOverDirections) {
  namespace tools = firmtouch::tools;
  for (const std::string& name : tools::machine_names()) {
    tools::LinkageDevice device = tools::read_device(name, tools::machine_text(name));
    device.masses.gravity_mps2 = {0, 0, 0};
    const uint32_t joints = device.joints.joints;
    tools::JointMotion at;
    for (uint32_t k = 0; k < joints; ++k) {
      const auto& joint = device.joints.joint[k];
      at.angle_rad[k] = 0.5 * static_cast<double>(joint.low_rad + joint.high_rad);
      device.masses.joint[k].viscous_N_m_s = 1e-3 * (k + 1);
      device.masses.joint[k].coulomb_N_m = 0;
    }
    const tools::TipFigures figures = tools::tip_figures(device, at);
    const LinkageBody start(device, at);
    double ease = 0, yield = 0;  // largest acceleration and speed along a force of 1 N
    for (int i = 0; i < 20000; ++i) {
      const double z = joints == 2 ? 0 : 1 - i / 10000.0, turn = 2.399963 * i;
      const double flat = std::sqrt(1 - z * z);
      const Vec way{flat * std::cos(turn), flat * std::sin(turn), z};
      LinkageBody body = start;
      body.advance({}, way, 1e-7);
      double speed = 0, slow = 0;
      for (uint32_t k = 0; k < joints; ++k) {
        const double along = dot(start.tip().column_m[k], way);
        speed += along * body.motion().rate_rad_per_s[k];
        slow += along * along / device.masses.joint[k].viscous_N_m_s;
      }
      ease = std::fmax(ease, speed / 1e-7);
      yield = std::fmax(yield, slow);
    }
    firmtouch::test::note((name + ": least mass, mg").c_str(),
                          static_cast<int64_t>(figures.least_mass_kg * 1e6));
    CHECK_LE(std::fabs(figures.least_mass_kg * ease - 1), 1e-3);
    CHECK_LE(std::fabs(figures.least_damping_N_s_per_m * yield - 1), 1e-3);
  }
}

// The firmware's closed form against the Schur-Cohn bound of the exact model.
TEST(StableWallOfTheFirmware_IsThatOfTheExactModel) {
  const auto firmware = [](const SampledWall& wall) {
    return static_cast<double>(firmtouch::device::stiffest_stable_N_per_m(
        static_cast<float>(wall.mass_kg),
        static_cast<float>(wall.damping_N_s_per_m + wall.viscous_N_s_per_m),
        static_cast<float>(wall.period_s)));
  };
  for (const double mass_kg : {.02, .05, .2, 1.})
    for (const double period_s : {.1e-3, .25e-3, 1e-3})
      for (const double damping : {.1, .5, 1., 5., 10.}) {
        SampledWall wall{mass_kg, 0, period_s, damping};
        const double share = damping * period_s / (2 * mass_kg);
        CHECK_LE(std::fabs(firmware(wall) / exact_limit_N_per_m(wall) - 1), 1e-5);
        wall.viscous_N_s_per_m = wall.damping_N_s_per_m = damping / 2;
        const double ratio = firmware(wall) / exact_limit_N_per_m(wall);
        CHECK_LE(ratio, 1 + 1e-5);
        CHECK_GE(ratio, 1 - 1.2 * share);
      }
  CHECK_LE(firmware({.001, 0, 1e-3, 2}), 0.0);  // two positions apart, the damper turns the mass
}

TEST(SchurStable_KnownRoots_AreSeparated) {
  const double half[] = {1, -0.5};
  CHECK(is_schur_stable(half, 1));
  const double outside[] = {2, 0, 0, -2.001};  // roots of size just above 1
  CHECK(!is_schur_stable(outside, 3));
  const double inside[] = {2, 0, 0, -1.999};
  CHECK(is_schur_stable(inside, 3));
  const double pair[] = {1, -1.8, 0.9};  // 0.9 +- 0.3 i: size 0.9487
  CHECK(is_schur_stable(pair, 2));
  const double wide[] = {1, -1.8, 1.01};
  CHECK(!is_schur_stable(wide, 2));
}

#ifdef FIRMTOUCH_HAS_EIGEN
namespace {

// e^a: twenty terms of the series of a / 64, squared six times.
Eigen::Matrix3d exponential(const Eigen::Matrix3d& a) {
  Eigen::Matrix3d term = Eigen::Matrix3d::Identity(), sum = term;
  for (int n = 1; n <= 20; ++n) sum += term = term * a / (64.0 * n);
  for (int n = 0; n < 6; ++n) sum = sum * sum;
  return sum;
}

// Largest size of an eigenvalue of the loop: position, velocity, the position of a tick ago, and
// the forces that wait.
double spectral_radius(const SampledWall& wall, double stiffness) {
  const double m = wall.mass_kg + wall.hand_mass_kg;
  Eigen::Matrix3d rate;
  rate << 0, 1, 0, -wall.hand_stiffness_N_per_m / m,
      -(wall.viscous_N_s_per_m + wall.hand_damping_N_s_per_m) / m, 1 / m, 0, 0, 0;
  const Eigen::Matrix3d period = exponential(rate * wall.period_s);
  const int delay = static_cast<int>(wall.delay_samples), size = 3 + delay;
  Eigen::RowVectorXd force = Eigen::RowVectorXd::Zero(size);
  force(0) = -stiffness - wall.damping_N_s_per_m / wall.period_s;
  force(2) = wall.damping_N_s_per_m / wall.period_s;
  Eigen::RowVectorXd applied = force;
  if (delay > 0) applied = Eigen::RowVectorXd::Unit(size, 3);  // the one that waits longest
  Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(size, size);
  loop.topLeftCorner(2, 2) = period.topLeftCorner(2, 2);
  loop.topRows(2) += period.topRightCorner(2, 1) * applied;
  loop(2, 0) = 1;
  for (int i = 0; i < delay; ++i)
    loop.row(3 + i) =
        i + 1 < delay ? Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(size, 4 + i)) : force;
  return loop.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace
#endif

TEST(ExactLimit_SpectralRadiusIsOneThere) {
#ifdef FIRMTOUCH_HAS_EIGEN
  for (const double mass_kg : {0.05, 0.2})
    for (const double viscous : {0.2, 1.0})
      for (const double damping : {0.0, 0.3, 10.0})
        for (const uint32_t delay : {0u, 1u, 2u})
          for (const double grip : {0.0, 1.0}) {
            const SampledWall wall = {mass_kg, viscous,    0.5e-3,     damping,
                                      delay,   0.1 * grip, 3.0 * grip, 400 * grip};
            const double limit = exact_limit_N_per_m(wall);
            CHECK_LT(spectral_radius(wall, 0.999 * limit), 1);
            CHECK_GT(spectral_radius(wall, 1.001 * limit), 1);
          }
#else
  firmtouch::test::skip("Eigen is not installed");
#endif
}

TEST(SimulatedLimit_EqualsExactOne_FreeAndHeld) {
  const SampledWall walls[] = {{.075, .5, 1e-3, 5, 0, 0, 0, 0},
                               {.200, 1., 1e-3, 10, 2, 0, 0, 0},
                               {.050, .2, 1e-3, .1, 1, .15, 6, 700}};
  for (const SampledWall& wall : walls)
    CHECK_LE(std::fabs(simulated_limit_N_per_m(wall) / exact_limit_N_per_m(wall) - 1), 0.01);
}

TEST(PassiveWall_IsBelowTheStableOne) {
  for (const double damping : {0.0, 0.2, 0.4}) {
    const SampledWall wall = {.075, .5, 1e-3, damping, 0, 0, 0, 0};
    CHECK_LE(passive_limit_N_per_m(wall), 1.001 * exact_limit_N_per_m(wall));
  }
}

// 75 g, b 0.5, B 5, 30 um, 1 kHz. An ideal velocity would give 11,000 N/m, the low-pass gives 7,286
// within the steps of the search.
TEST(WallAtRest_Tracking_IsStifferThanTheLowPass_AndEdgesThanBoth) {
  using firmtouch::device::Estimator;
  namespace bench = firmtouch::bench;
  const SampledWall wall = {.075, .5, 1e-3, 5, 0, 0, 0, 0};
  const double quantum_m = 30e-6;
  const auto rest_of = [&](Estimator kind) {
    return rest_limit_N_per_m(
        wall, quantum_m,
        {"", bench::firmware_estimate({kind, 150}, quantum_m, wall.period_s), false});
  };
  const double low_pass = rest_of(Estimator::kLowPass), tracking = rest_of(Estimator::kTracking);
  const double edges = rest_limit_N_per_m(
      wall, quantum_m, {"", bench::edge_estimate(quantum_m, wall.period_s), true});
  CHECK_LE(std::fabs(low_pass / 7286 - 1), 0.06);
  CHECK_GE(tracking, 1.15 * 7286);
  CHECK_LE(tracking, 11000);
  CHECK_GE(edges, 1.1 * tracking);
}

TEST(QuantisedWall_CycleOfItsPeriod_HasTheExactAmplitude) {
  QuantisedWall wall;
  wall.viscous_N_s_per_m = 1.2 * wall.stiffness_N_per_m * wall.period_s;
  const Motion seen = simulated_motion(wall);
  CHECK(seen.regime == Regime::kCycle);
  const double exact_m = cycle_amplitude_m(wall, seen.half_period_ticks);
  CHECK_GT(exact_m, 0);
  CHECK_LE(std::fabs(seen.amplitude_m / exact_m - 1), 0.01);
}

TEST(QuantisedWall_FrictionOfHalfAForceStep_HoldsTheAxis) {
  QuantisedWall wall;
  wall.viscous_N_s_per_m = 0.6 * wall.stiffness_N_per_m * wall.period_s;
  wall.coulomb_N = 0.6 * wall.stiffness_N_per_m * wall.quantum_m;
  CHECK(predicted_motion(wall).regime == Regime::kRest);
  CHECK(simulated_motion(wall).regime == Regime::kRest);
  wall.coulomb_N = 0;
  CHECK(simulated_motion(wall).regime == Regime::kCycle);
}
