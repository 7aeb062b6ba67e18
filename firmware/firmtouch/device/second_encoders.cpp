#include "firmtouch/device/second_encoders.hpp"

#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/samples.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

// Up to 1e4 counts a radian the counts of every range are exact in float within half a count.
constexpr float kMaxSecondCountsPerRad = 1e4f;
// Of the second encoder. A count of each is uncertain, and one of their ratio. A coarse comparison
// takes a coarse encoder, which may turn faster.
constexpr float kMinWithin_counts = 3, kMaxWithin_counts = 60;
// Where the conversion to an integer is defined.
constexpr float kMaxExpected = 2e9f;

float size(float a) { return __builtin_fabsf(a); }

uint8_t byte_of(uint32_t counts, uint32_t joint) {
  return static_cast<uint8_t>(counts >> (8 * joint));
}

float ratio_of(const SecondEncodersLayout& second, const LinkageLayout& linkage, uint32_t joint) {
  return second.counts_per_rad[joint] / linkage.joint[joint].counts_per_rad;
}

}  // namespace

bool SecondEncodersLayout::is_in(core::Bytes section) {
  constexpr uint32_t kSecond = sizeof(SecondEncodersLayout);
  return section.size() == sizeof(LinkageLayout) + kSecond ||
         section.size() == sizeof(HomedLinkageLayout) + kSecond;
}

template <>
core::Verdict SecondEncoders::check(core::Bytes, const StoredLinkage& linkage) const {
  bool has_one = false;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    if (is_zero(layout().counts_per_rad[k])) continue;
    const float scale = size(layout().counts_per_rad[k]);
    if (k >= linkage.layout().joints || !(scale >= 1.0f && scale <= kMaxSecondCountsPerRad))
      return reject(kRuleSecondEncoder, k);
    const float within = layout().within_rad * scale;
    if (!(within >= kMinWithin_counts + size(ratio_of(layout(), linkage.layout(), k)) &&
          within <= kMaxWithin_counts))
      return reject(kRuleSecondEncoder, kMaxJoints + k);
    has_one = true;
  }
  return has_one ? core::kPassed : reject(kRuleSecondEncoder, 2 * kMaxJoints);
}

void align(SecondState& state, const Sample& sample, uint32_t second) {
  state.is_aligned = true;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    state.first[k] = sample.counts[k];
    state.turned[k] = 0;
    state.second[k] = byte_of(second, k);
  }
}

bool agree(SecondState& state, const SecondEncoders& second, const StoredLinkage& linkage,
           const Sample& sample, uint32_t second_counts) {
  const SecondEncodersLayout& layout = second.layout();
  bool do_agree = true;
  for (uint32_t k = 0; k < linkage.layout().joints; ++k) {
    const float turned = static_cast<float>(difference(sample.counts[k], state.first[k]));
    const float wanted = turned * ratio_of(layout, linkage.layout(), k);
    const int32_t expected = static_cast<int32_t>(clamp(wanted, -kMaxExpected, kMaxExpected));
    const uint8_t now = byte_of(second_counts, k);
    const int8_t step = static_cast<int8_t>(now - state.second[k]);
    state.second[k] = now;
    state.turned[k] =
        static_cast<int32_t>(static_cast<uint32_t>(state.turned[k]) + static_cast<uint32_t>(step));
    const int32_t off = difference(state.turned[k], expected);
    const float most = layout.within_rad * size(layout.counts_per_rad[k]);
    const bool has_second = most > 0.0f;
    do_agree &= !has_second || size(static_cast<float>(off)) <= most;
  }
  return do_agree;
}

}  // namespace firmtouch::device
