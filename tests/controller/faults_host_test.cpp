// What latches, when, what it leaves of the force, and how it is cleared: over the whole tick.
#include <cmath>
#include <cstdint>
#include <cstring>

#include "controller/ride.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

TEST(ClearedFaultsLetItGoOn) {
  Ride ride;
  ride.run(0, 400);
  ride.fill(400);
  ride.input.flags |= record::kFlagEmergencyStop;
  ride.step();
  ride.run(401, 500);
  CHECK_EQ(ride.output.faults, servo::kFaultEmergencyStop);
  ride.fill(500);
  ride.input.command = record::kCommandClearFaults;
  ride.step();  // refused: enable is high
  CHECK_NE(ride.output.state & record::kStateCommandRefused, 0u);
  CHECK_NE(ride.output.faults, 0u);
  ride.clear_faults(501);
  CHECK_EQ(ride.output.faults, 0u);
  double most = 0;
  for (uint32_t tick = 502; tick < 1500; ++tick) {
    ride.fill(tick);
    ride.step();
    most = std::fmax(most, size_of(ride.output.motor_N));
  }
  CHECK_EQ(ride.output.faults, 0u);
  CHECK_GE(most, 0.3);
}

TEST(ClearedFaults_OfTimingAndEncoder_StayCleared) {
  for (int kind = 0; kind < 2; ++kind) {
    Ride ride;
    ride.run(0, 400);
    for (uint32_t tick = 400; tick < 408; ++tick) {
      ride.fill(tick);
      if (kind == 0) ride.input.clock_us += (tick - 400) * 1000u;
      if (kind == 1) ride.input.flags |= record::kFlagEncoderFault;
      ride.step();
    }
    CHECK_NE(ride.output.faults, 0u);
    ride.fill(408);
    ride.input.clock_us += kind == 0 ? 8000u : 0u;
    ride.input.flags = 0;
    ride.input.command = record::kCommandClearFaults;
    ride.step();
    for (uint32_t tick = 409; tick < 500; ++tick) {
      ride.fill(tick);
      ride.input.clock_us += kind == 0 ? 8000u : 0u;
      ride.step();
      CHECK_EQ(ride.output.faults, 0u);
    }
  }
}

// So that the main loop, and with it the link, goes on, and somebody can lower the budget.
TEST(Overload_NoQueries_UntilTheFaultIsCleared) {
  for (const bool is_enabled : {true, false}) {
    Ride ride;
    uint32_t queried = 0;
    const auto step = [&](uint32_t tick, uint32_t last_work_us) {
      ride.fill(tick);
      if (!is_enabled) ride.input.flags = 0;
      ride.input.last_work_us = last_work_us;
      ride.step();
      queried += ride.output.steps > 0 ? 1 : 0;
    };
    for (uint32_t tick = 0; tick < 400; ++tick) step(tick, tick % 10 < 2 ? 2000 : 890);
    CHECK_EQ(ride.output.faults, 0u);
    CHECK_EQ(queried, 400u);
    for (uint32_t tick = 400; tick < 402; ++tick) step(tick, 1050);
    queried = 0;
    for (uint32_t tick = 402; tick < 600; ++tick) step(tick, tick == 402 ? 1050 : 100);
    CHECK_EQ(queried, 0u);
    CHECK_EQ(ride.output.faults, servo::kFaultOverload);
    CHECK_EQ(size_of(ride.output.motor_N), 0.0);
    ride.clear_faults(600);
    for (uint32_t tick = 601; tick < 900; ++tick) step(tick, 100);
    CHECK_EQ(ride.output.faults, 0u);
    CHECK_EQ(queried, 299u);
  }
}

TEST(TrippedGuardIsAFaultThatStaysUntilItIsCleared) {
  Ride ride;
  ride.run(0, 400);
  uint32_t found = 0;  // the guard's own memory, by its pattern
  unsigned char* bytes = reinterpret_cast<unsigned char*>(&ride.controller);
  for (size_t at = 0; at + 4 <= sizeof ride.controller; at += 4) {
    uint32_t word = 0;
    std::memcpy(&word, bytes + at, 4);
    if (word != servo::kGuardArmed) continue;
    bytes[at + 1] ^= 0x10u;
    ++found;
  }
  CHECK_EQ(found, 1u);
  ride.run(400, 420);
  CHECK_EQ(ride.output.faults, servo::kFaultGuard);
  CHECK_EQ(size_of(ride.output.motor_N), 0.0);
  ride.clear_faults(420);
  CHECK_EQ(ride.output.faults, 0u);
  ride.run(421, 600);
  CHECK_EQ(ride.output.faults, 0u);
}

TEST(EnableThatStandsSinceTheBeginningPushesOnlyOnceItWasLow) {
  const auto press = [](Ride& ride, uint32_t tick, bool enable) {
    ride.fill(400);
    ride.input.encoder_counts[2] -= 300;
    ride.input.tick = tick;
    ride.input.clock_us = tick * 1000u;
    ride.input.flags = enable ? record::kFlagEnable : 0;
    ride.step();
  };
  Ride ride;
  for (uint32_t round = 0; round < 2; ++round) {
    double most = 0;
    for (uint32_t tick = 0; tick < 500; ++tick) {
      press(ride, tick, true);
      CHECK_EQ(size_of(ride.output.motor_N), 0.0);
      CHECK_EQ(ride.output.state & record::kStateServoMask,
               static_cast<uint32_t>(servo::Mode::kOff));
    }
    press(ride, 500, false);
    for (uint32_t tick = 501; tick < 1000; ++tick) {
      press(ride, tick, true);
      most = std::fmax(most, size_of(ride.output.motor_N));
    }
    CHECK_GE(most, 0.3);
    CHECK_EQ(ride.output.faults, 0u);
    ride.controller.reset();
  }
  // Low while the asset was still being opened does not count.
  ride.controller.begin(both().bytes());
  press(ride, 0, false);
  while (!ride.controller.work(4096)) {
  }
  for (uint32_t tick = 1; tick < 300; ++tick) {
    press(ride, tick, true);
    CHECK_EQ(size_of(ride.output.motor_N), 0.0);
  }
}

TEST(DeviceWithoutASample_GivesNoForceAndFaultsWhenEnabled) {
  Ride ride;
  const auto step = [&](uint32_t tick, uint32_t lines, uint32_t row, float value) {
    ride.fill(tick);
    ride.input.flags = lines | record::kFlagEncoderFault;
    ride.input.command = row == params::kCount ? 0 : 1 + row;
    ride.input.command_value = value;
    ride.step();
  };
  step(0, 0, params::kRampIn, 0);
  step(1, 0, params::kForceLimit, 100);
  step(2, 0, params::kSlewLimit, 1e6f);
  step(3, 0, params::kContactStiffness, 20000);
  step(4, 0, params::kGuideSnap, 1);
  step(5, 0, params::kGuideStiffness, 20000);
  for (uint32_t tick = 6; tick < 40; ++tick) {
    const uint32_t lines = tick < 10 ? 0 : record::kFlagEnable;
    step(tick, lines, params::kCount, 0);
    CHECK_EQ(ride.output.steps, 0u);
    CHECK_EQ(ride.output.distance_m, 0.0f);
    CHECK_EQ(ride.output.state & (record::kStateContact | record::kStateOnGuide), 0u);
    CHECK_EQ(size_of(ride.output.motor_N), 0.0);
    CHECK_EQ(ride.output.faults, tick < 10 ? 0u : servo::kFaultEncoder);
  }
}

TEST(FlippedBitsInTheParametersDoNotPassTheGuard) {
  uint32_t stopped = 0, too_much = 0, too_fast = 0;
  for (uint32_t row = 0; row < params::kCount; ++row) {
    for (uint32_t bit = 0; bit < 32; ++bit) {
      Ride ride;
      float before[3] = {};
      for (uint32_t tick = 0; tick < 330; ++tick) {
        ride.fill(400);
        ride.input.tick = tick;
        ride.input.clock_us = tick * 1000u;
        ride.input.flags = tick < 10 ? 0 : record::kFlagEnable;
        // 30 mm further in, 0.5 mm a tick: 800 N/m would like to push with far more than 8 N.
        const uint32_t pressed = tick < 250 ? 0 : tick < 310 ? tick - 250 : 60;
        ride.input.encoder_counts[2] -= 50 * static_cast<int32_t>(pressed);
        if (tick == 240) {
          float& value = const_cast<float&>(ride.controller.values().value[row]);
          uint32_t word;
          std::memcpy(&word, &value, 4);
          word ^= 1u << bit;
          std::memcpy(&value, &word, 4);
        }
        if (tick == 245) {  // somebody sets another row: what was hit must not be taken for good
          ride.input.command = 1 + params::kToolRadius;
          ride.input.command_value = 0.003f;
        }
        ride.step();
        if (!(size_of(ride.output.motor_N) <= 8.0001)) ++too_much;
        for (int k = 0; k < 3; ++k) {
          const float now = ride.output.motor_N[k];
          const float from = now * before[k] > 0 ? std::fabs(before[k]) : 0;
          if (!(std::fabs(now) <= from + 5.006f)) ++too_fast;
          before[k] = now;
        }
      }
      if ((ride.output.faults & (servo::kFaultGuard | servo::kFaultSettings)) != 0) ++stopped;
    }
  }
  CHECK_EQ(too_much, 0u);
  CHECK_EQ(too_fast, 0u);
  CHECK_GE(stopped, 10u);
}

TEST(RandomInputsNeverBreakTheOutput) {
  Ride ride;
  uint64_t word = 1;
  const auto random = [&word] {
    word = word * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<uint32_t>(word >> 32);
  };
  double before[3] = {};
  uint32_t pushing = 0;
  for (uint32_t tick = 0; tick < 20000; ++tick) {
    ride.fill(tick);
    const uint32_t what = ride.output.faults != 0 && random() % 4 == 0 ? 6 : random() % 200;
    if (what == 0) ride.input.encoder_counts[random() % 3] = static_cast<int32_t>(random());
    if (what == 1) ride.input.clock_us = random();
    if (what == 2) ride.input.flags = random() & 0xFu;
    if (what == 3) ride.input.tick = random();
    if (tick % 2000 == 0)
      ride.controller.reset();  // else the random parameters end as a device that feels nothing
    if (what == 4 || what == 5) {
      ride.input.command = 1 + random() % (params::kCount + 1);
      const uint32_t bits = random();
      std::memcpy(&ride.input.command_value, &bits, 4);
    }
    if (what == 6) ride.input.command = record::kCommandClearFaults, ride.input.flags = 0;
    const double slew_N = static_cast<double>(ride.controller.values()[params::kSlewLimit]) *
                          static_cast<double>(ride.controller.values()[params::kTickPeriod]);
    ride.step();
    CHECK(all_finite(ride.output));
    if (size_of(ride.output.motor_N) > 0.01) ++pushing;
    const double limit_N = static_cast<double>(ride.controller.values()[params::kForceLimit]);
    CHECK_LE(size_of(ride.output.motor_N), limit_N);
    const double slew_now_N = static_cast<double>(ride.controller.values()[params::kSlewLimit]) *
                              static_cast<double>(ride.controller.values()[params::kTickPeriod]);
    for (int k = 0; k < 3; ++k) {
      const double now = static_cast<double>(ride.output.motor_N[k]);
      const double from = now * before[k] > 0 ? std::fabs(before[k]) : 0;
      CHECK_LE(std::fabs(now), from + std::fmax(slew_N, slew_now_N) * (1 + 1e-6) + 1e-6);
      before[k] = now;
    }
  }
  CHECK_GE(pushing, 1000u);  // it must not pass by being off
}
