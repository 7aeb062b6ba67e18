#include "firmtouch/device/index_pulses.hpp"

#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/samples.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

// A count of the pulse, of that which homing found, and of the period are uncertain.
constexpr float kMinWithin_counts = 3;
// So that seven bits of a count show a pulse that is off.
constexpr float kMaxWithin_counts = 60;
constexpr float kMinPeriod_counts = 4 * kMaxWithin_counts;
constexpr float kMaxStep_counts = 127;
constexpr uint32_t kMaxMissing = 3;
// Where conversions to an integer are defined.
constexpr float kMaxFrom = 1e9f;

float size(float a) { return __builtin_fabsf(a); }

// To the nearest. Pre: within the int32.
int32_t nearest(float a) { return static_cast<int32_t>(a < 0.0f ? a - 0.5f : a + 0.5f); }

int32_t sum(int32_t a, int32_t b) {
  return static_cast<int32_t>(static_cast<uint32_t>(a) + static_cast<uint32_t>(b));
}

// Seven bits of a count less those of `from`, from -64 to 63.
int32_t low_difference(uint32_t byte, int32_t from) {
  const uint32_t bits = byte - static_cast<uint32_t>(from);
  return static_cast<int32_t>(((bits & 127u) ^ 64u)) - 64;
}

// How far the joint is from where a pulse stands.
float from_pulse(int32_t counts, int32_t pulse) {
  return clamp(static_cast<float>(difference(counts, pulse)), -kMaxFrom, kMaxFrom);
}

struct JointIndex {
  float period, within;  // in counts
};

JointIndex index_of(const IndexPulses& index, const StoredLinkage& linkage, uint32_t k) {
  const float counts_per_rad = size(linkage.layout().joint[k].counts_per_rad);
  return {index.layout().period_rad[k] * counts_per_rad,
          index.layout().within_rad * counts_per_rad};
}

// Whether a pulse is due on the way of the joint, and the pulse was there.
bool is_due(const JointIndex& index, int32_t pulse, int32_t before, int32_t now, uint32_t byte) {
  const int32_t step = difference(now, before), middle = sum(before, step / 2);
  const float from = from_pulse(middle, pulse);
  const int32_t due =
      sum(pulse, nearest(static_cast<float>(nearest(from / index.period)) * index.period));
  const float off = static_cast<float>(difference(due, middle));
  return size(off) <= 0.5f * size(static_cast<float>(step)) + 1.0f + index.within &&
         size(static_cast<float>(low_difference(byte, due))) <= index.within;
}

// The interval in which the joint is, or `before` where it is beside a pulse.
int32_t interval_at(const JointIndex& index, int32_t pulse, int32_t now, int32_t before) {
  const float from = from_pulse(now, pulse);
  const int32_t number = nearest(from / index.period);
  const float off = from - static_cast<float>(number) * index.period;
  if (size(off) <= index.within) return before;
  return off > 0.0f ? number : number - 1;
}

}  // namespace

bool IndexLayout::is_in(core::Bytes section) {
  return section.size() == sizeof(HomedLinkageLayout) + sizeof(IndexLayout);
}

template <>
core::Verdict IndexPulses::check(core::Bytes, const StoredLinkage& linkage,
                                 const StoredHoming& homing) const {
  if (homing.layout().by != static_cast<uint32_t>(HomeBy::kStops)) return reject(kRuleIndex);
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    if (k >= linkage.layout().joints) {
      if (!is_zero(layout().index_rad[k]) || !is_zero(layout().period_rad[k]))
        return reject(kRuleIndex, 1 + k);
      continue;
    }
    const JointIndex index = index_of(*this, linkage, k);
    if (!(index.period >= kMinPeriod_counts)) return reject(kRuleIndex, 1 + k);
    if (!(index.within >= kMinWithin_counts && index.within <= kMaxWithin_counts))
      return reject(kRuleIndex, 1 + kMaxJoints + k);
  }
  if (!check_homing(settings_of(homing, *this), linkage.joints({Estimator::kDifference, 1})))
    return reject(kRuleIndex, 1 + 2 * kMaxJoints);
  return core::kPassed;
}

HomingSettings settings_of(const StoredHoming& homing, const IndexPulses& index) {
  HomingSettings settings = homing.settings();
  settings.by = HomeBy::kIndex;
  settings.index_within_rad = index.layout().within_rad;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    settings.index_rad[k] = index.layout().index_rad[k];
    settings.index_period_rad[k] = index.layout().period_rad[k];
  }
  return settings;
}

uint32_t pulses_of(const IndexState& state, const Sample& sample, uint32_t packed,
                   int32_t (&latched)[kMaxJoints]) {
  uint32_t pulses = 0;
  for (uint32_t k = 0; k < kMaxJoints; ++k, packed >>= 8) {
    const int32_t step = difference(sample.counts[k], state.counts[k]);
    const int32_t middle = sum(state.counts[k], step / 2);
    latched[k] = sum(middle, low_difference(packed, middle));
    const bool is_certain = size(static_cast<float>(step)) <= kMaxStep_counts;
    pulses |= is_certain ? (packed >> 7 & 1u) << k : 0u;
  }
  return pulses;
}

void start(IndexState& state, const IndexPulses& index, const StoredLinkage& linkage,
           const int32_t (&pulse)[kMaxJoints], const Sample& sample) {
  state = {};
  state.is_started = true;
  for (uint32_t k = 0; k < linkage.layout().joints; ++k) {
    state.counts[k] = sample.counts[k];
    state.pulse[k] = pulse[k];
    // Beside a pulse either interval is right.
    const JointIndex bare = {index_of(index, linkage, k).period, 0};
    state.interval[k] = interval_at(bare, pulse[k], sample.counts[k], 0);
  }
  excuse(state);
}

bool follow(IndexState& state, const IndexPulses& index, const StoredLinkage& linkage,
            const Sample& sample, uint32_t packed) {
  for (uint32_t k = 0; k < linkage.layout().joints; ++k, packed >>= 8) {
    const JointIndex joint = index_of(index, linkage, k);
    const int32_t now = sample.counts[k];
    if ((packed & 0x80u) != 0) {
      state.seen |= 1u << k;
      state.is_off |= !is_due(joint, state.pulse[k], state.counts[k], now, packed);
    }
    state.counts[k] = now;
    const int32_t interval = interval_at(joint, state.pulse[k], now, INT32_MIN);
    if (interval == INT32_MIN) continue;
    const bool is_other = interval != state.interval[k];
    const bool is_missing = is_other && (state.seen >> k & 1u) == 0;
    state.missing[k] = is_missing ? state.missing[k] + 1 : 0;
    state.is_off |= state.missing[k] >= kMaxMissing;
    if (is_missing) continue;
    state.interval[k] = interval;
    state.seen &= ~(1u << k);
  }
  return !state.is_off;
}

}  // namespace firmtouch::device
