// Second encoders: each word as it is stored is broken alone; what agrees and what does not,
// against angles in double.
#include "firmtouch/device/second_encoders.hpp"

#include <cmath>

#include "device/opened_part.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

constexpr double kWithin_rad = 0.01;

using Stored = device_test::StoredWith<device::SecondEncodersLayout>;

Stored bar(float first, float second) {
  Stored to = {};
  to.before = device_test::stored_bar(first);
  for (uint32_t k = 0; k < 2; ++k) {
    to.part.counts_per_rad[k] = second;
  }
  to.part.within_rad = static_cast<float>(kWithin_rad);
  return to;
}

using Opened = device_test::OpenedPart<device::SecondEncoders, Stored>;

void check_broken(uint32_t element, float first, float second, float within_rad, float third = 0) {
  Stored stored = bar(first, second);
  stored.part.within_rad = within_rad;
  stored.part.counts_per_rad[2] = third;
  device_test::check_broken<device::SecondEncoders>(stored, device::kRuleSecondEncoder, element);
}

int32_t floor_of(double value) { return static_cast<int32_t>(std::floor(value)); }

}  // namespace

TEST(SecondEncoders_EachWordIsBrokenAlone) {
  CHECK(Opened(bar(2200, 1000)).verdict.ok());
  CHECK(Opened(bar(-2200, 1e3f)).verdict.ok());
  const float nan = test::nan_value();
  check_broken(0, 2200, 10001, .001f);
  check_broken(0, 2200, -.9f, 9);
  check_broken(0, 2200, nan, .01f);
  check_broken(0, 2200, -0.0f, .01f);
  check_broken(2, 2200, 1000, .01f, 1000);  // no such joint
  check_broken(3, 2200, 1000, .0034f);      // less than a count of the first and 3 of the second
  check_broken(3, 100, 1000, .0129f);
  check_broken(3, 2200, 1000, .061f);
  check_broken(3, 2200, 1000, nan);
  check_broken(6, 2200, 0, .01f);
}

TEST(SecondEncoders_ASectionWithoutThem_IsPassedAndNotCompared) {
  Stored stored = bar(2200, 1000);
  const uint8_t* data = reinterpret_cast<const uint8_t*>(&stored);
  device::StoredLinkage linkage;
  device::SecondEncoders second;
  const core::Bytes alone(data, sizeof stored.before);
  CHECK_EQ(open(alone, linkage).rule, 0u);
  CHECK_EQ(second.open(alone, linkage).rule, 0u);
  CHECK(!second.is_open());
}

// What is off by less than the tolerance without 3 counts and one agrees, by more with them not.
TEST(SecondEncoders_AgreeWithinTheToleranceOnly) {
  const float kFirst[] = {2200, -2200, 1e6f, 300};
  const float kSecond[] = {1000, -1000, 900, 5900};
  test::Lcg random(7);
  uint32_t agreeing = 0, differing = 0;
  for (int setting = 0; setting < 4; ++setting) {
    const double first = static_cast<double>(kFirst[setting]);
    const double second = static_cast<double>(kSecond[setting]);
    const double size = second < 0 ? -second : second, ratio = size / (first < 0 ? -first : first);
    Stored stored = bar(kFirst[setting], kSecond[setting]);
    const double within_rad = double{stored.part.within_rad};
    const Opened opened(stored);
    CHECK(opened.verdict.ok());
    for (int i = 0; i < 1000; ++i) {
      const double from_rad[2] = {double{random.between(-100, 100)},
                                  double{random.between(-100, 100)}};
      const double turned_rad[2] = {double{random.between(-2, 2)}, double{random.between(-2, 2)}};
      const double reach_rad = i % 2 == 0 ? 3 * within_rad : 1;
      const double off_rad[2] = {double{random.between(-1, 1)} * reach_rad, 0};
      const uint32_t wrap = random.bits();
      const auto seen = [&](double share, const double(&by_rad)[2], device::Sample& sample) {
        uint32_t second_counts = 0xFF0000u;
        for (int k = 0; k < 2; ++k) {
          const double at_rad = from_rad[k] + share * turned_rad[k];
          sample.counts[k] = static_cast<int32_t>(
              wrap + static_cast<uint32_t>(floor_of((at_rad + by_rad[k]) * first)));
          second_counts |= (static_cast<uint32_t>(floor_of(at_rad * second)) & 255u) << 8 * k;
        }
        return second_counts;
      };
      const double none_rad[2] = {};
      device::Sample sample{{}, true, .001f};
      device::SecondState state;
      const uint32_t begin = seen(0, none_rad, sample);
      align(state, sample, begin);
      bool did_agree = true;
      for (int step = 1; step < 100; ++step) {
        const uint32_t counts = seen(.01 * step, none_rad, sample);
        did_agree &= agree(state, opened.part, opened.linkage, sample, counts);
      }
      CHECK(did_agree);
      const uint32_t counts = seen(1, off_rad, sample);
      const bool do_agree = agree(state, opened.part, opened.linkage, sample, counts);
      const double off = (off_rad[0] < 0 ? -off_rad[0] : off_rad[0]) * size;
      const double most = within_rad * size;
      const bool must_agree = off < most - 3 - ratio;
      const bool must_differ = off > most + 3 + ratio;
      agreeing += must_agree ? 1 : 0;
      differing += must_differ ? 1 : 0;
      CHECK(!(must_agree && !do_agree) && !(must_differ && do_agree));
    }
  }
  CHECK_GE(agreeing, 200u);
  CHECK_GE(differing, 2000u);
}

TEST(SecondEncoders_EveryCountGivesAnAnswer) {
  const Opened proven(bar(2200, 1000));
  test::Lcg random(8);
  for (int i = 0; i < 20000; ++i) {
    device::Sample sample{{}, true, .001f};
    for (int32_t& count : sample.counts) count = static_cast<int32_t>(random.bits());
    device::SecondState state;
    align(state, sample, random.bits());
    sample.counts[0] = INT32_MIN;
    (void)agree(state, proven.part, proven.linkage, sample, static_cast<uint32_t>(i));
  }
}
