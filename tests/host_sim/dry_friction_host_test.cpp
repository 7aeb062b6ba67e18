// Coulomb friction of a step against its conditions, which one set of torques alone fulfils.
#include "host_sim/device/dry_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::DryFriction;
using host_sim::kJoints;

namespace {

double between(test::Lcg& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.between(0, 1));
}

struct Step {
  uint32_t joints = 3;
  double change[kJoints][kJoints] = {}, rate[kJoints] = {}, most_Nm[kJoints] = {};
};

// A A^T plus a part of the unit matrix; every fifth joint has no friction.
Step random_step(test::Lcg& random) {
  Step step;
  step.joints = 1 + (random.bits() >> 8) % 3;
  double a[kJoints][kJoints];
  for (auto& row : a)
    for (double& each : row) each = between(random, -1, 1);
  for (uint32_t i = 0; i < step.joints; ++i) {
    step.most_Nm[i] = (random.bits() >> 8) % 5 == 0 ? 0 : std::pow(10, between(random, -3, 0));
    for (uint32_t j = 0; j < step.joints; ++j) {
      step.change[i][j] = i == j ? 0.2 : 0;
      for (uint32_t k = 0; k < kJoints; ++k) step.change[i][j] += a[i][k] * a[j][k];
    }
  }
  return step;
}

// The most by which torques break a condition: beyond their most, or a rate that is left where one
// is below it, or with it where one is at it.
double broken_by(const Step& step, const double (&torque_Nm)[kJoints]) {
  double worst = 0;
  for (uint32_t k = 0; k < step.joints; ++k) {
    const double most_Nm = step.most_Nm[k];
    double left = step.rate[k];
    for (uint32_t j = 0; j < step.joints; ++j) left -= step.change[k][j] * torque_Nm[j];
    worst = std::max(worst, std::fabs(torque_Nm[k]) - most_Nm);
    if (torque_Nm[k] < most_Nm) worst = std::max(worst, left);
    if (torque_Nm[k] > -most_Nm) worst = std::max(worst, -left);
  }
  return worst;
}

}  // namespace

// Rates wander, so that joints come to rest, slide and turn round; then they jump.
TEST(DryFriction_AnyHistory_FulfilsItsConditions) {
  test::Lcg random(5);
  uint32_t resting = 0, sliding = 0;
  double worst = 0;
  for (uint32_t machine = 0; machine < 300; ++machine) {
    Step step = random_step(random);
    DryFriction friction;
    for (uint32_t i = 0; i < 300; ++i) {
      for (double& rate : step.rate)
        rate = i % 100 == 99 ? between(random, -3, 3) : 0.98 * rate + between(random, -0.1, 0.1);
      double torque_Nm[kJoints] = {};
      friction.torques(step.joints, step.change, step.rate, step.most_Nm, torque_Nm);
      worst = std::max(worst, broken_by(step, torque_Nm));
      for (uint32_t k = 0; k < step.joints; ++k)
        ++(std::fabs(torque_Nm[k]) < step.most_Nm[k] ? resting : sliding);
    }
  }
  test::note("worst, 1e-12", static_cast<int64_t>(worst * 1e12));
  CHECK_GE(resting, 20000u);
  CHECK_GE(sliding, 20000u);
  CHECK_LE(worst, 1e-12);
}

TEST(DryFriction_AfterNaN_IsThatOfAnother) {
  test::Lcg random(6);
  for (uint32_t machine = 0; machine < 100; ++machine) {
    Step step = random_step(random), bad = step;
    DryFriction friction;
    for (double& rate : bad.rate) rate = std::numeric_limits<double>::quiet_NaN();
    double torque_Nm[kJoints] = {};
    friction.torques(bad.joints, bad.change, bad.rate, bad.most_Nm, torque_Nm);
    for (double& rate : step.rate) rate = between(random, -1, 1);
    friction.torques(step.joints, step.change, step.rate, step.most_Nm, torque_Nm);
    CHECK_LE(broken_by(step, torque_Nm), 1e-12);
  }
}
