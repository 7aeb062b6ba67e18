// The stock controller on a linkage that the asset stores: the forces of a Cartesian device, joint
// torques of their own oracle, ceilings for every input, and faults.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "controller/arm_ride.hpp"
#include "harness/random.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

TEST(ArmOfTheAsset_RendersTheForcesOfACartesianDevice) {
  ArmRide ride(arm_with(20));
  uint32_t pushes = 0, different = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.step(tick);
    CHECK_EQ(ride.output.faults, 0u);
    const float(&expected_N)[3] = ride.cartesian.output.force_N;
    for (int k = 0; k < 3; ++k) {
      different += std::fabs(ride.output.force_N[k] - expected_N[k]) > 0.01f ? 1u : 0u;
      const double aside_m = k == 0 ? kAside_m : 0;
      CHECK_LE(std::fabs(static_cast<double>(ride.output.position_m[k]) - aside_m -
                         static_cast<double>(ride.cartesian.output.position_m[k])),
               2e-6);
      const double expected_Nm = torque_of(ride.angle_rad, k, ride.output.force_N);
      CHECK_LE(std::fabs(static_cast<double>(ride.output.motor_N[k]) - expected_Nm), 2e-5);
    }
    pushes += size_of(ride.output.force_N) > 0.5 ? 1u : 0u;
  }
  CHECK_GE(pushes, 500u);
  CHECK_LE(different, 45u);  // of 9,000: rounding put the proxy on another face
}

TEST(Arm_OfTwoJoints_WritesTheWholeOutput) {
  device::LinkageLayout layout = arm_with(20);
  layout.joints = 2;
  layout.joint[2] = {};
  layout.max_torque_Nm[2] = 0;
  ArmRide ride(layout);
  ride.step(0);
  CHECK_EQ(ride.output.faults, 0u);
  for (const float torque_Nm : ride.output.motor_N) CHECK_EQ(torque_Nm, 0.0f);
}

// 100 g, 1 N s/m, 1 ms: 2,000 (1 - 0.005) / (1 + 0.005) = 1,980 N/m, whatever device_damping says.
TEST(Arm_WallStifferThanStable_IsRefusedOrForced) {
  for (const bool is_forced : {false, true}) {
    device::LinkageLayout layout = arm_with(20);
    layout.least_mass_kg = 0.1f;
    if (is_forced) layout.flags |= device::kFlagForcedWalls;
    for (const float stiffness : {1975.0f, 1985.0f}) {
      ArmRide ride(layout);
      ride.stiffness_N_per_m = stiffness;
      double largest_N = 0;
      for (uint32_t tick = 0; tick < 1500; ++tick) {
        ride.step(tick);
        const uint32_t wall =
            ride.output.state & (record::kStateWallRefused | record::kStateWallForced);
        const bool is_stiff = stiffness > 1980 && tick >= 10;
        CHECK_EQ(wall, !is_stiff   ? 0u
                       : is_forced ? record::kStateWallForced
                                   : record::kStateWallRefused);
        largest_N = std::max(largest_N, size_of(ride.output.force_N));
        CHECK_EQ(ride.output.faults, 0u);
      }
      CHECK_EQ(largest_N > 0.5, is_forced || stiffness < 1980);
      CHECK_EQ(record::may_push(ride.output), is_forced || stiffness < 1980);
    }
  }
}

// Of a mass of 20 g under a spring and a damper, held over ticks of 1 ms: how far it is after 1,000
// ticks, of its first 1 mm. In steps of the closed form for a constant force.
double moved_share(double stiffness_N_per_m, double damping_N_s_per_m) {
  constexpr double kMass_kg = 0.02, kPeriod_s = 1e-3;
  double x_m = 1e-3, before_m = 1e-3, v_mps = 0, largest_m = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    const double force_N =
        -stiffness_N_per_m * x_m - damping_N_s_per_m * (x_m - before_m) / kPeriod_s;
    before_m = x_m;
    x_m += kPeriod_s * (v_mps + kPeriod_s * force_N / (2 * kMass_kg));
    v_mps += kPeriod_s * force_N / kMass_kg;
    if (tick >= 900) largest_m = std::max(largest_m, std::fabs(x_m));
  }
  return largest_m / 1e-3;
}

// Each of 10 N s/m is stable to 12,000 N/m; both, where the guide pulls into the surface, to
// 13,333.
TEST(Arm_GuideAndContactStableApart_AreRefusedTogether) {
  for (const float stiffness_N_per_m : {6600.0f, 6700.0f}) {
    const bool is_stable = stiffness_N_per_m < 6666;
    CHECK_LE(moved_share(static_cast<double>(stiffness_N_per_m), 10), 0.1);
    CHECK_EQ(moved_share(2.0 * static_cast<double>(stiffness_N_per_m), 20) < 1, is_stable);
    device::LinkageLayout layout = arm_with(20);
    layout.least_mass_kg = 0.02f;
    ArmRide ride(layout);
    for (uint32_t tick = 0; tick < 600; ++tick) {
      record::TickInput input = ride.input_of(tick);
      const params::Index rows[4] = {params::kContactStiffness, params::kContactDamping,
                                     params::kGuideStiffness, params::kGuideDamping};
      if (tick >= 3 && tick < 7) {
        input.command = 1 + static_cast<uint32_t>(rows[tick - 3]);
        input.command_value = tick % 2 == 1 ? stiffness_N_per_m : 10.0f;
      }
      ride.controller.tick(input, ride.output);
      if (tick >= 100) CHECK_EQ((ride.output.state & record::kStateWallRefused) == 0, is_stable);
    }
    CHECK_EQ(record::may_push(ride.output), is_stable);
  }
}

TEST(Arm_StiffWall_NeedsEnablingAnew) {
  device::LinkageLayout layout = arm_with(20);
  layout.least_mass_kg = 0.1f;
  ArmRide ride(layout);
  uint32_t on = 0;
  for (uint32_t tick = 0; tick < 1500; ++tick) {
    record::TickInput input = ride.input_of(tick);
    if (tick == 600 || tick == 900) {
      input.command = 1 + static_cast<uint32_t>(params::kContactStiffness);
      input.command_value = tick == 600 ? 5000.0f : 800.0f;
    }
    if (tick == 1200) input.flags &= ~record::kFlagEnable;
    const double before_N = size_of(ride.output.force_N);
    ride.controller.tick(input, ride.output);
    if (tick == 600) CHECK((ride.output.state & record::kStateWallRefused) != 0);
    if (tick >= 600 && tick < 900) CHECK_LE(size_of(ride.output.force_N), before_N + 1e-3);
    if (tick >= 700 && tick <= 1200) CHECK(!record::may_push(ride.output));
    on += tick > 1200 && record::may_push(ride.output) ? 1u : 0u;
    CHECK_EQ(ride.output.faults, 0u);
  }
  CHECK_EQ(on, 299u);
}

TEST(WeakJoints_KeepTheForcesDirectionAndTheirCeilings) {
  ArmRide strong(arm_with(20)), weak(arm_with(0.3f));
  uint32_t limited = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    strong.step(tick), weak.step(tick);
    CHECK_EQ(weak.output.faults, 0u);  // the guard had nothing to stop
    double along = 0;
    for (int k = 0; k < 3; ++k) {
      CHECK_LE(std::fabs(weak.output.motor_N[k]), 0.3f);
      along += static_cast<double>(weak.output.force_N[k]) *
               static_cast<double>(strong.output.force_N[k]);
    }
    const double sizes = size_of(weak.output.force_N) * size_of(strong.output.force_N);
    CHECK_LE(sizes - along, 1e-4 * sizes + 1e-6);
    limited += size_of(weak.output.force_N) < 0.9 * size_of(strong.output.force_N) ? 1u : 0u;
  }
  CHECK_GE(limited, 100u);
}

TEST(Arm_AnyInput_StaysFiniteAndWithinItsCeilings) {
  ArmRide ride(arm_with(0.3f));
  test::Xorshift random(11);
  float before_Nm[3] = {};
  for (uint32_t tick = 0; tick < 20000; ++tick) {
    record::TickInput input = ride.input_of(tick % 3000);
    input.tick = tick;
    input.clock_us = tick * 1000u;
    if (random() % 20 == 0) input.encoder_counts[random() % 3] ^= 1 << random() % 31;
    if (random() % 50 == 0) input.flags ^= 1u << random() % 4;
    if (tick % 500 < 4) {
      input.flags = 0;
      input.command = record::kCommandClearFaults;
    }
    ride.controller.tick(input, ride.output);
    CHECK(all_finite(ride.output));
    for (int k = 0; k < 3; ++k) {
      const float torque_Nm = ride.output.motor_N[k];
      CHECK_LE(std::fabs(torque_Nm), 0.3f);
      const float from_Nm = torque_Nm * before_Nm[k] > 0 ? std::fabs(before_Nm[k]) : 0;
      CHECK_LE(std::fabs(torque_Nm), from_Nm + 0.15001f);
      before_Nm[k] = torque_Nm;
    }
    CHECK_EQ(ride.output.faults & servo::kFaultGuard, 0u);
  }
}

// 4 N m would be wanted within a tick or two.
TEST(StiffWall_TorquesRiseNoFasterThanTheAssetAllows) {
  device::LinkageLayout layout = arm_with(3);
  layout.torque_rise_s = 0.02f;
  ArmRide ride(layout);
  ride.stiffness_N_per_m = 20000;
  float before_Nm[3] = {};
  uint32_t steep = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.step(tick);
    CHECK_EQ(ride.output.faults, 0u);  // the guard had nothing to stop
    for (int k = 0; k < 3; ++k) {
      const float torque_Nm = ride.output.motor_N[k];
      const float from_Nm = torque_Nm * before_Nm[k] > 0 ? std::fabs(before_Nm[k]) : 0;
      CHECK_LE(std::fabs(torque_Nm), from_Nm + 0.15001f);
      steep += std::fabs(torque_Nm) > from_Nm + 0.1499f ? 1u : 0u;
      before_Nm[k] = torque_Nm;
    }
  }
  CHECK_GE(steep, 5u);
}

TEST(Arm_BeyondItsRange_OrTooFast_IsAFault) {
  const device::LinkageLayout layout = arm_with(1);
  ArmRide beyond(layout), fast(layout);
  for (uint32_t tick = 0; tick < 300; ++tick) beyond.step(tick), fast.step(tick);
  record::TickInput input = beyond.input_of(300);
  for (uint32_t tick = 300; tick < 900; ++tick) {
    input = beyond.input_of(tick);
    input.encoder_counts[0] += static_cast<int32_t>((tick - 300) * 0.008 * kCountsPerRad);
    beyond.controller.tick(input, beyond.output);
  }
  CHECK_NE(beyond.output.faults & servo::kFaultWorkspace, 0u);
  // 20 rad/s at 0.35 m are 7 m/s, which the joint may turn at and the tip may not.
  for (uint32_t tick = 300; tick < 340; ++tick) {
    input = fast.input_of(tick);
    input.encoder_counts[0] += static_cast<int32_t>((tick - 300) * 0.02 * kCountsPerRad);
    fast.controller.tick(input, fast.output);
  }
  CHECK_NE(fast.output.faults & servo::kFaultEncoder, 0u);
  CHECK_EQ(size_of(fast.output.motor_N), 0.0);
}

// The base alone turns, ever faster up to a share of the limit: the tip is on a circle. Joints may
// turn at 50 rad/s.
TEST(Arm_TipFasterThanMaxSpeed_IsAFault) {
  constexpr double kLimit_mps = 1.5, kFull = 150;  // ticks
  for (const double share : std::initializer_list<double>{0.98, 1.02}) {
    ArmRide ride(arm_with(1));
    for (uint32_t tick = 0; tick < 300; ++tick) ride.step(tick);
    record::TickInput input = ride.input_of(300);
    const Tip tip = tip_of(ride.angle_rad);
    const double step_rad = share * kLimit_mps * 1e-3 / std::hypot(tip.x, tip.y);
    const double from_rad = ride.angle_rad[0];
    input.command = 1 + static_cast<uint32_t>(params::kMaxSpeed);
    input.command_value = static_cast<float>(kLimit_mps);
    double turned_rad = 0;
    for (int tick = 1; tick < 600; ++tick) {
      ride.controller.tick(input, ride.output);
      if (tick < kFull) CHECK_EQ(ride.output.faults, 0u);
      input.command = record::kCommandNone;
      ++input.tick;
      input.clock_us += 1000;
      turned_rad += step_rad * std::min(tick / kFull, 1.0);
      input.encoder_counts[0] =
          static_cast<int32_t>(std::lround((from_rad + turned_rad) * kCountsPerRad));
    }
    CHECK_EQ(ride.output.faults, share > 1 ? servo::kFaultEncoder : 0u);
  }
}

TEST(DamagedLinkage_IsRefusedByItsRule) {
  device::LinkageLayout layout = arm_with(1);
  layout.length_m[1] = 0;
  const Asset asset(file_with(layout));
  static FullController controller;
  CHECK_EQ(controller.open(asset.bytes()).rule, uint16_t{707});
  CHECK_EQ(faults_when_enabled(controller), servo::kFaultAsset);
}
