#include "firmtouch/device/derating.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/samples.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

// From cold to the continuous torque's heat by the largest torque, about.
constexpr float kMinWarming_s = 0.1f;
constexpr float kMaxTime_s = 1e4f;
constexpr float kFadingShare = 0.25f;  // of the heat, in which the limit falls

}  // namespace

// Index pulses need homing: without it their size would be that of homing with second encoders.
bool DeratingLayout::is_in(core::Bytes section) {
  constexpr uint32_t kHomed = sizeof(HomedLinkageLayout), kSecond = sizeof(SecondEncodersLayout);
  const uint32_t rest = section.size() - uint32_t{sizeof(DeratingLayout)};  // may wrap
  return rest == sizeof(LinkageLayout) || rest == sizeof(LinkageLayout) + kSecond ||
         rest == kHomed || rest == kHomed + kSecond || rest == kHomed + sizeof(IndexLayout);
}

template <>
core::Verdict Derating::check(core::Bytes section, const StoredLinkage& linkage) const {
  // Homing measures by its torque, so it must have it.
  const HomingLayout* homing = nullptr;
  if (section.size() >= sizeof(HomedLinkageLayout) + sizeof(DeratingLayout))
    homing = &core::as_array<HomedLinkageLayout>(section, 1)[0].homing;
  bool has_one = false;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float continuous_Nm = layout().continuous_Nm[k], time_s = layout().time_s[k];
    if (is_zero(continuous_Nm) && is_zero(time_s)) continue;
    const float largest_Nm = linkage.layout().max_torque_Nm[k];  // 0 of no joint
    const float least_Nm = homing != nullptr ? homing->torque_Nm[k] : 0.0f;
    if (!(continuous_Nm > 0.0f && continuous_Nm >= least_Nm && continuous_Nm <= largest_Nm))
      return reject(kRuleDerating, k);
    const float ratio = largest_Nm / continuous_Nm;
    if (!(time_s >= kMinWarming_s * ratio * ratio && time_s <= kMaxTime_s))
      return reject(kRuleDerating, kMaxJoints + k);
    has_one = true;
  }
  return has_one ? core::kPassed : reject(kRuleDerating, 2 * kMaxJoints);
}

void heat(HeatState& state, const Derating& derating, const StoredLinkage& linkage,
          const float (&torque_Nm)[kMaxJoints], float dt_s, float (&most_Nm)[kMaxJoints]) {
  const float step_s = clamp(dt_s, 0.0f, kMaxStep_s);
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float continuous_Nm = derating.layout().continuous_Nm[k];
    most_Nm[k] = linkage.layout().max_torque_Nm[k];
    if (!(continuous_Nm > 0.0f)) continue;
    const float load = torque_Nm[k] / continuous_Nm, before = state.heat[k];
    // Compensated: a millisecond of 10,000 s changes no digit of a float.
    const float change =
        (load * load - before) * (step_s / (derating.layout().time_s[k] + step_s)) + state.below[k];
    state.heat[k] = before + change;
    state.below[k] = change - (state.heat[k] - before);
    const float above = clamp((1.0f - state.heat[k]) * (1 / kFadingShare), 0.0f, 1.0f);
    most_Nm[k] = continuous_Nm + (most_Nm[k] - continuous_Nm) * above;
  }
}

}  // namespace firmtouch::device
