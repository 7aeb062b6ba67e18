// Homing on one joint of numbers: a mass between two springs. host_sim.Homing attacks it on
// machines.
#include "firmtouch/device/homing.hpp"

#include "harness/float_bits.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::HomeBy;
using device::HomingFault;

namespace {

constexpr float kCounts = 2000;  // per rad

device::JointSettings one_joint() {
  device::JointSettings joints;
  joints.joints = 1;
  joints.joint[0] = {kCounts, 0.25f, -0.5f, 0.7f};
  return joints;
}

device::HomingSettings settings(HomeBy by) {
  device::HomingSettings to;
  to.by = by;
  to.torque_Nm[0] = 0.1f;
  to.index_rad[0] = 0.31f;
  to.index_period_rad[0] = 0.5f;
  return to;
}

struct Mass {
  float angle_rad = 0.1f, rate = 0, largest_Nm = 0;
  uint32_t base = 0;  // raw counts at an angle of zero_rad
  float way = 1;      // -1: reversed
  float low_rad = -0.5f, blocked_rad = 9, low_N_m_per_rad = 40, low_N_m_s = 0.1f;
  float high_N_m_per_rad = 40, high_N_m_s = 0.1f;
  bool has_pulse = true;
  uint32_t pulses = 0, ticks = 0;
  int32_t latched = 0;

  int32_t raw_at(float at_rad) const {
    const float counts = way * (at_rad - 0.25f) * kCounts;
    const int32_t down = static_cast<int32_t>(counts + 100000.0f) - 100000;
    return static_cast<int32_t>(static_cast<uint32_t>(down) + base);
  }
  void move(float torque_Nm) {
    largest_Nm = __builtin_fabsf(torque_Nm) > largest_Nm ? __builtin_fabsf(torque_Nm) : largest_Nm;
    for (int i = 0; i < 20; ++i) {
      const float before = angle_rad;
      float stop = 0;
      const float high = blocked_rad < 0.7f ? blocked_rad : 0.7f;
      if (angle_rad < low_rad) stop = low_N_m_per_rad * (low_rad - angle_rad) - low_N_m_s * rate;
      if (angle_rad > high) stop = high_N_m_per_rad * (high - angle_rad) - high_N_m_s * rate;
      rate += (torque_Nm + stop) * (5e-5f / 5e-4f);
      angle_rad += rate * 5e-5f;
      for (float at = -0.19f; has_pulse && at < 1; at += 0.5f) {
        if ((before < at) == (angle_rad < at)) continue;
        pulses = 1;
        latched = raw_at(at);
      }
    }
  }
};

device::HomingState home_it(Mass& mass, const device::HomingSettings& settings) {
  device::HomingState state;
  for (mass.ticks = 0; mass.ticks < 2100 && !state.is_done && state.fault == HomingFault::kNone;
       ++mass.ticks) {
    device::HomingSample sample{{{mass.raw_at(mass.angle_rad), 0, 0}, true, 1e-3f}, mass.pulses};
    sample.latched[0] = mass.latched;
    mass.pulses = 0;
    mass.move(home(state, settings, one_joint(), sample).torque_Nm[0]);
  }
  return state;
}

int32_t off_counts(const Mass& mass, const device::HomingState& state) {
  const int32_t homed = static_cast<int32_t>(static_cast<uint32_t>(mass.raw_at(0.25f)) +
                                             static_cast<uint32_t>(state.offset[0]));
  return homed < 0 ? -homed : homed;
}

}  // namespace

TEST(Homing_ByIndex_IsWithinACount_AcrossTheWrap) {
  const uint32_t bases[] = {0u, 12345u, 0x7fffff00u, 0x80000100u, 0xfffffff0u};
  for (const uint32_t base : bases) {
    Mass mass;
    mass.base = base;
    const device::HomingState state = home_it(mass, settings(HomeBy::kIndex));
    CHECK(state.is_done);
    CHECK_LE(off_counts(mass, state), 1);
    CHECK_LE(mass.largest_Nm, 0.1f);
    CHECK_GE(mass.largest_Nm, 0.05f);
  }
}

TEST(Homing_ByStops_IsInTheMiddle) {
  Mass mass;
  const device::HomingState state = home_it(mass, settings(HomeBy::kStops));
  CHECK(state.is_done);
  CHECK_LE(off_counts(mass, state), 4);
}

TEST(Homing_FaultsAreNamed) {
  Mass reversed, blocked, endless, bare;
  reversed.way = -1;
  blocked.blocked_rad = 0.4f;
  endless.low_rad = -90;
  bare.has_pulse = false;
  CHECK(home_it(reversed, settings(HomeBy::kIndex)).fault == HomingFault::kWrongWay);
  CHECK(home_it(blocked, settings(HomeBy::kIndex)).fault == HomingFault::kBlocked);
  CHECK(home_it(endless, settings(HomeBy::kIndex)).fault == HomingFault::kNoStop);
  CHECK(home_it(bare, settings(HomeBy::kIndex)).fault == HomingFault::kNoIndex);
  device::HomingSettings misplaced = settings(HomeBy::kIndex);
  misplaced.index_rad[0] += 0.25f;
  Mass mass;
  CHECK(home_it(mass, misplaced).fault == HomingFault::kWrongIndex);
  CHECK(mass.ticks <= 2001u);
}

// Pulses behind a cable miss whole periods by what it gives.
TEST(Homing_PulsesOffByMoreThanTheTolerance_AreWrong) {
  const float kWithin_counts[] = {0, 6, 8};
  for (const float within_counts : kWithin_counts) {
    device::HomingSettings tight = settings(HomeBy::kIndex);
    tight.index_period_rad[0] = 0.5035f;  // 7 counts off
    tight.index_within_rad = within_counts / kCounts;
    Mass mass;
    const device::HomingState state = home_it(mass, tight);
    CHECK(state.is_done == (within_counts > 7));
    CHECK(state.is_done || state.fault == HomingFault::kWrongIndex);
  }
}

TEST(Homing_FingerBesideASoftStop_IsBlocked) {
  // The stop gives way by an index period, and the finger stands as far from the other stop.
  Mass mass;
  mass.low_N_m_per_rad = 0.2f;
  mass.low_N_m_s = 0.02f;
  mass.blocked_rad = 0.2f;
  CHECK(home_it(mass, settings(HomeBy::kIndex)).fault == HomingFault::kBlocked);
}

TEST(Homing_SoftStop_IsWithinACount) {
  Mass mass;
  mass.low_N_m_per_rad = 0.2f;
  mass.low_N_m_s = 0.02f;
  const device::HomingState state = home_it(mass, settings(HomeBy::kIndex));
  CHECK(state.is_done);
  CHECK_LE(off_counts(mass, state), 1);
}

TEST(Homing_StopsThatBothGiveWayByFourTenthsOfTheRange_AreStops) {
  Mass mass;
  mass.low_N_m_per_rad = mass.high_N_m_per_rad = 0.19f;
  mass.low_N_m_s = mass.high_N_m_s = 0.005f;
  const device::HomingState state = home_it(mass, settings(HomeBy::kIndex));
  CHECK(state.is_done);
  CHECK_LE(off_counts(mass, state), 1);
}

TEST(Homing_ByAnAbsoluteSensor_NeedsNoMotion_AndRejectsNaN) {
  device::HomingSample sample{{{777, 0, 0}, true, 1e-3f}, 0};
  sample.absolute_rad[0] = 0.35f;
  device::HomingState state;
  const device::HomingTorques out = home(state, settings(HomeBy::kAbsolute), one_joint(), sample);
  CHECK(state.is_done);
  CHECK_EQ(out.torque_Nm[0], 0.0f);
  CHECK_EQ(777 + state.offset[0], 200);
  const float bads_rad[] = {test::nan_value(), 1.0f, -__builtin_inff()};
  for (const float bad : bads_rad) {
    device::HomingState dead;
    sample.absolute_rad[0] = bad;
    (void)home(dead, settings(HomeBy::kAbsolute), one_joint(), sample);
    CHECK(dead.fault == HomingFault::kDeadEncoder);
  }
}

TEST(Homing_BadSamplesAndSettings_GiveNoTorque) {
  device::HomingState state;
  device::HomingSample sample{{{}, false, 1e-3f}, 0};
  for (int i = 0; i < 3; ++i)
    CHECK_EQ(home(state, settings(HomeBy::kStops), one_joint(), sample).torque_Nm[0], 0.0f);
  CHECK(state.fault == HomingFault::kBadSamples);
  device::HomingSettings bad[] = {settings(HomeBy::kStops), settings(HomeBy::kStops),
                                  settings(HomeBy::kIndex), settings(HomeBy::kStops),
                                  settings(HomeBy::kIndex)};
  bad[0].torque_Nm[0] = test::nan_value();
  bad[1].speed_rad_per_s = 0;
  bad[2].index_period_rad[0] = 2;
  bad[3].margin_rad = -1;
  bad[4].margin_rad = 0.51f;  // above the period
  sample.encoders.trusted = true;
  for (const device::HomingSettings& it : bad) {
    device::HomingState fresh;
    CHECK_EQ(home(fresh, it, one_joint(), sample).torque_Nm[0], 0.0f);
    CHECK(fresh.fault == HomingFault::kSettings);
  }
}
