#include "firmtouch/device/stored_linkage.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/device/rules.hpp"

namespace firmtouch::device {
namespace {

using core::reject;
using core::Verdict;

constexpr float kMinRise_s = 1e-4f;
constexpr float kMaxRise_s = 1.0f;
constexpr float kMaxCarriedShare = 0.9f;
constexpr float kMaxLeastMass_kg = 100;

// What a kind uses of the arrays of the layout.
struct Used {
  uint32_t joints, lengths, offsets, elbows, flags;
};

Used used_by(const LinkageLayout& layout) {
  if (layout.kind == kFiveBar) return {2, 4, 1, 2, kFlagTip};
  if (layout.kind == kDelta) return {3, 6, 3, 3, kFlagTip};
  const uint32_t joints = layout.joints == 2 ? 2 : 3;
  return {joints, 2, 2, joints - 1, kFlagParallelogram};
}

// Every bit, so that one linkage has one layout.
bool is_zero(const float* words, uint32_t from, uint32_t to) {
  uint32_t bits = 0;
  for (uint32_t k = from; k < to; ++k) {
    uint32_t word;
    __builtin_memcpy(&word, words + k, sizeof word);
    bits |= word;
  }
  return bits == 0;
}

Verdict check_words(const LinkageLayout& layout) {
  if (layout.kind < kFiveBar || layout.kind > kDelta) return reject(kRuleKind);
  const Used used = used_by(layout);
  if (layout.joints != used.joints) return reject(kRuleKind, 1);
  if ((layout.flags & ~(used.flags | kFlagForcedWalls)) != 0) return reject(kRuleUnused, 1);
  if (!is_zero(layout.length_m, used.lengths, 6)) return reject(kRuleUnused, 2);
  if (!is_zero(layout.offset_m, used.offsets, 3)) return reject(kRuleUnused, 3);
  for (uint32_t k = used.joints; k < kMaxJoints; ++k)
    if (!is_zero(&layout.joint[k].counts_per_rad, 0, 4)) return reject(kRuleUnused, 4);
  if (!is_zero(layout.max_torque_Nm, used.joints, kMaxJoints)) return reject(kRuleUnused, 5);
  if (!is_zero(layout.elbow_mass_kg, used.elbows, kMaxJoints)) return reject(kRuleUnused, 6);
  return core::kPassed;
}

Verdict check_linkage(const StoredLinkage& linkage) {
  switch (linkage.layout().kind) {
    case kFiveBar:
      return check(linkage.five_bar());
    case kSerialArm:
      return check(linkage.serial_arm());
    default:
      return check(linkage.delta());
  }
}

Verdict check_settings(const StoredLinkage& linkage) {
  const LinkageLayout& layout = linkage.layout();
  Verdict verdict = check(linkage.joints({Estimator::kDifference, 1}));
  if (verdict.ok()) verdict = check(linkage.limits());
  if (verdict.ok()) verdict = check(linkage.load());
  if (!verdict.ok()) return verdict;
  if (!(layout.torque_rise_s >= kMinRise_s && layout.torque_rise_s <= kMaxRise_s))
    return reject(kRuleTorqueRise);
  if (!(layout.least_mass_kg >= 0.0f && layout.least_mass_kg <= kMaxLeastMass_kg))
    return reject(kRuleLoad, kMaxJoints + 3);
  if (!(layout.carried_share >= 0.0f && layout.carried_share <= kMaxCarriedShare))
    return reject(kRuleLoad, kMaxJoints + 2);
  return core::kPassed;
}

}  // namespace

FiveBar StoredLinkage::five_bar() const {
  const LinkageLayout& l = *layout_;
  return {l.offset_m[0],
          {l.length_m[0], l.length_m[1]},
          {l.length_m[2], l.length_m[3]},
          (l.flags & kFlagTip) != 0};
}

SerialArm StoredLinkage::serial_arm() const {
  const LinkageLayout& l = *layout_;
  return {l.joints,
          {l.length_m[0], l.length_m[1]},
          l.offset_m[0],
          l.offset_m[1],
          (l.flags & kFlagParallelogram) != 0};
}

Delta StoredLinkage::delta() const {
  const LinkageLayout& l = *layout_;
  return {{l.length_m[0], l.length_m[1], l.length_m[2]},
          {l.length_m[3], l.length_m[4], l.length_m[5]},
          l.offset_m[0],
          l.offset_m[1],
          l.offset_m[2],
          (l.flags & kFlagTip) != 0};
}

JointSettings StoredLinkage::joints(VelocitySettings velocity) const {
  JointSettings settings;
  settings.joints = layout_->joints;
  for (uint32_t k = 0; k < settings.joints; ++k) {
    const JointLayout& joint = layout_->joint[k];
    settings.joint[k] = {joint.counts_per_rad, joint.zero_rad, joint.low_rad, joint.high_rad};
  }
  settings.max_speed_rad_per_s = layout_->max_speed_rad_per_s;
  settings.velocity = velocity;
  return settings;
}

TorqueLimits StoredLinkage::limits() const {
  TorqueLimits limits;
  limits.full_from = layout_->full_from;
  limits.gone_at = layout_->gone_at;
  for (uint32_t k = 0; k < layout_->joints; ++k)
    limits.max_torque_Nm[k] = layout_->max_torque_Nm[k];
  return limits;
}

Load StoredLinkage::load() const {
  const LinkageLayout& l = *layout_;
  return {{l.elbow_mass_kg[0], l.elbow_mass_kg[1], l.elbow_mass_kg[2]},
          l.tip_mass_kg,
          {l.gravity_mps2[0], l.gravity_mps2[1], l.gravity_mps2[2]}};
}

Verdict open(core::Bytes section, StoredLinkage& to) {
  to.layout_ = nullptr;
  const core::Span<const LinkageLayout> layout = core::as_whole_array<LinkageLayout>(section);
  if (layout.size() != 1) return reject(kRuleLinkageSize);
  StoredLinkage linkage;
  linkage.layout_ = layout.data();
  Verdict verdict = check_words(layout[0]);
  if (verdict.ok()) verdict = check_linkage(linkage);
  if (verdict.ok()) verdict = check_settings(linkage);
  if (verdict.ok()) to = linkage;
  return verdict;
}

Pose pose_of(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints]) {
  switch (linkage.layout().kind) {
    case kFiveBar:
      return pose_of(linkage.five_bar(), angle_rad);
    case kSerialArm:
      return pose_of(linkage.serial_arm(), angle_rad);
    default:
      return pose_of(linkage.delta(), angle_rad);
  }
}

math::Vec3 carrying_torques_Nm(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose) {
  const Load load = linkage.load();
  switch (linkage.layout().kind) {
    case kFiveBar:
      return carrying_torques_Nm(linkage.five_bar(), angle_rad, pose, load);
    case kSerialArm:
      return carrying_torques_Nm(linkage.serial_arm(), angle_rad, pose, load);
    default:
      return carrying_torques_Nm(linkage.delta(), angle_rad, pose, load);
  }
}

}  // namespace firmtouch::device
