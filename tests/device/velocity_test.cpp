// Velocity estimators: steady motion, flicker, stops, and everything that a count can be.
#include "firmtouch/device/velocity.hpp"

#include <stdint.h>

#include "harness/test.hpp"

namespace device = firmtouch::device;
using device::Estimator;

namespace {

constexpr float kPerMetre = 33333.333f;  // counts of 30 um
constexpr Estimator kAll[] = {Estimator::kDifference, Estimator::kLowPass, Estimator::kTracking};

// An axis that an encoder follows: `counts` is its position, not yet rounded down.
struct Axis {
  Estimator kind = Estimator::kTracking;
  float period_s = 1e-3f;
  double counts = 0.3;
  int64_t last = 0;
  device::VelocityState state;

  float move(double counts_more) {
    counts += counts_more;
    int64_t now = static_cast<int64_t>(counts);
    if (static_cast<double>(now) > counts) --now;
    const float step = static_cast<float>(now - last);
    last = now;
    return device::estimate(state, {kind, 150.0f}, kPerMetre, step, period_s);
  }
};

float size(float a) { return a < 0.0f ? -a : a; }
bool is_finite(float a) { return a - a <= 0.0f; }

}  // namespace

TEST(Tracking_UniformMotion_EndsWithoutError) {
  constexpr float kPeriods_s[] = {1e-3f, 0.25e-3f, 0.1e-3f};
  constexpr double kSpeeds_mps[] = {0.002, -0.003, 0.005, -0.0073, 0.02, 0.126, -0.9};
  for (const float period_s : kPeriods_s) {
    for (const double mps : kSpeeds_mps) {
      Axis axis;
      axis.period_s = period_s;
      const double counts = mps * 33333.333 * static_cast<double>(period_s);
      const auto ticks = static_cast<int32_t>(3.0f / period_s);
      float worst = 0.0f;
      for (int32_t i = 0; i < ticks; ++i) {
        const float error = size(axis.move(counts) - static_cast<float>(mps));
        if (i > ticks / 2 && error > worst) worst = error;
      }
      firmtouch::test::note("um/s", static_cast<int64_t>(mps * 1e6));
      firmtouch::test::note("Hz", static_cast<int64_t>(1.0f / period_s + 0.5f));
      CHECK_LE(worst, 1e-4f);
    }
  }
}

TEST(Tracking_FlickerBetweenTwoCounts_IsSoonNoMotion) {
  device::VelocityState state;
  float velocity = 1.0f;
  for (int32_t i = 0; i < 200; ++i)
    velocity = device::estimate(state, {Estimator::kTracking, 0}, kPerMetre,
                                i % 2 == 0 ? 1.0f : -1.0f, 1e-3f);
  CHECK_LE(size(velocity), 1e-6f);
}

// The slope falls by 0.57 a tick until the line stays in its count, the lead by 4 in 5.
TEST(Tracking_AxisThatStops_IsEstimatedAtRestWithin50Milliseconds) {
  constexpr double kSpeeds_mps[] = {0.01, -0.1, 1.0};
  for (const double mps : kSpeeds_mps) {
    Axis axis;
    for (int32_t i = 0; i < 300; ++i) (void)axis.move(mps * 33.333333);
    for (int32_t i = 1; i < 400; ++i) {
      const float velocity = size(axis.move(0));
      if (i > 50) CHECK_LE(velocity, 1e-3f);
    }
  }
}

TEST(Tracking_Reversal_IsSeenWithinTwoCounts) {
  Axis axis;
  for (int32_t i = 0; i < 500; ++i) (void)axis.move(0.4);
  float velocity = 1.0f;
  for (int32_t i = 0; i < 8; ++i) velocity = axis.move(-0.4);  // 3.2 counts
  CHECK_LT(velocity, 0.0f);
}

TEST(LowPass_StepOfTheSpeed_FollowsTheClosedForm) {
  device::VelocityState state;
  const double share = 1e-3 / (1e-3 + 1 / (6.283185307 * 150));
  double left = 1;
  for (int32_t i = 0; i < 40; ++i) {
    const float velocity =
        device::estimate(state, {Estimator::kLowPass, 150.0f}, 1000.0f, 2.0f, 1e-3f);
    left *= 1 - share;
    CHECK_LE(size(velocity - static_cast<float>(2 * (1 - left))), 1e-6f);
  }
}

TEST(Difference_IsStepsOverTime) {
  device::VelocityState state;
  CHECK_EQ(device::estimate(state, {Estimator::kDifference, 1.0f}, 1000.0f, 3.0f, 0.5f), 0.006f);
  CHECK_EQ(device::estimate(state, {Estimator::kDifference, 1.0f}, -1000.0f, 3.0f, 0.5f), -0.006f);
}

TEST(EveryStepAndEveryTime_GivesAFiniteVelocity) {
  constexpr float kSteps[] = {0.0f, 1.0f, -1.0f, 1000.0f, 2147483647.0f, -2147483648.0f};
  constexpr float kTimes_s[] = {1e-6f, 1e-4f, 1e-3f, 1.0f};
  uint32_t random = 1;
  for (const Estimator kind : kAll) {
    constexpr float kPerUnit[] = {100.0f, -100.0f, 1e8f};
    for (const float per_unit : kPerUnit) {
      device::VelocityState state;
      for (int32_t i = 0; i < 20000; ++i) {
        random = random * 1664525u + 1013904223u;
        const float velocity =
            device::estimate(state, {kind, 10000.0f}, per_unit, kSteps[(random >> 16) % 6],
                             kTimes_s[(random >> 24) % 4]);
        CHECK(is_finite(velocity));
      }
      device::stop(state);
      CHECK_EQ(state.units_per_s, 0.0f);
    }
  }
}
