// The last guard before the motors, on its own.
#include "firmtouch/servo/guard.hpp"

#include <stdint.h>

#include "harness/test.hpp"
#include "servo/specials.hpp"

namespace servo = firmtouch::servo;
namespace math = firmtouch::math;
namespace test = firmtouch::test;

namespace {

const servo::GuardLimits kLimits{8.0f, 5000.0f, 0.001f};

struct GuardRig {
  servo::GuardState state;
  GuardRig() { CHECK(servo::guard_set_limits(state, kLimits)); }
  float motor_N[3] = {};
  bool pass(float x, float y, float z, bool may_push = true, bool cut = false) {
    motor_N[0] = x, motor_N[1] = y, motor_N[2] = z;
    return servo::guard(state, may_push, cut, motor_N);
  }
  bool is_zero() const {
    return math::bits_of(motor_N[0]) == 0 && math::bits_of(motor_N[1]) == 0 &&
           math::bits_of(motor_N[2]) == 0;
  }
};

void check_stops(servo::GuardState& state, float force_N) {
  float motor_N[3] = {force_N, 0, 0};
  CHECK(!servo::guard(state, true, false, motor_N));
  CHECK_EQ(motor_N[0], 0.0f);
}

}  // namespace

TEST(GuardLetsGoodForcesPassUnchanged) {
  GuardRig rig;
  CHECK(rig.pass(1.5f, -2.25f, 0.1f));
  CHECK_EQ(rig.motor_N[0], 1.5f);
  CHECK_EQ(rig.motor_N[1], -2.25f);
  CHECK_EQ(rig.motor_N[2], 0.1f);
  CHECK(rig.pass(4.6f, -4.6f, 4.5f));
  CHECK(rig.pass(-4.6f, 4.6f, -4.5f));  // each axis through zero: 4.6 N of growth
  CHECK(rig.pass(0, 0, 0));
}

TEST(GuardStopsAForceAboveItsLimit) {
  GuardRig rig;
  CHECK(rig.pass(4.7f, 0, 0));
  CHECK(rig.pass(8.0f, 0, 0));
  CHECK(!rig.pass(8.001f, 0, 0));
  CHECK(rig.is_zero());
  GuardRig diagonal;
  CHECK(diagonal.pass(4.61f, 4.61f, 4.61f));
  CHECK(!diagonal.pass(4.63f, 4.63f, 4.63f));
}

TEST(GuardStopsAForceThatGrowsTooFast) {
  GuardRig rig;
  CHECK(rig.pass(5.0f, 0, 0));
  GuardRig fast;
  CHECK(!fast.pass(5.01f, 0, 0));
  CHECK(fast.is_zero());
  GuardRig turned;
  CHECK(turned.pass(4.0f, 0, 0));
  CHECK(!turned.pass(-5.01f, 0, 0));
  GuardRig down;
  CHECK(down.pass(5.0f, 0, 0));
  CHECK(down.pass(0.01f, 0, 0));  // towards zero as fast as you like
}

TEST(Guard_StopsNaNAndInfinity) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const uint32_t bits : test::kSpecialBits) {
      GuardRig rig;
      float motor_N[3] = {};
      motor_N[axis] = math::float_of(bits);
      const bool small =
          !(motor_N[axis] > 5.0f) && !(motor_N[axis] < -5.0f) && test::is_number(motor_N[axis]);
      const bool passed = servo::guard(rig.state, true, false, motor_N);
      CHECK_EQ(passed, small);
      CHECK(passed || math::bits_of(motor_N[axis]) == 0);
    }
  }
}

TEST(Guard_StopsWithNaNLimits) {
  const uint32_t bad[] = {0x7FC00000u, 0x7F800000u, 0xFF800000u,
                          0xBF800000u, 0x7F7FFFFFu, 0xFFC00001u};
  for (int field = 0; field < 3; ++field) {
    for (const uint32_t bits : bad) {
      servo::GuardLimits limits = kLimits;
      (field == 0   ? limits.force_limit_N
       : field == 1 ? limits.slew_limit_N_per_s
                    : limits.tick_period_s) = math::float_of(bits);
      servo::GuardState state;
      CHECK(servo::guard_set_limits(state, limits));
      check_stops(state, 1);
    }
  }
}

TEST(GuardStaysTrippedUntilItIsCleared) {
  GuardRig rig;
  CHECK(!rig.pass(100, 0, 0));
  for (int i = 0; i < 5; ++i) {
    CHECK(!rig.pass(0.1f, 0, 0));
    CHECK(rig.is_zero());
  }
  servo::guard_clear(rig.state);
  CHECK(rig.pass(0.1f, 0, 0));
}

TEST(GuardAllowsARampOutAndNoMore) {
  GuardRig rig;
  CHECK(rig.pass(4.0f, 0, 0));
  int ticks = 0;
  while (rig.pass(1.0f, 0, 0, false)) ++ticks;
  CHECK_EQ(ticks, 11);  // 10 ms
  GuardRig quiet;
  CHECK(quiet.pass(4.0f, 0, 0));
  for (int i = 0; i < 1000; ++i) CHECK(quiet.pass(0, 0, 0, false));
  CHECK(!quiet.pass(0.001f, 0, 0, false));
}

TEST(GuardCutsAtOnceWhereItMust) {
  GuardRig rig;
  CHECK(rig.pass(1, 0, 0));
  CHECK(rig.pass(0, 0, 0, true, true));
  CHECK(!rig.pass(0.5f, 0, 0, true, true));
  CHECK(rig.is_zero());
}

TEST(Guard_AnyLimits_KeepsItsCeilings) {
  const servo::GuardLimits beyond[] = {
      {128.0f, 5000.0f, 0.001f}, {8.0f, 2e6f, 0.001f}, {8.0f, 5000.0f, 0.11f}};
  for (const servo::GuardLimits& limits : beyond) {
    GuardRig rig;
    CHECK(servo::guard_set_limits(rig.state, limits));
    CHECK(rig.pass(0, 0, 0));
    CHECK(!rig.pass(0.5f, 0, 0));
    CHECK(rig.is_zero());
  }
  GuardRig most;
  CHECK(servo::guard_set_limits(most.state, {servo::kGuardMaxForce_N, servo::kGuardMaxSlew_N_per_s,
                                             servo::kGuardMaxPeriod_s}));
  CHECK(most.pass(99.9f, 0, 0));
  CHECK(!most.pass(100.1f, 0, 0));
}

TEST(GuardWithoutLimitsLetsNoForcePass) {
  servo::GuardState state;
  check_stops(state, 0.01f);
}

TEST(GuardKeepsItsLimitsThroughAClear) {
  GuardRig rig;
  CHECK(!rig.pass(100, 0, 0));
  servo::guard_clear(rig.state);
  const servo::GuardLimits limits = servo::guard_limits(rig.state);
  CHECK_EQ(limits.force_limit_N, kLimits.force_limit_N);
  CHECK_EQ(limits.slew_limit_N_per_s, kLimits.slew_limit_N_per_s);
  CHECK_EQ(limits.tick_period_s, kLimits.tick_period_s);
}

TEST(Guard_DamagedLimits_AreNotRepairedByClearOrNewLimits) {
  for (uint32_t bit = 0; bit < 64 * 3; ++bit) {
    GuardRig rig;
    uint32_t* words = bit < 96 ? rig.state.limit : rig.state.limit_complement;
    words[bit % 96 / 32] ^= 1u << (bit % 32);
    CHECK(!rig.pass(0, 0, 0));
    servo::guard_clear(rig.state);
    CHECK(!rig.pass(0, 0, 0));
    servo::guard_clear(rig.state);
    CHECK(!servo::guard_set_limits(rig.state, kLimits));
    CHECK(!rig.pass(0.1f, 0, 0));
    CHECK(rig.is_zero());
  }
}

TEST(GuardNoticesEveryFlippedBitOfItsMemoryThatMatters) {
  for (uint32_t bit = 0; bit < 32 + 64 * 3; ++bit) {
    GuardRig rig;
    CHECK(rig.pass(1, 1, 1));
    uint32_t* word = bit < 32 ? &rig.state.armed
                     : bit < 128
                         ? reinterpret_cast<uint32_t*>(&rig.state.passed[(bit - 32) / 32])
                         : reinterpret_cast<uint32_t*>(&rig.state.complement[(bit - 128) / 32]);
    *word ^= 1u << (bit % 32);
    CHECK(!rig.pass(1, 1, 1));
    CHECK(rig.is_zero());
  }
}

namespace {

struct TorqueRig : GuardRig {
  servo::TorqueCeilings ceilings;
  // 0.01 N m a tick.
  TorqueRig() { servo::set_ceilings(ceilings, {0.2f, 0.3f, 0.0f}, 0.02f); }
  bool turn(float first, float second, float third, bool may_push = true) {
    motor_N[0] = first, motor_N[1] = second, motor_N[2] = third;
    return servo::guard_torques(state, ceilings, may_push, false, motor_N);
  }
  void rise_to(float first_Nm) {
    for (float torque_Nm = 0; torque_Nm < first_Nm; torque_Nm += 0.009f)
      CHECK(turn(torque_Nm, 0, 0));
  }
};

}  // namespace

TEST(GuardOfTorques_HoldsEachJointsCeilingAndRise) {
  TorqueRig rig;
  CHECK(rig.turn(0.01f, -0.015f, 0));
  CHECK_EQ(rig.motor_N[1], -0.015f);
  CHECK(rig.turn(-0.01f, 0.015f, 0));  // through 0
  CHECK(!rig.turn(-0.0205f, 0.015f, 0));
  CHECK(rig.is_zero());
  TorqueRig high;
  high.rise_to(0.2f);
  CHECK(high.turn(0.2f, 0, 0));
  CHECK(!high.turn(0.2001f, 0, 0));
  CHECK(!TorqueRig().turn(0, 0, 0.001f));  // a joint that the linkage does not have
  TorqueRig quiet;
  quiet.rise_to(0.1f);
  for (uint32_t tick = 0; tick < 10; ++tick) CHECK(quiet.turn(0.05f, 0, 0, false));
  CHECK(quiet.turn(0.05f, 0, 0, false));
  CHECK(!quiet.turn(0.05f, 0, 0, false));
}

TEST(GuardOfTorques_NoticesEveryFlippedBitOfACeiling) {
  for (uint32_t bit = 0; bit < 8 * 32; ++bit) {
    TorqueRig rig;
    CHECK(rig.turn(0.001f, 0.001f, 0));
    uint32_t* words = bit < 128 ? rig.ceilings.word : rig.ceilings.complement;
    words[bit / 32 % 4] ^= 1u << (bit % 32);
    CHECK(!rig.turn(0.001f, 0.001f, 0));
    CHECK(rig.is_zero());
  }
}

TEST(GuardOfTorques_WithoutSaneCeilings_PassesNone) {
  const float all[] = {math::float_of(0x7FC00000u), -1.0f, 1001.0f, 3e38f};
  for (const float bad : all) {
    TorqueRig rig;
    servo::set_ceilings(rig.ceilings, {0.2f, bad, 0.2f}, 0.02f);
    CHECK(!rig.turn(0.001f, 0, 0));
    servo::set_ceilings(rig.ceilings, {0.2f, 0.2f, 0.2f}, bad);
    TorqueRig other;
    other.ceilings = rig.ceilings;
    CHECK(!other.turn(0.001f, 0, 0));
  }
  GuardRig none;
  float motor_Nm[3] = {0.001f, 0, 0};
  CHECK(!servo::guard_torques(none.state, {}, true, false, motor_Nm));
  TorqueRig wrong;
  CHECK(!wrong.turn(all[0], 0, 0));
}

// As where a fault is cleared while a linkage still lets its weight go.
TEST(GuardClear_WhileTorquesFall_DoesNotForgetThem) {
  TorqueRig rig;
  rig.rise_to(0.08f);
  CHECK(rig.turn(0.06f, 0, 0, false));
  servo::guard_clear(rig.state);
  CHECK(rig.turn(0.04f, 0, 0, false));
  CHECK(!rig.turn(0.06f, 0, 0, false));
  servo::guard_clear(rig.state);
  CHECK(!rig.turn(0.06f, 0, 0));
}
