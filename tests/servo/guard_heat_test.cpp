// The guard's heat of windings against the exact solution for torques that are held, in double.
#include <stdint.h>

#include "firmtouch/servo/guard.hpp"
#include "harness/test.hpp"
#include "servo/specials.hpp"

namespace servo = firmtouch::servo;
namespace math = firmtouch::math;
namespace test = firmtouch::test;

namespace {

constexpr double kMaxHeat = 17. / 16;
constexpr float kContinuous_Nm = 0.1f, kTime_s = 5, kTick_s = 1e-3f;

// exp(-a), 0 <= a < 0.1
double decay(double a) { return 1 - a * (1 - a / 2 * (1 - a / 3 * (1 - a / 4))); }

struct Motors {
  servo::GuardState state;
  servo::HeatGuard heat;
  float motor_Nm[3] = {};
  double load = 0, x = 1, fall;  // of the first motor, in units of its continuous torque; exact

  explicit Motors(float continuous_Nm = kContinuous_Nm, float time_s = kTime_s,
                  float tick_s = kTick_s)
      : fall(decay(static_cast<double>(tick_s) / static_cast<double>(time_s))),
        continuous_Nm_(continuous_Nm) {
    CHECK(servo::guard_set_limits(state, {8, 5000, tick_s}));
    servo::set_heat(heat, {continuous_Nm, continuous_Nm / 2, 0}, {time_s, time_s * 2, 0});
  }
  bool pass(float load_of_first, float second_Nm = 0, float third_Nm = 0) {
    motor_Nm[0] = load_of_first * continuous_Nm_;
    motor_Nm[1] = second_Nm, motor_Nm[2] = third_Nm;
    const double square = test::square(load_of_first);
    after = square + (x - square) * fall;
    const bool passed = servo::guard_heat(state, heat, motor_Nm);
    if (passed) x = after;
    return passed;
  }
  bool is_zero() const {
    return math::bits_of(motor_Nm[0]) == 0 && math::bits_of(motor_Nm[1]) == 0 &&
           math::bits_of(motor_Nm[2]) == 0;
  }
  double after = 1;  // x at the end of the tick, if its torque passes

 private:
  float continuous_Nm_;
};

void check_trips(Motors& motors) {
  CHECK(motors.is_zero());
  CHECK(motors.state.armed != servo::kGuardArmed);
  CHECK_EQ(motors.state.passed[0], 0);
  float motor_N[3] = {0.1f, 0, 0};
  CHECK(!servo::guard(motors.state, true, false, motor_N));
}

}  // namespace

TEST(GuardOfHeat_ConstantTorque_IsStoppedWhereItsClosedFormSays) {
  constexpr float kTimes_s[] = {0.7f, 5, 100}, kLoads[] = {1.04f, 1.2f, 2, -2.6f};
  for (const float time_s : kTimes_s) {
    for (const float load : kLoads) {
      Motors motors(kContinuous_Nm, time_s);
      uint32_t ticks = 0;
      while (ticks < 1000000 && motors.pass(load)) ++ticks;
      CHECK_LE(motors.x, kMaxHeat * 1.002);
      CHECK_LE(kMaxHeat * 0.998, motors.after);
      check_trips(motors);
    }
  }
}

TEST(GuardOfHeat_TheContinuousTorque_PassesForEver) {
  Motors motors;
  for (uint32_t tick = 0; tick < 100000; ++tick) CHECK(motors.pass(1, 0.5f * kContinuous_Nm, 700));
}

TEST(GuardOfHeat_EachMotorHasItsOwn) {
  Motors motors;
  uint32_t ticks = 0;
  while (ticks < 100000 && motors.pass(1, -2 * kContinuous_Nm)) ++ticks;
  double x = 1;  // of four times its continuous torque
  for (uint32_t tick = 0; tick < ticks; ++tick)
    x = 16 + (x - 16) * decay(static_cast<double>(kTick_s) / static_cast<double>(2 * kTime_s));
  CHECK_LE(x, kMaxHeat * 1.002);
  CHECK_LE(kMaxHeat * 0.998,
           x + 16 * static_cast<double>(kTick_s) / static_cast<double>(2 * kTime_s));
  check_trips(motors);
}

TEST(GuardOfHeat_RandomTorques_AreStoppedAsTheModelInDoubleSays) {
  test::Random random;
  constexpr float kTicks_s[] = {1e-4f, 1e-3f, 5e-3f};
  for (const float tick_s : kTicks_s) {
    Motors motors(0.0037f, 2.5f, tick_s);
    float load = 0;
    uint32_t stopped = 0;
    for (uint32_t tick = 0; tick < 30000; ++tick) {
      if (random.next() % 64 == 0) load = 2 * random.unit();
      if (motors.pass(load)) {
        CHECK_LE(motors.x, kMaxHeat * 1.004);
        continue;
      }
      CHECK_LE(kMaxHeat * 0.996, motors.after);
      check_trips(motors);
      servo::guard_clear(motors.state);
      load = 0;
      ++stopped;
    }
    CHECK_LE(3u, stopped);
  }
}

// A thermal time of 8,000 s in ticks of 0.1 ms: 20 s of no torque, then of 20 times the continuous
// one.
TEST(GuardOfHeat_SlowHeat_IsNotLostInRoundings) {
  Motors motors(kContinuous_Nm, 8e3f, 1e-4f);
  for (uint32_t tick = 0; tick < 200000; ++tick) CHECK(motors.pass(0));
  uint32_t ticks = 0;
  while (ticks < 100000 && motors.pass(20)) ++ticks;
  CHECK_LE(motors.x, kMaxHeat * 1.002);
  CHECK_LE(kMaxHeat * 0.998, motors.after);
}

// A backward step's share of the difference is a / (1 + a): a slower heat than the device's is
// never above the largest that the device counts.
TEST(GuardOfHeat_LongTicks_HeatNoFasterThanABackwardStep) {
  constexpr float kTicks_s[] = {1e-3f, 0.01f, 0.025f, 0.05f, 0.1f};
  for (const float tick_s : kTicks_s) {
    Motors motors(kContinuous_Nm, 0.125f, tick_s);
    const double hot = static_cast<double>(motors.heat.value.heat[0]);
    for (uint32_t tick = 0; tick < 10000; ++tick) CHECK(motors.pass(0));
    const double cold = static_cast<double>(motors.heat.value.heat[0]) / hot;
    CHECK_LE(cold, 1e-4);
    CHECK(motors.pass(1));
    const double share = static_cast<double>(motors.heat.value.heat[0]) / hot - cold;
    const double a = static_cast<double>(tick_s) / 0.125;
    CHECK_LE(share, a / (1 + a));
    if (tick_s < 0.03f) CHECK_LE(a * (1 - a) * 0.998, share);
  }
}

TEST(GuardOfHeat_NoticesEveryFlippedBit) {
  for (uint32_t bit = 0; bit < 8 * sizeof(servo::HeatGuard); ++bit) {
    Motors motors;
    CHECK(motors.pass(0.5f));
    reinterpret_cast<uint8_t*>(&motors.heat)[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    CHECK(!motors.pass(0));
    check_trips(motors);
    servo::guard_clear(motors.state);
    CHECK(!motors.pass(0.5f));
    check_trips(motors);
  }
}

TEST(GuardOfHeat_WithoutSaneLimits_PassesNone) {
  const float all[] = {math::float_of(0x7FC00000u),
                       math::float_of(0xFFC00000u),
                       math::float_of(0x7F800000u),
                       -0.1f,
                       -0.0f,
                       3e38f,
                       1001.0f,
                       1e-40f};
  for (const float bad : all) {
    Motors torque;
    servo::set_heat(torque.heat, {kContinuous_Nm, bad, 0}, {kTime_s, kTime_s, 0});
    CHECK(!torque.pass(0, 1e-3f));
    check_trips(torque);
    Motors time;
    servo::set_heat(time.heat, {kContinuous_Nm, kContinuous_Nm, 0}, {kTime_s, bad, 0});
    CHECK_EQ(time.pass(0, 1e-3f), bad > 1000 && bad < 2000);
  }
  Motors none;
  none.heat = {};
  CHECK(!none.pass(1e-3f));
  check_trips(none);
  for (const uint32_t bits : test::kSpecialBits) {
    Motors motors;
    motors.motor_Nm[0] = math::float_of(bits);
    const bool is_small = test::square(motors.motor_Nm[0]) < 4;
    CHECK_EQ(servo::guard_heat(motors.state, motors.heat, motors.motor_Nm),
             is_small && test::is_number(motors.motor_Nm[0]));
  }
}

// Any bits: what may be is never exceeded, so that no product overflows.
TEST(GuardOfHeat_AnyLimitsAndTorques_KeepItsHeatInRange) {
  test::Random random;
  for (uint32_t run = 0; run < 20000; ++run) {
    Motors motors;
    const float period_s = math::float_of(random.next() >> 1);
    CHECK(servo::guard_set_limits(motors.state, {8, 5000, run % 2 == 0 ? 0.1f : period_s}));
    const float continuous_Nm = math::float_of((random.next() & 0x07FFFFFFu) + 0x3C000000u);
    const float time_s = math::float_of((random.next() & 0x0FFFFFFFu) + 0x3D000000u);
    servo::set_heat(motors.heat, {continuous_Nm, kContinuous_Nm, 0}, {time_s, kTime_s, 0});
    for (uint32_t tick = 0; tick < 20; ++tick) {
      motors.motor_Nm[0] =
          tick % 3 == 0 ? math::float_of(random.next()) : 3 * continuous_Nm * random.unit();
      motors.motor_Nm[1] = motors.motor_Nm[2] = 0;
      servo::guard_heat(motors.state, motors.heat, motors.motor_Nm);
      CHECK_LE(motors.heat.value.heat[0], (uint64_t{17} << 48) + (uint64_t{1} << 29));
    }
  }
}
