// How a contact feels, against closed forms.
#include <cmath>
#include <initializer_list>

#include "harness/test.hpp"
#include "host_sim/report/contact_quality.hpp"

namespace host_sim = firmtouch::host_sim;
using host_sim::ContactQuality;
using host_sim::Vec;

namespace {

constexpr double kRate_Hz = 1000, kLimit_N = 8, kPi = 3.14159265358979323846;

// One second of a force of 2 N along z with a sine of `amplitude_N` on it.
ContactQuality after_sine(double frequency_Hz, double amplitude_N, bool motors_are_on = true) {
  ContactQuality meter(kRate_Hz, kLimit_N);
  for (int i = 0; i < 1000; ++i)
    meter.add({0, 0, 2 + amplitude_N * std::sin(2 * kPi * frequency_Hz * i / kRate_Hz)},
              motors_are_on);
  return meter;
}

}  // namespace

TEST(Chatter_FastSine_IsItsRootMeanSquare) {
  const ContactQuality meter = after_sine(200, 1);
  CHECK_LT(std::fabs(meter.chatter_N() - std::sqrt(0.5)), 0.02);
  CHECK_LT(0.9, meter.chatter_s());
}

// A Butterworth filter of second order passes 1 / sqrt(1 + (50 / f)^4).
TEST(Chatter_SlowSine_IsOfTheHand) {
  CHECK_LT(after_sine(5, 1).chatter_N(), 0.02);
  CHECK(!(after_sine(5, 1).chatter_s() > 0));
  CHECK_LT(std::fabs(after_sine(50, 1).chatter_N() - 0.5), 0.05);
}

TEST(Chatter_MotorsOff_IsZero) { CHECK(!(after_sine(200, 4, false).chatter_N() > 0)); }

// The trial that every card called good: a force between 0 and 8 N for 4 s.
TEST(Chatter_LimitCycleOfHalfTheRate_IsLong) {
  ContactQuality meter(kRate_Hz, kLimit_N);
  for (int i = 0; i < 4000; ++i) meter.add({0, 0, i % 8 < 4 ? 8.0 : 0.0}, true);
  CHECK_LT(3.5, meter.chatter_N());
  CHECK_LT(3.8, meter.chatter_s());
}

TEST(Turn_IsTheLargestAngleBetweenTwoTicks) {
  ContactQuality meter(kRate_Hz, kLimit_N);
  for (const double angle_rad : {0.0, 0.1, 0.35, 0.4}) {
    const Vec force_N{std::cos(angle_rad), 0, std::sin(angle_rad)};
    meter.add(force_N, true);
  }
  CHECK_LT(std::fabs(meter.turn_rad() - 0.25), 1e-9);
}

// Next to nothing has no direction: 5 % of the limit.
TEST(Turn_OfAFaintForce_IsLeftOut) {
  ContactQuality meter(kRate_Hz, kLimit_N);
  meter.add({0.3, 0, 0}, true);
  meter.add({0, 0.3, 0}, true);
  CHECK(!(meter.turn_rad() > 0));
}
