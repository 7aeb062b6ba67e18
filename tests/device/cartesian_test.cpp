// Encoders: quantum, wrap, jumps, lost samples, velocity; everything that a count can be.
#include "firmtouch/device/cartesian.hpp"

#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "harness/test.hpp"

namespace device = firmtouch::device;
namespace math = firmtouch::math;

namespace {

constexpr float kPeriod_s = 0.001f;

device::Settings settings() {
  return {{100000.0f, 50000.0f, 8192.0f},
          {0.1f, -0.2f, 0.0f},
          {0.5f, 0.5f, 0.5f},
          5.0f,
          {device::Estimator::kLowPass, 150.0f}};
}

device::Sample at(int32_t x, int32_t y, int32_t z) { return {{x, y, z}, true, kPeriod_s}; }

device::Reading read(device::State& state, const device::Sample& sample) {
  return device::read(state, settings(), sample);
}

bool is_near(float a, float b, float slack) { return a - b <= slack && b - a <= slack; }
bool is_finite(float a) { return a - a <= 0.0f; }

}  // namespace

TEST(PositionIsOriginPlusCountsOverResolution) {
  device::State state;
  const device::Reading reading = read(state, at(12345, -4321, 1024));
  CHECK(is_near(reading.position_m.x, 0.1f + 0.12345f, 3e-8f));
  CHECK(is_near(reading.position_m.y, -0.2f - 0.08642f, 3e-8f));
  CHECK_EQ(reading.position_m.z, 0.125f);
  CHECK_EQ(reading.velocity_mps.x, 0.0f);
  CHECK_EQ(reading.faults, 0u);
}

TEST(OneCountIsOneQuantum) {
  device::State state;
  const float before = read(state, at(0, 0, 100)).position_m.z;
  CHECK_EQ(read(state, at(0, 0, 101)).position_m.z - before, 1.0f / 8192.0f);
}

TEST(CountsAbove24BitsAreRoundedAndNotLost) {
  device::State state;
  device::Settings fine = settings();
  for (float& resolution : fine.counts_per_metre) resolution = 1e8f;
  const int32_t counts = 49000001;
  const device::Reading reading = device::read(state, fine, at(counts, -counts, counts));
  const double truth = 0.49000001;
  const double error = static_cast<double>(reading.position_m.z) - truth;
  CHECK_LE(error < 0 ? -error : error, 1.5 * 0x1p-25);  // 1.5 ulp of 0.49
  CHECK_EQ(reading.faults, 0u);
}

TEST(WrapOfTheCounterIsNoMotion) {
  // Wherever the counter stands when it passes 2^31, the difference is what counts.
  for (int32_t step = -400; step <= 400; step += 7) {
    for (int32_t offset = -3; offset <= 3; ++offset) {
      device::State state;
      const uint32_t start = 0x80000000u + static_cast<uint32_t>(offset);
      const uint32_t next = start + static_cast<uint32_t>(step);
      device::Settings wide = settings();
      wide.workspace_half_m = {10, 10, 10};
      for (float& resolution : wide.counts_per_metre) resolution = 1e8f;
      device::Sample sample = at(static_cast<int32_t>(start), 0, 0);
      (void)device::read(state, wide, sample);
      sample.counts[0] = static_cast<int32_t>(next);
      const device::Reading reading = device::read(state, wide, sample);
      CHECK(reading.accepted);
      CHECK_EQ(state.total[0] - static_cast<int64_t>(static_cast<int32_t>(start)),
               static_cast<int64_t>(step));
    }
  }
}

TEST(VelocityConvergesToTheTrueOne) {
  device::State state;
  device::Reading reading;
  for (int32_t k = 0; k < 60; ++k) reading = read(state, at(20 * k, -10 * k, 0));  // 0.2 m/s each
  CHECK(is_near(reading.velocity_mps.x, 0.2f, 1e-5f));
  CHECK(is_near(reading.velocity_mps.y, -0.2f, 1e-5f));
  CHECK_EQ(reading.velocity_mps.z, 0.0f);
}

TEST(VelocityIsTakenOverTheMeasuredTime) {
  device::State state;
  device::Reading reading;
  int32_t counts = 0;
  for (int32_t k = 0; k < 200; ++k) {
    device::Sample sample = at(counts, 0, 0);
    const int32_t periods = 1 + k % 3;  // a loop that limps
    counts += 20 * periods;
    sample.counts[0] = counts;
    sample.dt_s = kPeriod_s * static_cast<float>(periods);
    reading = read(state, sample);
  }
  CHECK(is_near(reading.velocity_mps.x, 0.2f, 1e-5f));
}

TEST(JumpFasterThanTheDevice_IsRejectedInTheSameTick) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int direction = -1; direction <= 1; direction += 2) {
      device::State state;
      (void)read(state, at(0, 0, 0));
      device::Sample jump = at(0, 0, 0);
      // 5 m/s over 1 ms at 100,000, 50,000 and 8,192 counts a metre, and one count of flicker.
      const int32_t most[3] = {501, 251, 41};
      jump.counts[axis] = direction * (most[axis] + 1);
      CHECK(!read(state, jump).accepted);
      device::State fresh;
      (void)read(fresh, at(0, 0, 0));
      jump.counts[axis] = direction * (most[axis] - 1);
      CHECK(read(fresh, jump).accepted);
    }
  }
}

TEST(LostSamples_AreExtrapolatedTwiceThenAFault) {
  device::State state;
  int32_t k = 0;
  for (; k < 60; ++k) (void)read(state, at(20 * k, 0, 0));
  const float last = state.position_m.x;
  device::Sample lost = at(INT32_MIN, 77, INT32_MAX);
  lost.trusted = false;
  device::Reading reading = read(state, lost);
  CHECK_EQ(reading.faults, 0u);
  CHECK(is_near(reading.position_m.x, last + 0.0002f, 1e-6f));
  reading = read(state, lost);
  CHECK_EQ(reading.faults, 0u);
  CHECK(is_near(reading.position_m.x, last + 0.0004f, 1e-6f));
  reading = read(state, lost);
  CHECK_EQ(reading.faults, device::kEncoderFault);
  CHECK(is_near(reading.position_m.x, last + 0.0004f, 1e-6f));  // held
  CHECK_EQ(reading.velocity_mps.x, 0.0f);
}

TEST(AfterExtrapolation_TrueMotionIsAccepted) {
  device::State state;
  int32_t k = 0;
  for (; k < 60; ++k) (void)read(state, at(300 * k % 40000, 0, 0));
  state = device::State{};
  (void)read(state, at(0, 0, 0));
  device::Sample lost = at(0, 0, 0);
  lost.trusted = false;
  (void)read(state, lost);
  (void)read(state, lost);
  const device::Reading reading = read(state, at(1400, 0, 0));  // 4.7 m/s over the three periods
  CHECK(reading.accepted);
  CHECK(is_near(reading.position_m.x, 0.114f, 1e-7f));
}

TEST(EverySecondSampleLostIsAFaultToo) {
  device::State state;
  (void)read(state, at(0, 0, 0));
  uint32_t ticks = 0;
  for (; ticks < 32; ++ticks) {
    device::Sample sample = at(0, 0, 0);
    sample.trusted = ticks % 2 != 0;
    if (read(state, sample).faults != 0) break;
  }
  CHECK_EQ(ticks, 10u);  // the sixth bad one
  device::clear(state);
  CHECK_EQ(read(state, at(0, 0, 0)).faults, 0u);
}

TEST(PositionOutsideTheWorkspace_IsClampedWithAFault) {
  device::State state;
  const device::Reading reading = read(state, at(60000, 0, -2000000000));
  CHECK_EQ(reading.faults, device::kWorkspaceFault);
  CHECK_EQ(reading.position_m.x, 0.1f + 0.5f);
  CHECK_EQ(reading.position_m.z, -0.5f);
}

TEST(EncoderThatNeverAnsweredIsAFault) {
  device::State state;
  device::Sample sample = at(5, 5, 5);
  sample.trusted = false;
  CHECK_EQ(read(state, sample).faults, device::kEncoderFault);
}

TEST(AnyCountAndTime_GivesFiniteResults) {
  const int32_t counts[] = {
      0, 1, -1, INT32_MAX, INT32_MIN, INT32_MAX - 1, 1 << 24, (1 << 24) + 1, -(1 << 30)};
  const uint32_t times[] = {0u,          0x80000000u, 1u,          0x007FFFFFu,
                            0x3A83126Fu, 0x3F800000u, 0x7F7FFFFFu, 0xFF7FFFFFu,
                            0x7F800000u, 0xFF800000u, 0x7FC00000u, 0xFFC00001u};
  device::State state;
  for (const int32_t first : counts) {
    for (const int32_t second : counts) {
      for (const uint32_t time : times) {
        device::Sample sample = at(first, second, -(first / 2));
        sample.dt_s = math::float_of(time);
        sample.trusted = (first ^ second) % 3 != 0;
        const device::Reading reading = read(state, sample);
        CHECK(is_finite(reading.position_m.x) && is_finite(reading.position_m.y) &&
              is_finite(reading.position_m.z));
        CHECK(is_finite(reading.velocity_mps.x) && is_finite(reading.velocity_mps.y));
        CHECK_LE(reading.position_m.x, 0.6f);
        CHECK_GE(reading.position_m.x, -0.4f);
      }
    }
  }
}

TEST(SameSamplesGiveTheSameBits) {
  device::State a, b;
  uint32_t word = 99;
  for (int k = 0; k < 2000; ++k) {
    word = word * 1664525u + 1013904223u;
    const device::Sample sample =
        at(static_cast<int32_t>(word >> 20), static_cast<int32_t>(word >> 22), k % 50);
    const device::Reading x = read(a, sample), y = read(b, sample);
    CHECK_EQ(math::bits_of(x.position_m.x), math::bits_of(y.position_m.x));
    CHECK_EQ(math::bits_of(x.velocity_mps.y), math::bits_of(y.velocity_mps.y));
  }
}
