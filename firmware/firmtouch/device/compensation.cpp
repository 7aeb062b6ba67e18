#include "firmtouch/device/compensation.hpp"

#include "firmtouch/device/rules.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

constexpr float kMaxSpring_Nm_per_rad = 1000.0f;
constexpr float kMaxAngle_rad = 100.0f;
constexpr float kMaxFrictionShare = 0.8f;  // real friction changes by a fifth
constexpr float kMinFade_rad_per_s = 0.001f, kMaxFade_rad_per_s = 100.0f;

// Result: whether a joint has friction. `verdict`: rejected, or as it was.
bool check_friction(const CompensationLayout& of, const StoredLinkage& linkage,
                    core::Verdict& verdict) {
  bool has_one = false;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    if (is_zero(of.friction_Nm[k])) continue;
    has_one = true;
    if (!(of.friction_Nm[k] > 0.0f && of.friction_Nm[k] <= linkage.layout().max_torque_Nm[k]))
      verdict = reject(kRuleCompensation, 2 * kMaxJoints + k);
  }
  const float share = of.friction_share, fade = of.friction_fade_rad_per_s;
  const bool is_none = is_zero(share) && is_zero(fade);
  const bool is_some = share > 0.0f && share <= kMaxFrictionShare && fade >= kMinFade_rad_per_s &&
                       fade <= kMaxFade_rad_per_s;
  if (has_one ? !is_some : !is_none) verdict = reject(kRuleCompensation, 3 * kMaxJoints);
  return has_one;
}

}  // namespace

bool CompensationLayout::is_in(core::Bytes section) {
  if (section.size() < sizeof(LinkageLayout) + sizeof(CompensationLayout)) return false;
  uint32_t tag;
  __builtin_memcpy(&tag, section.data() + section.size() - sizeof(CompensationLayout), sizeof tag);
  return tag == kCompensationTag;
}

template <>
core::Verdict Compensation::check(core::Bytes, const StoredLinkage& linkage) const {
  bool has_one = false;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float spring = layout().spring_Nm_per_rad[k], relaxed = layout().relaxed_rad[k];
    if (is_zero(spring) && is_zero(relaxed)) continue;
    if (!(spring > 0.0f && spring <= kMaxSpring_Nm_per_rad && k < linkage.layout().joints))
      return reject(kRuleCompensation, k);
    if (!(relaxed >= -kMaxAngle_rad && relaxed <= kMaxAngle_rad))
      return reject(kRuleCompensation, kMaxJoints + k);
    has_one = true;
  }
  core::Verdict verdict = core::kPassed;
  has_one |= check_friction(layout(), linkage, verdict);
  if (!verdict.ok() || has_one) return verdict;
  return reject(kRuleCompensation, 3 * kMaxJoints + 1);
}

math::Vec3 spring_torques_Nm(const Compensation& compensation,
                             const float (&angle_rad)[kMaxJoints]) {
  const CompensationLayout& l = compensation.layout();
  const auto of = [&](uint32_t k) {
    return l.spring_Nm_per_rad[k] * (l.relaxed_rad[k] - angle_rad[k]);
  };
  return {of(0), of(1), of(2)};
}

void friction_torques_Nm(const Compensation& compensation,
                         const float (&rate_rad_per_s)[kMaxJoints],
                         float (&torque_Nm)[kMaxJoints]) {
  const CompensationLayout& l = compensation.layout();
  const bool has_friction = l.friction_share > 0.0f;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float rate = rate_rad_per_s[k];
    const float part = rate / (__builtin_fabsf(rate) + l.friction_fade_rad_per_s);
    torque_Nm[k] = has_friction ? l.friction_share * l.friction_Nm[k] * part : 0.0f;
  }
}

}  // namespace firmtouch::device
