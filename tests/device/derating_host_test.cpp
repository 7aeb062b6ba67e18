// Thermal limits: each word as it is stored is broken alone; heat and limit against the same model
// in double, and against closed forms.
#include "firmtouch/device/derating.hpp"

#include <cfloat>
#include <cmath>

#include "device/opened_part.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

constexpr double kLargest_Nm = 0.3, kContinuous_Nm = 0.1, kTime_s = 5;
constexpr float kTick_s = 1e-3f;

using Stored = device_test::StoredWith<device::DeratingLayout>;
using StoredHomed = device_test::StoredWith<device::DeratingLayout, device::HomedLinkageLayout>;

// Of its two motors the second has no thermal limit.
Stored bar() {
  Stored to = {};
  to.before = device_test::stored_bar(2200);
  to.part.continuous_Nm[0] = static_cast<float>(kContinuous_Nm);
  to.part.time_s[0] = static_cast<float>(kTime_s);
  return to;
}

template <class Section = Stored>
using Opened = device_test::OpenedPart<device::Derating, Section>;

void check_broken(uint32_t joint, float continuous_Nm, float time_s, uint32_t element) {
  Stored stored = bar();
  stored.part.continuous_Nm[joint] = continuous_Nm;
  stored.part.time_s[joint] = time_s;
  device_test::check_broken<device::Derating>(stored, device::kRuleDerating, element);
}

// A motor that gets what it wants, within the limit.
struct Motor {
  Opened<> opened;
  device::HeatState state;
  float most_Nm[device::kMaxJoints] = {};
  float torque_Nm[device::kMaxJoints] = {};

  explicit Motor(const Stored& stored = bar()) : opened(stored) {}
  double heat() const { return double{state.heat[0]}; }
  double limit_Nm() const { return double{most_Nm[0]}; }
  void step(double wanted_Nm, float dt_s = kTick_s) {
    device::heat(state, opened.part, opened.linkage, torque_Nm, dt_s, most_Nm);
    const double size = std::fmin(std::fabs(wanted_Nm), limit_Nm());
    torque_Nm[0] = static_cast<float>(wanted_Nm < 0 ? -size : size);
  }
  // Result: seconds.
  template <class Until>
  double run(double wanted_Nm, Until until) {
    for (uint32_t ticks = 0; ticks < 1000000; ++ticks) {
      step(wanted_Nm);
      if (until()) return ticks * double{kTick_s};
    }
    return HUGE_VAL;
  }
};

// The law in double: limit at a heat, both in units of the continuous torque.
double law(double x, double largest) {
  return 1 + (largest - 1) * std::fmin(std::fmax(4 * (1 - x), 0), 1);
}

}  // namespace

TEST(Derating_EachWordIsBrokenAlone) {
  CHECK(Opened<>(bar()).verdict.ok());
  const float nan = test::nan_value();
  check_broken(0, 0, 5, 0);
  check_broken(0, -0.1f, 5, 0);
  check_broken(0, -0.0f, 0, 0);
  check_broken(0, nan, 5, 0);
  check_broken(0, .30001f, 5, 0);
  check_broken(2, .1f, 5, 2);  // no such joint
  check_broken(1, .1f, 0, 4);
  check_broken(1, .1f, .899f, 4);
  check_broken(0, .03f, 9.99f, 3);
  check_broken(0, .1f, 10001, 3);
  check_broken(0, .1f, nan, 3);
  check_broken(0, 0, 0, 6);
}

TEST(Derating_HomingHasItsTorque) {
  StoredHomed stored = {};
  stored.before.linkage = bar().before;
  stored.part = bar().part;
  stored.before.homing.torque_Nm[0] = static_cast<float>(kContinuous_Nm);
  CHECK(Opened<StoredHomed>(stored).verdict.ok());
  stored.before.homing.torque_Nm[0] = .1001f;
  device_test::check_broken<device::Derating>(stored, device::kRuleDerating, 0);
}

// Linkage alone, with second encoders, homed, and this with either kind of encoders.
TEST(Derating_EveryLengthIsOfOneCompositionOnly) {
  constexpr uint32_t kLengths[] = {160, 176, 196, 212, 224};
  alignas(4) const uint8_t bytes[256] = {};
  for (uint32_t size = 0; size <= sizeof bytes; ++size) {
    uint32_t before = size;
    for (const uint32_t length : kLengths)
      if (size == length + 24) before = length;
    CHECK_EQ(device::Derating::before({bytes, size}).size(), before);
  }
}

TEST(Derating_ASectionWithoutIt_IsPassedAndNotDerated) {
  Stored stored = bar();
  const core::Bytes alone(reinterpret_cast<const uint8_t*>(&stored), sizeof stored.before);
  device::StoredLinkage linkage;
  device::Derating derating;
  CHECK_EQ(open(alone, linkage).rule, 0u);
  CHECK_EQ(derating.open(alone, linkage).rule, 0u);
  CHECK(!derating.is_open());
}

// x falls from 1 as exp(-t / T): the limit is whole again after T ln(4 / 3).
TEST(Derating_AfterAResetItIsHot_AndCoolsInClosedForm) {
  Motor motor;
  motor.step(0);
  CHECK_LE(std::fabs(motor.limit_Nm() - kContinuous_Nm), .02 * kContinuous_Nm);
  const double cool_s = motor.run(0, [&] { return motor.limit_Nm() >= kLargest_Nm * .999999; });
  CHECK_LE(std::fabs(cool_s - kTime_s * std::log(4. / 3)), 3 * double{kTick_s});
  const double more_s = motor.run(0, [&] { return motor.heat() <= .01; });
  CHECK_LE(std::fabs(more_s + cool_s - kTime_s * std::log(100.)), 4 * double{kTick_s});
}

// From cold a constant torque t is whole until x = 1 - (t - c) / (m - c) / 4, after
// T ln(t^2 / (t^2 - c^2 x)); T ln(t^2 / (t^2 - c^2)) is when a limit without fade would drop.
TEST(Derating_ConstantTorque_IsWholeForTheTimeOfItsClosedForm) {
  constexpr double kTorques_Nm[] = {.3, .25, .15, .11};
  for (const double torque_Nm : kTorques_Nm) {
    Motor motor;
    motor.run(0, [&] { return motor.heat() < 1e-7; });
    const double whole_s = motor.run(torque_Nm, [&] { return motor.limit_Nm() < torque_Nm; });
    const double at = 1 - (torque_Nm - kContinuous_Nm) / (kLargest_Nm - kContinuous_Nm) / 4;
    const double ratio = torque_Nm / kContinuous_Nm;
    const double closed_s = kTime_s * std::log(ratio * ratio / (ratio * ratio - at));
    CHECK_LE(std::fabs(whole_s - closed_s), 3e-4 * closed_s + 2 * double{kTick_s});
    CHECK_LE(whole_s, kTime_s * std::log(ratio * ratio / (ratio * ratio - 1)) + 2e-3);
    double most = 0, last_Nm = motor.limit_Nm(), step_Nm = 0;
    motor.run(torque_Nm, [&] {
      most = std::fmax(most, motor.heat());
      step_Nm = std::fmax(step_Nm, std::fabs(motor.limit_Nm() - last_Nm));
      last_Nm = motor.limit_Nm();
      return motor.limit_Nm() < kContinuous_Nm * 1.00001;
    });
    CHECK_LE(most, 1 + 4e-7);
    CHECK_LE(step_Nm, (kLargest_Nm - kContinuous_Nm) * double{kTick_s} / .025);
  }
}

TEST(Derating_TheContinuousTorque_IsNeverDerated) {
  Motor motor;
  for (int tick = 0; tick < 60000; ++tick) {
    motor.step(kContinuous_Nm);
    CHECK_LE(static_cast<double>(static_cast<float>(kContinuous_Nm)), motor.limit_Nm());
  }
  CHECK_LE(double{motor.most_Nm[1]}, kLargest_Nm + 1e-7);  // no thermal limit
  CHECK_GE(double{motor.most_Nm[1]}, kLargest_Nm - 1e-7);
}

// The exact solution of a tick in which the torque is held, in double.
TEST(Derating_ARandomDemand_FollowsTheModelInDouble) {
  test::Lcg random(11);
  Motor motor;
  double x = 1, held = 0, wanted_Nm = 0;
  const double largest = kLargest_Nm / kContinuous_Nm;
  for (int tick = 0; tick < 200000; ++tick) {
    if (tick % 500 == 0)
      wanted_Nm = double{random.between(-1, 1)} * (tick / 20000 % 2 == 0 ? .5 : .15);
    motor.step(wanted_Nm);
    x = held * held + (x - held * held) * std::exp(-double{kTick_s} / kTime_s);
    held = std::fmin(std::fabs(wanted_Nm) / kContinuous_Nm, law(x, largest));
    CHECK_LE(std::fabs(motor.heat() - x), 1e-3);
    CHECK_LE(std::fabs(motor.limit_Nm() - law(x, largest) * kContinuous_Nm), 1e-3);
  }
}

// The worst that the rule admits: a tenth of the largest torque, its shortest time, 25 ms; and the
// longest time, whose ticks change no digit of a float. Torques alternate, or use each limit whole.
TEST(Derating_NoDemandHeatsBeyondTheContinuousTorque) {
  test::Lcg random(12);
  for (int setting = 0; setting < 3; ++setting) {
    Stored stored = bar();
    stored.part.continuous_Nm[0] = setting == 1 ? .25f : .03f;
    stored.part.time_s[0] = setting == 1 ? .15f : setting == 0 ? 10.001f : 1e4f;
    Motor motor(stored);
    double most = 0;
    for (int tick = 0; tick < 300000; ++tick) {
      const bool pushes = tick % 7000 > 2000;
      motor.step(pushes ? (tick % 2 == 0 ? 1 : -1) : 0, setting == 2 ? 1e-4f
                                                        : double{random.between(0, 1)} < .5
                                                            ? .025f
                                                            : 5e-4f);
      most = std::fmax(most, motor.heat());
      CHECK_LE(std::fabs(double{motor.torque_Nm[0]}), kLargest_Nm + 1e-7);
    }
    CHECK_LE(most, 1 + 4e-7);
  }
}

// 10,000 s in ticks of 0.1 ms: a float alone stands still where a tick changes none of its digits.
TEST(Derating_SlowHeat_IsNotLostInRoundings) {
  Stored stored = bar();
  stored.part.time_s[0] = 1e4f;
  Motor motor(stored);
  constexpr int kTicks = 20000000;
  for (int tick = 0; tick < kTicks; ++tick) motor.step(.05, 1e-4f);
  const double ended = .25 + .75 * std::exp(-kTicks * double{1e-4f} / 1e4);
  CHECK_LE(std::fabs(motor.heat() - ended), 1e-5);
}

TEST(Derating_AfterALongStep_TheLimitIsTheContinuousTorque) {
  Motor motor;
  motor.run(0, [&] { return motor.heat() < .01; });
  const float kSteps_s[] = {1.0f, 1e9f, FLT_MAX, test::nan_value(), -1.0f, 0.0f};
  for (const float dt_s : kSteps_s) {
    motor.torque_Nm[0] = static_cast<float>(kLargest_Nm);
    motor.step(0, dt_s);
    CHECK(std::isfinite(motor.state.heat[0]) && motor.heat() <= 9 && motor.heat() >= 0);
    CHECK_GE(motor.limit_Nm(), kContinuous_Nm * .9999999);
    if (motor.heat() > 1) CHECK_LE(motor.limit_Nm(), kContinuous_Nm * 1.0000001);
  }
  CHECK_GE(motor.heat(), 1.0);
}
