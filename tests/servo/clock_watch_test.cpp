// The measured time of a tick, and when the loop counts as lost.
#include "firmtouch/servo/clock_watch.hpp"

#include <stdint.h>

#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"
#include "servo/specials.hpp"

namespace servo = firmtouch::servo;
namespace math = firmtouch::math;
namespace test = firmtouch::test;

namespace {

constexpr float kPeriod_s = 0.001f;

struct Clock {
  servo::ClockState state;
  uint32_t now_us = 0;
  servo::ClockReading after(uint32_t us, uint32_t last_work_us = 0) {
    return servo::watch_clock(state, now_us += us, last_work_us, kPeriod_s, 1.5f);
  }
};

bool is_near(float a, float b) { return a - b < 1e-9f && b - a < 1e-9f; }

// Every `gap`-th tick misses; `tick(clock, is_missed)` makes one. The third miss must raise
// `fault`.
template <class Tick>
void check_third_miss(uint32_t gap, uint32_t fault, Tick tick) {
  Clock clock;
  (void)clock.after(0);
  uint32_t missed = 0, faults = 0;
  for (uint32_t i = 0; i < 40 && faults == 0; ++i) {
    missed += i % gap == 0 ? 1u : 0u;
    faults = tick(clock, i % gap == 0);
  }
  CHECK_EQ(faults, fault);
  if (faults != 0) CHECK_EQ(missed, 3u);
}

}  // namespace

TEST(RegularClock_MeasuresItsPeriodWithinTenPercent) {
  for (uint32_t period = 900; period <= 1100; period += 50) {
    Clock clock;
    (void)clock.after(0);
    for (int i = 0; i < 100; ++i) {
      const servo::ClockReading reading = clock.after(period);
      CHECK(is_near(reading.dt_s, static_cast<float>(period) * 1e-6f));
      CHECK_EQ(reading.faults, 0u);
      CHECK(!reading.late);
    }
  }
}

TEST(WrapOfTheClockIsNoEventAtAnyPhase) {
  for (uint32_t phase = 0; phase < 3000; ++phase) {
    Clock clock;
    clock.now_us = UINT32_MAX - phase;
    (void)clock.after(0);
    for (int i = 0; i < 4; ++i) {
      const servo::ClockReading reading = clock.after(1000);
      CHECK_EQ(reading.faults, 0u);
      CHECK(is_near(reading.dt_s, kPeriod_s));
    }
  }
}

TEST(OneLateTick_IsMeasuredWithoutAFault) {
  Clock clock;
  (void)clock.after(0);
  for (int i = 0; i < 50; ++i) {
    const servo::ClockReading reading = clock.after(i % 10 == 0 ? 2500 : 1000);
    CHECK_EQ(reading.faults, 0u);
    CHECK_EQ(reading.late, i % 10 == 0);
  }
}

TEST(ThreeLateTicksOfTenAreAMissedDeadline) {
  for (uint32_t gap = 1; gap <= 6; ++gap) {
    const uint32_t fault = gap <= 4 ? servo::kFaultDeadline : 0u;
    check_third_miss(gap, fault, [](Clock& clock, bool is_late) {
      return clock.after(is_late ? 1501 : 1000).faults;
    });
  }
}

TEST(StallIsAMissedDeadlineAtOnce) {
  Clock clock;
  (void)clock.after(0);
  CHECK_EQ(clock.after(4001).faults, servo::kFaultDeadline);
}

TEST(ClockSetBackOrFarForward_IsAClockFaultAtOnce) {
  const uint32_t jumps[] = {UINT32_MAX, UINT32_MAX - 999u, 0x80000000u, 1000000u};
  for (const uint32_t jump : jumps) {
    Clock clock;
    (void)clock.after(0);
    const servo::ClockReading reading = clock.after(jump);
    CHECK_EQ(reading.faults, servo::kFaultClock);
    CHECK(is_near(reading.dt_s, kPeriod_s));
  }
}

TEST(ClockThatStandsIsABrokenClockAtTheThirdTick) {
  Clock clock;
  (void)clock.after(0);
  (void)clock.after(1000);
  CHECK_EQ(clock.after(0).faults, 0u);
  CHECK_EQ(clock.after(0).faults, 0u);
  const servo::ClockReading reading = clock.after(0);
  CHECK_EQ(reading.faults, servo::kFaultClock);
  CHECK(is_near(reading.dt_s, 0.5f * kPeriod_s));
}

// A timer at another rate than the parameter's, which no single tick shows. 50 % jitter does not.
TEST(ClockOfAnotherRate_IsABrokenClockAtThe32ndTick) {
  Clock clock;
  (void)clock.after(0);
  for (uint32_t i = 1; i <= 40; ++i) CHECK_EQ(clock.after(799).faults != 0, i >= 32);
  CHECK_EQ(clock.after(799).faults, servo::kFaultClock);
  CHECK_EQ(clock.after(801).faults, 0u);
  for (uint32_t i = 1; i <= 32; ++i) (void)clock.after(799);
  servo::clear(clock.state);
  CHECK_EQ(clock.after(799).faults, 0u);
  uint32_t random = 1;
  for (int i = 0; i < 1000000; ++i) {
    random = random * 1664525u + 1013904223u;
    CHECK_EQ(clock.after(501 + (random >> 16) % 998u).faults & servo::kFaultClock, 0u);
  }
}

TEST(ThreeOverloadedTicksOfTen_AreAnOverload) {
  const uint32_t works_us[] = {899u, 901u, 1050u, UINT32_MAX};
  for (const uint32_t work_us : works_us) {
    for (uint32_t gap = 1; gap <= 6; ++gap) {
      const uint32_t fault = gap <= 4 && work_us > 900 ? servo::kFaultOverload : 0u;
      check_third_miss(gap, fault, [work_us](Clock& clock, bool is_overloaded) {
        return clock.after(1000, is_overloaded ? work_us : 500).faults;
      });
    }
  }
}

TEST(MissesOfOneKind_AreForgottenAfterTenTicks_AndAreNoOthers) {
  const auto missed = [](Clock& clock, uint32_t fault) {
    const uint32_t us = fault == servo::kFaultDeadline ? 1501
                        : fault == servo::kFaultClock  ? 499
                                                       : 1000;
    return clock.after(us, fault == servo::kFaultOverload ? 950 : 0).faults;
  };
  const uint32_t faults[] = {servo::kFaultDeadline, servo::kFaultClock, servo::kFaultOverload};
  for (const uint32_t fault : faults) {
    Clock clock;
    (void)clock.after(0);
    for (uint32_t i = 1; i <= 3; ++i) CHECK_EQ(missed(clock, fault), i == 3 ? fault : 0u);
    for (uint32_t i = 1; i <= 40; ++i) CHECK_EQ(clock.after(1000).faults, i < 8 ? fault : 0u);
  }
}

TEST(OverloadIsSeenOnABrokenClockToo) {
  Clock clock;
  (void)clock.after(0);
  uint32_t faults = 0;
  for (uint32_t i = 0; i < 3; ++i) faults = clock.after(2000000, 2000000).faults;
  CHECK_EQ(faults, servo::kFaultOverload | servo::kFaultClock);
}

TEST(ClearedMisses_DoNotComeBack) {
  Clock clock;
  (void)clock.after(0);
  for (int i = 0; i < 3; ++i) (void)clock.after(2000, 2000);
  CHECK_NE(clock.after(1000).faults, 0u);
  servo::clear(clock.state);
  CHECK_EQ(clock.after(1000).faults, 0u);
}

TEST(TimeIsFiniteForEveryClockAndSetting) {
  const uint32_t clocks[] = {0u, 1u, 1000u, 0u, UINT32_MAX, 0x80000000u};
  for (const uint32_t period : test::kSpecialBits) {
    for (const uint32_t ratio : test::kSpecialBits) {
      servo::ClockState state;
      for (const uint32_t now : clocks) {
        const servo::ClockReading reading =
            servo::watch_clock(state, now, now, math::float_of(period), math::float_of(ratio));
        // What is not finite in is not finite out, and only that: device and servo check their own.
        CHECK(test::is_number(reading.dt_s) || !test::is_number(4 * math::float_of(period)));
      }
    }
  }
}
