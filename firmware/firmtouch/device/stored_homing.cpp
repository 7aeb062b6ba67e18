#include "firmtouch/device/stored_homing.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/device/rules.hpp"

namespace firmtouch::device {
namespace {

using core::reject;
using core::Verdict;

// Words that a way of homing, or a missing joint, does not use are 0.
Verdict check_words(const HomingLayout& homing, const LinkageLayout& linkage) {
  const bool is_by_stops = homing.by == static_cast<uint32_t>(HomeBy::kStops);
  if (!is_by_stops && homing.by != static_cast<uint32_t>(HomeBy::kKnownPose))
    return reject(kRuleHoming);
  if (!is_by_stops && !is_zero(homing.speed_rad_per_s)) return reject(kRuleHoming, 1);
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const float torque_Nm = homing.torque_Nm[k], pose_rad = homing.pose_rad[k];
    const JointLayout& joint = linkage.joint[k];
    const bool has_torque = is_by_stops && k < linkage.joints;
    const bool has_pose = !is_by_stops && k < linkage.joints;
    const bool is_torque = has_torque ? torque_Nm <= linkage.max_torque_Nm[k] : is_zero(torque_Nm);
    const bool is_pose =
        has_pose ? pose_rad >= joint.low_rad && pose_rad <= joint.high_rad : is_zero(pose_rad);
    if (!is_torque || !is_pose) return reject(kRuleHoming, 2 + k);
  }
  return core::kPassed;
}

}  // namespace

HomingSettings StoredHoming::settings() const {
  HomingSettings settings;
  settings.by = static_cast<HomeBy>(layout_->by);
  settings.speed_rad_per_s = layout_->speed_rad_per_s;
  settings.margin_rad = layout_->margin_rad;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    settings.torque_Nm[k] = layout_->torque_Nm[k];
    settings.pose_rad[k] = layout_->pose_rad[k];
  }
  return settings;
}

Verdict open(core::Bytes section, StoredLinkage& linkage, StoredHoming& homing) {
  homing.layout_ = nullptr;
  const bool is_homed = section.size() == sizeof(HomedLinkageLayout);
  Verdict verdict =
      open(is_homed ? core::Bytes{section.data(), sizeof(LinkageLayout)} : section, linkage);
  if (!verdict.ok() || !is_homed) return verdict;
  StoredHoming found;
  found.layout_ = &core::as_whole_array<HomedLinkageLayout>(section).data()->homing;
  verdict = check_words(*found.layout_, linkage.layout());
  if (verdict.ok() && !check_homing(found.settings(), linkage.joints({Estimator::kDifference, 1})))
    verdict = reject(kRuleHoming, 5);
  if (verdict.ok()) {
    homing = found;
  } else {
    linkage = {};
  }
  return verdict;
}

}  // namespace firmtouch::device
