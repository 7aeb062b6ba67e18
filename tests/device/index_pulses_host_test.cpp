// Index pulses: each word as it is stored is broken alone; joints of numbers that swing fast and
// slowly, with backlash and flickering counts, are never off; a belt that slips is found at the
// first pulse. The oracle is the joint's angle in double.
#include "firmtouch/device/index_pulses.hpp"

#include <algorithm>
#include <cmath>

#include "device/stored_bar.hpp"
#include "firmtouch/device/rules.hpp"
#include "harness/float_bits.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file

namespace {

struct Stored {
  device::HomedLinkageLayout homed;
  device::IndexLayout index;
};

// A five-bar whose joints have 2 rad of range.
Stored bar(float counts_per_rad = 2200) {
  Stored to = {};
  to.homed.linkage = device_test::stored_bar(counts_per_rad, .25f, 2.25f);
  to.homed.homing.by = static_cast<uint32_t>(device::HomeBy::kStops);
  to.homed.homing.speed_rad_per_s = 6;
  to.homed.homing.margin_rad = .1f;
  for (uint32_t k = 0; k < 2; ++k) {
    to.homed.homing.torque_Nm[k] = .1f;
    to.index.index_rad[k] = .7f;
    to.index.period_rad[k] = .6f;
  }
  to.index.within_rad = 20 / std::fabs(counts_per_rad);
  return to;
}

struct Opened {
  Stored stored;
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  device::IndexPulses index;
  core::Verdict verdict;

  explicit Opened(const Stored& from) : stored(from) {
    const core::Bytes bytes(reinterpret_cast<const uint8_t*>(&stored), sizeof stored);
    CHECK_EQ(device::IndexPulses::before(bytes).size(), uint32_t{sizeof stored.homed});
    device::StoredLinkage none;
    CHECK_EQ(open(bytes, none).rule, uint16_t{device::kRuleLinkageSize});
    CHECK_EQ(open(device::IndexPulses::before(bytes), linkage, homing).rule, 0u);
    verdict = index.open(bytes, linkage, homing);
    CHECK(index.is_open() == verdict.ok());
    if (!verdict.ok()) return;
    CHECK(settings_of(homing, index).by == device::HomeBy::kIndex);
  }
  Opened(const Opened&) = delete;
};

template <class Break>
void check_broken(uint32_t element, const Break& apply) {
  Stored stored = bar();
  apply(stored);
  const Opened opened(stored);
  CHECK_EQ(opened.verdict.rule, uint16_t{device::kRuleIndex});
  CHECK_EQ(opened.verdict.element, element);
}

// A joint that swings within its range, and its encoder behind some play.
class Joint {
 public:
  Joint(test::Lcg& random, const device::JointLayout& of, const device::IndexLayout& index,
        double play_counts, double most_rad_per_s)
      : random_(random),
        counts_per_rad_(double{of.counts_per_rad}),
        index_rad_(double{index.index_rad[0]}),
        period_rad_(double{index.period_rad[0]}),
        middle_rad_(0.5 * (double{of.low_rad} + double{of.high_rad})),
        half_rad_(0.5 * (double{of.high_rad} - double{of.low_rad})),
        most_rad_per_s_(most_rad_per_s),
        play_rad_(play_counts / std::fabs(counts_per_rad_)) {
    turn();
    angle_rad_ = motor_rad_ = middle_rad_;
  }
  // A tick: its sample, and what the board says of pulses.
  void move() {
    constexpr int kSteps = 20;
    pulses_ = 0;
    if (--left_ == 0) turn();
    for (int step = 0; step < kSteps; ++step) {
      phase_ += rate_ * 1e-3 / kSteps;
      const double before = turns();
      angle_rad_ = middle_rad_ + swing_rad_ * std::sin(phase_);
      motor_rad_ = std::clamp(motor_rad_, angle_rad_ - play_rad_ / 2, angle_rad_ + play_rad_ / 2);
      const double now = turns();
      if (!(now > before || now < before)) continue;
      pulses_ = 1;
      // The motor's angle just then: it follows at one side of the play.
      const double at_rad = index_rad_ + period_rad_ * std::max(now, before);
      latched_ = count_of(at_rad + (motor_rad_ - angle_rad_));
      if (!has_pulse_) pulse_ = latched_;
      has_pulse_ = true;
    }
    counts_ = static_cast<int32_t>(static_cast<uint32_t>(count_of(motor_rad_)) +
                                   static_cast<uint32_t>(random_.bits() >> 16 & 1u));
  }
  int32_t count_of(double rad) const {
    return static_cast<int32_t>(static_cast<int64_t>(std::floor(rad * counts_per_rad_)) + slip +
                                base);
  }
  double turns() const { return std::floor((angle_rad_ - index_rad_) / period_rad_); }
  uint32_t packed() const {
    return pulses_ == 0 ? 0 : 0x80u | (static_cast<uint32_t>(latched_) & 0x7Fu);
  }
  int32_t counts() const { return counts_; }
  int32_t pulse() const { return pulse_; }
  bool has_pulse() const { return has_pulse_; }
  int64_t slip = 0, base = 0;

 private:
  // Another swing, from slow to fast.
  void turn() {
    left_ = 200 + random_.bits() % 4000;
    const double before = swing_rad_ * std::sin(phase_);
    swing_rad_ = half_rad_ * double{random_.between(0.3f, 1)};
    swing_rad_ = std::max(swing_rad_, std::fabs(before));
    phase_ = std::asin(before / swing_rad_);
    rate_ = most_rad_per_s_ / swing_rad_ * std::pow(10.0, -2 * double{random_.between(0, 1)});
  }

  test::Lcg& random_;
  double counts_per_rad_, index_rad_, period_rad_, middle_rad_, half_rad_, most_rad_per_s_;
  double play_rad_, angle_rad_ = 0, motor_rad_ = 0, phase_ = 0, rate_ = 0, swing_rad_ = 0.1;
  uint32_t left_ = 0, pulses_ = 0;
  int32_t counts_ = 0, latched_ = 0, pulse_ = 0;
  bool has_pulse_ = false;
};

// Both joints of a five-bar, homed.
struct Bench {
  test::Lcg random;
  Opened opened;
  Joint joint[2];
  device::IndexState state;
  device::Sample sample{{}, true, .001f};

  Bench(uint32_t seed, float counts_per_rad, double most_rad_per_s)
      : random(seed),
        opened(bar(counts_per_rad)),
        joint{
            {random, opened.stored.homed.linkage.joint[0], opened.stored.index, 12, most_rad_per_s},
            {random, opened.stored.homed.linkage.joint[1], opened.stored.index, 0,
             most_rad_per_s}} {
    CHECK(opened.verdict.ok());
    joint[0].base = INT32_MAX - 900;  // wraps
    joint[1].base = static_cast<int64_t>(random.bits());
    while (!joint[0].has_pulse() || !joint[1].has_pulse()) move();
    const int32_t pulse[3] = {joint[0].pulse(), joint[1].pulse(), 0};
    start(state, opened.index, opened.linkage, pulse, sample);
  }
  void move() {
    for (int k = 0; k < 2; ++k) {
      joint[k].move();
      sample.counts[k] = joint[k].counts();
    }
  }
  bool tick() {
    move();
    const uint32_t packed = joint[0].packed() | joint[1].packed() << 8;
    return follow(state, opened.index, opened.linkage, sample, packed);
  }
};

// Counts of a radian as the simulated machines have them, and other ones.
constexpr float kCounts_per_rad[] = {2200, 10430, 1573, -6366, 4775, 2546, 4e4f};
constexpr double kMax_rad_per_s = 25;

}  // namespace

TEST(IndexPulses_EachWordIsBrokenAlone) {
  CHECK(Opened(bar()).verdict.ok());
  CHECK(Opened(bar(-1573)).verdict.ok());
  const float nan = test::nan_value();
  check_broken(0, [](Stored& s) {
    s.homed.homing = {};
    s.homed.homing.margin_rad = .1f;
    for (uint32_t k = 0; k < 2; ++k) s.homed.homing.pose_rad[k] = 1;
  });
  check_broken(1, [](Stored& s) { s.index.period_rad[0] = .109f; });  // 240 counts
  check_broken(2, [&](Stored& s) { s.index.period_rad[1] = nan; });
  check_broken(2, [](Stored& s) { s.index.period_rad[1] = -1; });
  check_broken(3, [](Stored& s) { s.index.index_rad[2] = -0.0f; });  // no such joint
  check_broken(3, [](Stored& s) { s.index.period_rad[2] = 1; });
  check_broken(4, [](Stored& s) { s.index.within_rad = 2.9f / 2200; });
  check_broken(4, [](Stored& s) { s.index.within_rad = 60.1f / 2200; });
  check_broken(4, [&](Stored& s) { s.index.within_rad = nan; });
  check_broken(7, [](Stored& s) { s.index.period_rad[1] = 2.01f; });  // beyond the range
  check_broken(7, [](Stored& s) { s.homed.homing.margin_rad = .61f; });
  check_broken(7, [&](Stored& s) { s.index.index_rad[0] = nan; });
  check_broken(7, [](Stored& s) { s.index.index_rad[1] = 101; });
}

TEST(IndexPulses_ASectionWithoutThem_IsPassedAndNotFollowed) {
  Stored stored = bar();
  const core::Bytes alone(reinterpret_cast<const uint8_t*>(&stored), sizeof stored.homed);
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  device::IndexPulses index;
  CHECK_EQ(open(alone, linkage, homing).rule, 0u);
  CHECK_EQ(index.open(alone, linkage, homing).rule, 0u);
  CHECK(!index.is_open() && homing.settings().by == device::HomeBy::kStops);
}

TEST(IndexPulses_SoundJoints_AreNeverOff) {
  constexpr uint32_t kTicks = 1000000;
  for (const float counts_per_rad : kCounts_per_rad) {
    Bench bench(5, counts_per_rad, kMax_rad_per_s);
    uint32_t pulses = 0, ticks = 0, lost = 0;
    double fastest = 0;
    for (; ticks < kTicks; ++ticks) {
      const int32_t before = bench.joint[0].counts();
      if (bench.random.bits() % 100 == 0) {  // an invalid sample
        bench.move();
        excuse(bench.state);
        ++lost;
        continue;
      }
      if (!bench.tick()) break;
      pulses += bench.joint[0].packed() >> 7;
      const int32_t passed = static_cast<int32_t>(static_cast<uint32_t>(bench.joint[0].counts()) -
                                                  static_cast<uint32_t>(before));
      fastest = std::max(fastest, std::fabs(static_cast<double>(passed)));
    }
    CHECK_EQ(ticks, kTicks);
    CHECK_GE(pulses, 4000u);
    CHECK_GE(lost, 5000u);
    CHECK_GE(fastest, 0.8 * kMax_rad_per_s * 1e-3 * std::fabs(double{counts_per_rad}));
  }
}

// Off by more than the tolerance, the play and three counts. What passes a pulse fast is found
// unless seven bits of the count hide it.
TEST(IndexPulses_ASlip_IsFoundAtTheFirstPulse) {
  constexpr int32_t kTolerated = 20 + 12 + 3 + 1;
  uint32_t late = 0, at_once = 0, hidden = 0;
  for (const float counts_per_rad : kCounts_per_rad)
    for (uint32_t seed = 0; seed < 400; ++seed) {
      Bench bench(seed + 9, counts_per_rad, kMax_rad_per_s);
      for (uint32_t i = bench.random.bits() % 2000; i > 0; --i) CHECK(bench.tick());
      const uint32_t k = seed & 1u;
      const int32_t size = kTolerated + static_cast<int32_t>(bench.random.bits() % 3000);
      bench.joint[k].slip = (seed & 2u) != 0 ? size : -size;
      uint32_t ticks = 0;
      for (bool is_found = false; !is_found; ++ticks) {
        const int32_t before = bench.joint[k].counts();
        is_found = !bench.tick();
        const bool is_hidden =
            std::abs(static_cast<int32_t>(static_cast<uint32_t>(bench.joint[k].counts()) -
                                          static_cast<uint32_t>(before))) >= 120 &&
            (size % 128 <= kTolerated || size % 128 >= 128 - kTolerated);
        const bool is_due = bench.joint[k].packed() != 0 && ticks > 0;
        hidden += is_due && !is_found && is_hidden ? 1 : 0;
        late += is_due && !is_found && !is_hidden ? 1 : 0;
        at_once += is_due && is_found ? 1 : 0;
        if (ticks > 400000) break;
      }
      CHECK_LE(ticks, 400000u);
    }
  test::note("found at a pulse", at_once);
  test::note("hidden by speed", hidden);
  CHECK_EQ(late, 0u);
  CHECK_GE(at_once, 500u);
}

TEST(IndexPulses_NoneWhereOneIsDue_IsFoundInTheThirdSample) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    Bench bench(seed, 2200, 5);
    for (int i = 0; i < 500; ++i) CHECK(bench.tick());
    const int32_t within = 20;
    uint32_t behind = 0;
    int32_t side = 0;
    bool is_found = false;
    for (int i = 0; i < 100000 && !is_found; ++i) {
      bench.move();
      is_found = !follow(bench.state, bench.opened.index, bench.opened.linkage, bench.sample, 0);
      // Of joint 1, which has no play: where it is between the pulses.
      const int64_t from = int64_t{bench.joint[1].counts()} - bench.joint[1].pulse();
      const double turns = static_cast<double>(static_cast<int32_t>(from)) / (0.6 * 2200);
      const double off = (turns - std::round(turns)) * 0.6 * 2200;
      if (std::fabs(off) < within + 2) continue;
      const int32_t now = static_cast<int32_t>(std::floor(turns));
      if (side == 0 && i == 0) side = now + 1000;
      behind = side != 0 && now + 1000 != side ? behind + 1 : 0;
      CHECK_LE(behind, 3u);
    }
    CHECK(is_found);
  }
}

TEST(IndexPulses_EveryCountGivesAnAnswer) {
  const Opened opened(bar(1e5f));
  test::Lcg random(8);
  for (int i = 0; i < 20000; ++i) {
    device::Sample sample{{}, true, .001f};
    int32_t pulse[3], latched[3];
    for (int k = 0; k < 3; ++k) pulse[k] = static_cast<int32_t>(random.bits());
    device::IndexState state;
    start(state, opened.index, opened.linkage, pulse, sample);
    for (int32_t& count : sample.counts) count = static_cast<int32_t>(random.bits());
    sample.counts[i % 3] = i % 2 == 0 ? INT32_MIN : INT32_MAX;
    (void)pulses_of(state, sample, random.bits(), latched);
    (void)follow(state, opened.index, opened.linkage, sample, random.bits());
  }
}
